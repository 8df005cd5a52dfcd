#include "castor/communication/parsing/english_words.hpp"

#include <fstream>
#include <string_view>
#include <unordered_set>

namespace castor::communication {

namespace {

constexpr const char* list_of_words = "/usr/share/dict/american-english-small";

/// Empty where there is no such list.
std::unordered_set<std::string> english_words() {
  std::unordered_set<std::string> result;
  std::ifstream in(list_of_words);
  for (std::string word; std::getline(in, word);)
    result.insert(word);
  return result;
}

} // namespace

bool is_english_word(const std::string& word) {
  static const auto words = english_words();
  return words.contains(word);
}

bool begins_with_vowel(const std::string& word) {
  return !word.empty() && std::string_view{"aeiou"}.find(word.front()) != std::string_view::npos;
}

} // namespace castor::communication
