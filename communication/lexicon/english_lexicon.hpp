#pragma once

#include "castor/communication/parsing/lexicon.hpp"

#include <memory>
#include <string_view>

namespace castor::communication {

/// The contents of communication/lexicon/english.ccg, which is part of the library.
std::string_view english_lexicon_text();

/// The English lexicon of robots; read once.
std::shared_ptr<const Lexicon> english_lexicon();

} // namespace castor::communication
