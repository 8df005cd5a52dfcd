#include "castor/communication/parsing/paraphrase.hpp"

#include "castor/communication/parsing/numerals.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace castor::communication {

namespace {

/// In words.
constexpr std::size_t longest_slot = 16;

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> result;
  std::istringstream in{std::string{text}};
  for (std::string word; std::getline(in, word, separator);)
    if (!word.empty())
      result.push_back(std::move(word));
  return result;
}

bool is_slot(std::string_view word) {
  return word == "X" || word == "Y" || word == "Z";
}

bool is_list(std::string_view word) {
  return word.size() > 1 && word.front() == '@';
}

/// What follows "please" or "could you" is a request as if nothing stood before it.
bool begins_part(const std::vector<std::string>& words, std::size_t at, bool is_slot) {
  return at == 0 || words[at - 1] == "," ||
         (!is_slot &&
          is_among(words[at - 1], {"please", "you", "to", "now", "then", "so", "and", "but", "ok",
                                   "okay", "just", "also", "well", "right"}));
}

bool ends_part(const std::vector<std::string>& words, std::size_t at) {
  return at == words.size() ||
         is_among(words[at], {",", "please", "thanks", "ta", "mate", "cheers"});
}

bool is_said_by(std::string_view wanted, std::string_view said) {
  return wanted == said || (wanted == any_numeral && is_numeral(said));
}

} // namespace

Paraphrase::Paraphrase(std::string_view text, const Lists& lists) {
  const auto equals = text.find(" =");
  if (equals == std::string_view::npos)
    throw std::invalid_argument{"it does not say what says the same"};
  read_pattern(text.substr(0, equals), lists);
  read_replacement(text.substr(equals + 2));
}

void Paraphrase::read_pattern(std::string_view text, const Lists& lists) {
  for (auto& token : split(text, ' ')) {
    if (token == "<" || token == ">") {
      (token == "<" ? is_at_begin_ : is_at_end_) = true;
      continue;
    }
    Element element;
    if (token.size() > 1 && token.ends_with('?')) {
      element.is_optional = true;
      token.pop_back();
    }
    if (is_slot(token) || is_list(token))
      element.name = token;
    if (!element.name.empty() && has_element(element.name))
      throw std::invalid_argument{"\"" + token + "\" is in the pattern twice"};
    if (is_list(token)) {
      const auto list = lists.find(token.substr(1));
      if (list == lists.end())
        throw std::invalid_argument{"no list has the name \"" + token.substr(1) + '"'};
      token = list->second;
    }
    if (!is_slot(token))
      for (const auto& alternative : split(token, '|')) {
        element.alternatives.push_back(split(alternative, '_'));
        words_.insert(element.alternatives.back().begin(), element.alternatives.back().end());
      }
    pattern_.push_back(std::move(element));
  }
  words_.erase(",");
  const auto has_to_be_said = [](const Element& x) { return !x.is_slot() && !x.is_optional; };
  if (std::ranges::none_of(pattern_, has_to_be_said))
    throw std::invalid_argument{"there is no word that has to be said"};
  is_at_begin_ = is_at_begin_ || pattern_.front().is_slot();
  is_at_end_ = is_at_end_ || pattern_.back().is_slot();
}

void Paraphrase::read_replacement(std::string_view text) {
  replacement_ = split(text, ' ');
  for (const auto& word : replacement_)
    if ((is_slot(word) || is_list(word)) && !has_element(word))
      throw std::invalid_argument{"the pattern has no \"" + word + '"'};
}

bool Paraphrase::has_element(std::string_view name) const {
  return std::ranges::find(pattern_, name, &Element::name) != pattern_.end();
}

bool Paraphrase::apply(std::vector<std::string>& words) const {
  for (std::size_t begin = 0; begin < words.size(); ++begin) {
    if (is_at_begin_ && !begins_part(words, begin, pattern_.front().is_slot()))
      continue;
    Matches matches;
    const auto end = match(words, begin, 0, matches);
    if (!end || *end == begin)
      continue;
    const auto at = [&](std::size_t i) {
      return std::next(words.begin(), static_cast<std::ptrdiff_t>(i));
    };
    Words said(words.begin(), at(begin));
    for (const auto& word : replacement_)
      if (has_element(word)) {
        // What is not said is left out.
        const auto matched = std::ranges::find(matches, word, &Matches::value_type::first);
        if (matched != matches.end())
          said.insert(said.end(), at(matched->second.begin), at(matched->second.end));
      } else
        said.push_back(word);
    said.insert(said.end(), at(*end), words.end());
    words = std::move(said);
    return true;
  }
  return false;
}

/// \returns where what matches the elements from this one on ends
std::optional<std::size_t> Paraphrase::match(const Words& said, std::size_t at, std::size_t element,
                                             Matches& matches) const {
  if (element == pattern_.size())
    return is_at_end_ && !ends_part(said, at) ? std::nullopt : std::optional{at};
  const auto& wanted = pattern_[element];
  if (auto result = wanted.is_slot() ? match_slot(said, at, element, matches)
                                     : match_word(said, at, element, matches))
    return result;
  return wanted.is_optional ? match(said, at, element + 1, matches) : std::nullopt;
}

std::optional<std::size_t> Paraphrase::match_word(const Words& said, std::size_t at,
                                                  std::size_t element, Matches& matches) const {
  const auto& wanted = pattern_[element];
  const auto known = matches.size();
  for (const auto& alternative : wanted.alternatives) {
    const auto end = at + alternative.size();
    const bool is_said =
      end <= said.size() &&
      std::ranges::equal(alternative.begin(), alternative.end(),
                         std::next(said.begin(), static_cast<std::ptrdiff_t>(at)),
                         std::next(said.begin(), static_cast<std::ptrdiff_t>(end)), is_said_by);
    if (!is_said)
      continue;
    if (!wanted.name.empty())
      matches.emplace_back(wanted.name, Range{at, end});
    if (auto result = match(said, end, element + 1, matches))
      return result;
    matches.resize(known);
  }
  return std::nullopt;
}

std::optional<std::size_t> Paraphrase::match_slot(const Words& said, std::size_t at,
                                                  std::size_t element, Matches& matches) const {
  matches.emplace_back(pattern_[element].name, Range{at, at});
  const auto index = matches.size() - 1;
  for (auto end = at + 1; end <= std::min(said.size(), at + longest_slot); ++end) {
    if (said[end - 1] == ",")
      break;
    matches[index].second.end = end;
    if (auto result = match(said, end, element + 1, matches))
      return result;
  }
  matches.resize(index);
  return std::nullopt;
}

} // namespace castor::communication
