#include "castor/communication/lexicon/english_lexicon.hpp"

#include "castor/communication/parsing/lexicon_reader.hpp"

#include <stdexcept>

namespace castor::communication {

std::shared_ptr<const Lexicon> english_lexicon() {
  static const auto lexicon = [] {
    auto read = read_lexicon(english_lexicon_text(), "english.ccg");
    if (!read.problems.empty())
      throw std::logic_error(render(read.problems.front()));
    return read.lexicon;
  }();
  return lexicon;
}

} // namespace castor::communication
