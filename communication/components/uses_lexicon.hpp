#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"

#include <memory>
#include <string>

namespace castor::communication {

/// A component derived from `Base` that knows the words that the configuration names.
template <class Base>
class UsesLexicon : public Base {
protected:
  void configure() override {
    Base::configure();
    lexicon_ = lexicon_of_files(files_.get(), folder_.get());
  }

  const std::shared_ptr<const Lexicon>& lexicon() const { return lexicon_; }

private:
  Option<std::string> files_{this, "lexicon", shared_lexicon_names,
                             "lexicon files, those of others first"};
  Option<std::string> folder_{this, "base", "",
                              "folder of the files; those that come with Castor need not be there"};

  std::shared_ptr<const Lexicon> lexicon_;
};

} // namespace castor::communication
