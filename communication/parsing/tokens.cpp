#include "castor/communication/parsing/tokens.hpp"

#include "castor/communication/parsing/feasibility.hpp"
#include "castor/communication/parsing/numerals.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace castor::communication {

namespace {

bool is_letter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0;
}

char lower(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 ? static_cast<char>(std::tolower(byte)) : c;
}

bool ends_with(const std::string& word, std::string_view end) {
  return word.size() > end.size() && std::string_view(word).ends_with(end);
}

/// What people type in a hurry, and the one or two words that it stands for.
constexpr std::array<std::array<std::string_view, 3>, 49> hasty{{{"isnt", "is", "n't"},
                                                                 {"arent", "are", "n't"},
                                                                 {"doesnt", "does", "n't"},
                                                                 {"dont", "do", "n't"},
                                                                 {"didnt", "did", "n't"},
                                                                 {"cant", "can", "n't"},
                                                                 {"whats", "what", "'s"},
                                                                 {"wheres", "where", "'s"},
                                                                 {"theres", "there", "'s"},
                                                                 {"thats", "that", "'s"},
                                                                 {"whos", "who", "'s"},
                                                                 {"im", "i", "'m"},
                                                                 {"theyre", "they", "'re"},
                                                                 {"youre", "you", "'re"},
                                                                 {"r", "are", ""},
                                                                 {"u", "you", ""},
                                                                 {"ur", "your", ""},
                                                                 {"wasnt", "was", "n't"},
                                                                 {"wont", "wo", "n't"},
                                                                 {"hows", "how", "'s"},
                                                                 {"ive", "i", "'ve"},
                                                                 {"theyve", "they", "'ve"},
                                                                 {"gimme", "give", "me"},
                                                                 {"lemme", "let", "me"},
                                                                 {"wanna", "want", "to"},
                                                                 {"pls", "please", ""},
                                                                 {"plz", "please", ""},
                                                                 {"num", "number", "of"},
                                                                 {"obj", "object", ""},
                                                                 {"objs", "objects", ""},
                                                                 {"wat", "what", ""},
                                                                 {"wich", "which", ""},
                                                                 {"ya", "you", ""},
                                                                 {"bout", "about", ""},
                                                                 {"wut", "what", ""},
                                                                 {"wot", "what", ""},
                                                                 {"wats", "what", "'s"},
                                                                 {"da", "the", ""},
                                                                 {"dis", "this", ""},
                                                                 {"dat", "that", ""},
                                                                 {"dem", "them", ""},
                                                                 {"aint", "is", "n't"},
                                                                 {"whens", "when", "'s"},
                                                                 {"shouldnt", "should", "n't"},
                                                                 {"couldnt", "could", "n't"},
                                                                 {"ppl", "people", ""},
                                                                 {"smth", "something", ""},
                                                                 {"k", "ok", ""},
                                                                 {"ain't", "is", "n't"}}};

/// "5cm", "10mm": where the unit begins; 0 if the word is no number with one.
std::size_t begin_of_unit(std::string_view word) {
  const auto unit = std::min(word.find_first_not_of("0123456789."), word.size());
  constexpr std::array units{"cm", "mm", "m", "inch", "inches", "centimetres", "centimeters"};
  return std::ranges::find(units, word.substr(unit)) == units.end() ? 0 : unit;
}

void append_word(std::string word, std::vector<std::string>& words) {
  const auto contraction =
    std::find_if(hasty.begin(), hasty.end(), [&word](auto& x) { return x.front() == word; });
  if (contraction != hasty.end()) {
    words.emplace_back((*contraction)[1]);
    if (!(*contraction)[2].empty())
      words.emplace_back((*contraction)[2]);
  } else if (const auto unit = begin_of_unit(word); unit != 0) {
    words.push_back(word.substr(0, unit));
    words.push_back(word.substr(unit));
  } else if (word == "cannot" || word == "can't") {
    words.insert(words.end(), {"can", word == "cannot" ? "not" : "n't"});
  } else if (ends_with(word, "n't")) {
    words.insert(words.end(), {word.substr(0, word.size() - 3), "n't"});
  } else if (const auto mark = word.find('\''); mark != std::string::npos && mark > 0) {
    append_word(word.substr(0, mark), words);
    words.push_back(word.substr(mark));
  } else {
    words.push_back(std::move(word));
  }
}

