#include "castor/communication/parsing/paraphrase.hpp"

#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace castor::communication {

namespace {

/// In words.
constexpr std::size_t longest_slot = 10;

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

} // namespace

Paraphrase::Paraphrase(std::string_view text) {
  const auto equals = text.find(" =");
  if (equals == std::string_view::npos)
    throw std::invalid_argument{"it does not say what says the same"};
  read_pattern(text.substr(0, equals));
  read_replacement(text.substr(equals + 2));
}

void Paraphrase::read_pattern(std::string_view text) {
  for (auto& token : split(text, ' ')) {
    if (token == "<" || token == ">") {
      (token == "<" ? is_at_begin_ : is_at_end_) = true;
      continue;
    }
    Element element;
    if (is_slot(token))
      element.slot = token.front();
    else {
      if (token.size() > 1 && token.ends_with('?')) {
        element.is_optional = true;
        token.pop_back();
      }
      for (const auto& alternative : split(token, '|'))
        element.alternatives.push_back(split(alternative, '_'));
      for (const auto& alternative : element.alternatives)
        words_.insert(alternative.begin(), alternative.end());
    }
    const bool is_twice = element.slot != 0 && has_slot(element.slot);
    if (is_twice)
      throw std::invalid_argument{"a slot is in the pattern twice"};
    pattern_.push_back(std::move(element));
  }
  words_.erase(",");
  if (std::ranges::none_of(pattern_, [](const auto& x) { return x.slot == 0 && !x.is_optional; }))
    throw std::invalid_argument{"there is no word that has to be said"};
  is_at_begin_ = is_at_begin_ || pattern_.front().slot != 0;
  is_at_end_ = is_at_end_ || pattern_.back().slot != 0;
}

void Paraphrase::read_replacement(std::string_view text) {
  replacement_ = split(text, ' ');
  for (const auto& word : replacement_)
    if (is_slot(word) && !has_slot(word.front()))
      throw std::invalid_argument{"the pattern has no slot \"" + word + "\""};
}

bool Paraphrase::has_slot(char name) const {
  return std::ranges::find(pattern_, name, &Element::slot) != pattern_.end();
}

bool Paraphrase::apply(std::vector<std::string>& words) const {
  for (std::size_t begin = 0; begin < words.size(); ++begin) {
    if (is_at_begin_ && !begins_part(words, begin, pattern_.front().slot != 0))
      continue;
    Slots slots;
    const auto end = match(words, begin, 0, slots);
    if (!end || *end == begin)
      continue;
    const auto at = [&](std::size_t i) {
      return std::next(words.begin(), static_cast<std::ptrdiff_t>(i));
    };
    Words said(words.begin(), at(begin));
    for (const auto& word : replacement_)
      if (is_slot(word)) {
        const auto slot =
          std::ranges::find(slots, word.front(), [](const auto& x) { return x.first; });
        said.insert(said.end(), at(slot->second.begin), at(slot->second.end));
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
                                             Slots& slots) const {
  if (element == pattern_.size())
    return is_at_end_ && !ends_part(said, at) ? std::nullopt : std::optional{at};
  const auto& wanted = pattern_[element];
  if (wanted.slot != 0)
    return match_slot(said, at, element, slots);
  for (const auto& alternative : wanted.alternatives) {
    const auto end = at + alternative.size();
    const bool is_said =
      end <= said.size() &&
      std::ranges::equal(alternative.begin(), alternative.end(),
                         std::next(said.begin(), static_cast<std::ptrdiff_t>(at)),
                         std::next(said.begin(), static_cast<std::ptrdiff_t>(end)));
    if (is_said)
      if (auto result = match(said, end, element + 1, slots))
        return result;
  }
  return wanted.is_optional ? match(said, at, element + 1, slots) : std::nullopt;
}

std::optional<std::size_t> Paraphrase::match_slot(const Words& said, std::size_t at,
                                                  std::size_t element, Slots& slots) const {
  slots.push_back({pattern_[element].slot, {at, at}});
  const auto index = slots.size() - 1;
  for (auto end = at + 1; end <= std::min(said.size(), at + longest_slot); ++end) {
    if (said[end - 1] == ",")
      break;
    slots[index].second.end = end;
    if (auto result = match(said, end, element + 1, slots))
      return result;
  }
  slots.resize(index);
  return std::nullopt;
}

} // namespace castor::communication
