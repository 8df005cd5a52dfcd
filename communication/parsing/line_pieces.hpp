#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Parts of the lines of lexicon files, with their positions for findings.
namespace castor::communication {

/// A part of a line, and where it begins.
struct Piece {
  std::string text;
  int line = 0;
  int column = 0;
};

/// Thrown where reading a line or an item cannot go on.
struct ReadError {
  int line;
  int column;
  std::string message;
  std::string remedy;
};

[[noreturn]] void fail(const Piece& piece, const std::string& message, const std::string& remedy,
                       std::size_t offset = 0);

/// The words of a line.
std::vector<Piece> split(const Piece& whole);

/// "at all" of "at_all".
std::string phrase_of(std::string text);

/// WORD=OTHER, or WORD, which stands for itself.
struct WordPair {
  std::string word;
  std::string other;
};

/// \throws ReadError if one of them is empty
WordPair word_pair_of(const Piece& piece);

} // namespace castor::communication