/// In "5.5".
bool is_decimal_point(std::string_view text, std::size_t i) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  return text[i] == '.' && i > 0 && is_digit(text[i - 1]) && i + 1 < text.size() &&
         is_digit(text[i + 1]);
}

/// A comma, a dash or the like between words.
bool is_pause(std::string_view text, std::size_t i) {
  if (text[i] == ',' || text[i] == ';' || text[i] == ':')
    return true;
  return text[i] == '-' && i > 0 && text[i - 1] == ' ';
}

/// Where the quotation that begins at `begin` ends; `begin` itself if none does. Its mark stands
/// close to a letter; "'s" is no beginning of one.
std::size_t end_of_quotation(std::string_view text, std::size_t begin) {
  const auto letter_at = [text](std::size_t i) { return i < text.size() && is_letter(text[i]); };
  const auto rest = text.substr(begin);
  if (!letter_at(begin + 1) || rest.starts_with("'s "))
    return begin;
  for (auto end = begin + 2; end < text.size(); ++end)
    if (text[end] == text[begin] && !letter_at(end + 1))
      return end;
  return begin;
}

/// "The ball is for Mrs. Jones."
bool is_after_title(std::string_view text) {
  const auto blank = text.find_last_of(' ');
  const auto word = blank == std::string_view::npos ? text : text.substr(blank + 1);
  constexpr std::array titles{"Mr", "Mrs", "Ms", "Dr", "Prof", "St", "mr", "mrs", "ms", "dr"};
  return std::ranges::find(titles, word) != titles.end();
}

/// "Otherwise, leave it there", "if there is no room, put it on the left": says nothing without the
/// sentence before.
bool goes_on_with_condition(std::string_view before, std::string_view rest) {
  const auto first = words_of(rest.substr(0, rest.find_first_of(",.!?")));
  constexpr std::size_t longest_denial = 4;
  const bool is_denial = first.size() > 1 && first.size() <= longest_denial &&
                         first.front() == "if" && is_among(first.back(), {"not", "n't", "no"});
  const bool is_alternative = !first.empty() && (first.front() == "otherwise" || is_denial);
  if (first.size() > 1 && first.front() == "if" &&
      says_it_fails({std::next(first.begin()), first.end()}))
    return true;
  const auto words = words_of(before);
  return is_alternative && std::ranges::find(words, "if") != words.end();
}

} // namespace

std::vector<std::string> words_of(std::string_view utterance) {
  std::vector<std::string> words;
  std::size_t i = 0;
  while (i < utterance.size()) {
    const char c = utterance[i];
    if (c == '\'' || c == '"')
      if (const auto end = end_of_quotation(utterance, i); end != i) {
        words.push_back("'" + std::string(utterance.substr(i + 1, end - i - 1)) + "'");
        i = end + 1;
        continue;
      }
    std::string word;
    while (i < utterance.size() &&
           (is_letter(utterance[i]) || is_decimal_point(utterance, i) ||
            (utterance[i] == '\'' && i + 1 < utterance.size() && is_letter(utterance[i + 1]))))
      word += lower(utterance[i++]);
    if (!word.empty())
      append_word(std::move(word), words);
    else if (is_pause(utterance, i++) && !words.empty() && words.back() != ",")
      words.emplace_back(",");
  }
  if (!words.empty() && words.back() == ",")
    words.pop_back();
  return with_numerals(std::move(words));
}

std::vector<std::string> sentences_of(std::string_view text) {
  std::vector<std::string> sentences;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_mark = text[i] == '.' || text[i] == '!' || text[i] == '?';
    const bool is_last = i + 1 == text.size();
    if (!is_last && !(is_mark && (text[i + 1] == ' ' || text[i + 1] == '\n')))
      continue;
    if (!is_last && text[i] == '.' && is_after_title(text.substr(begin, i - begin)))
      continue;
    const auto sentence = text.substr(begin, i + 1 - begin);
    if (goes_on_with_condition(sentence, text.substr(i + 1)))
      continue;
    begin = i + 1;
    if (!words_of(sentence).empty())
      sentences.emplace_back(sentence.substr(sentence.find_first_not_of(" \n")));
  }
  return sentences;
}

} // namespace castor::communication
