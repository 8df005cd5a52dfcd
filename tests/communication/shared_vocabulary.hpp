#pragma once

#include "castor/binding/ontology/shared_ontology.hpp"
#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"

#include <memory>

namespace castor::communication::test {

/// The words and concepts that come with Castor.
inline const std::shared_ptr<const Vocabulary>& shared_vocabulary() {
  static const auto vocabulary =
    std::make_shared<const Vocabulary>(english_lexicon(), binding::shared_ontology());
  return vocabulary;
}

} // namespace castor::communication::test
