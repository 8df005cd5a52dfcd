#include "castor/benchmarks/semeval/robot_commands/command_words.hpp"

#include <cctype>

namespace castor::semeval {

std::vector<std::string> command_tokens(std::string_view command) {
  constexpr std::string_view marks = ",.;:!?()-";
  std::vector<std::string> tokens;
  bool is_new = true;
  for (const char c : command) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isspace(byte) != 0) {
      is_new = true;
    } else if (marks.find(c) != std::string_view::npos) {
      tokens.emplace_back(1, c);
      is_new = true;
    } else {
      if (is_new)
        tokens.emplace_back();
      is_new = false;
      tokens.back() += byte < 0x80 ? static_cast<char>(std::tolower(byte)) : c;
    }
  }
  return tokens;
}

std::vector<std::string> corrected(std::vector<std::string> words,
                                   const communication::Lexicon& lexicon) {
  for (auto& word : words) {
    if (lexicon.knows(word))
      continue;
    const auto nearest = lexicon.suggestions(word, 1);
    if (!nearest.empty())
      word = nearest.front();
  }
  return words;
}

} // namespace castor::semeval
