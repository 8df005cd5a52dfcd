#include "castor/communication/parsing/line_pieces.hpp"

#include <algorithm>

namespace castor::communication {

void fail(const Piece& piece, const std::string& message, const std::string& remedy,
          std::size_t offset) {
  throw ReadError{piece.line, piece.column + static_cast<int>(offset), message, remedy};
}

std::vector<Piece> split(const Piece& whole) {
  std::vector<Piece> pieces;
  std::size_t i = 0;
  while (i < whole.text.size()) {
    const auto begin = whole.text.find_first_not_of(" \t\r", i);
    if (begin == std::string::npos)
      break;
    i = std::min(whole.text.find_first_of(" \t\r", begin), whole.text.size());
    pieces.push_back(
      {whole.text.substr(begin, i - begin), whole.line, whole.column + static_cast<int>(begin)});
  }
  return pieces;
}

std::string phrase_of(std::string text) {
  std::ranges::replace(text, '_', ' ');
  return text;
}

WordPair word_pair_of(const Piece& piece) {
  const auto equals = piece.text.find('=');
  WordPair result{piece.text.substr(0, equals), {}};
  result.other = equals == std::string::npos ? result.word : piece.text.substr(equals + 1);
  if (result.word.empty() || result.other.empty())
    fail(piece, "there is no word", "Write WORD or WORD=MEANING.");
  return result;
}

} // namespace castor::communication
