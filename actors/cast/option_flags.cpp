#include "castor/actors/cast/option_flags.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace castor::cast {

namespace {

std::vector<std::string_view> split_words(std::string_view text) {
  std::vector<std::string_view> words;
  for (auto word = take_word(text); !word.empty(); word = take_word(text))
    words.push_back(word);
  return words;
}

/// The name is empty for a word of exclamation marks only.
OptionFlag parse_flag(std::string_view word) noexcept {
  auto marks = std::min(word.find_first_not_of('!'), word.size());
  return {word.substr(marks), marks % 2 == 0};
}

using States = std::unordered_map<std::string_view, bool>;

States states_of(std::string_view text) {
  States result;
  for (const auto& flag : parse_flags(text))
    result.emplace(flag.name, flag.set);
  return result;
}

bool matches(const States& states, const OptionFlag& wanted) {
  auto found = states.find(wanted.name);
  auto set = found != states.end() && found->second;
  return set == wanted.set;
}

} // namespace

std::vector<OptionFlag> parse_flags(std::string_view text) {
  std::vector<OptionFlag> flags;
  for (auto word : split_words(text))
    if (auto flag = parse_flag(word); !flag.name.empty())
      flags.push_back(flag);
  return flags;
}

std::string merge_flags(std::string_view current, std::string_view changes, Merge merge) {
  auto current_words = split_words(current);
  auto change_words = split_words(changes);
  std::unordered_set<std::string_view> present;
  for (auto word : current_words)
    present.insert(parse_flag(word).name);
  std::unordered_map<std::string_view, std::string_view> replacements;
  if (merge == Merge::replace)
    for (auto word : change_words)
      replacements[parse_flag(word).name] = word;
  std::string result;
  auto append = [&result](std::string_view word) { result.append(word).append(" "); };
  for (auto word : current_words) {
    auto name = parse_flag(word).name;
    auto replacement = name.empty() ? replacements.end() : replacements.find(name);
    append(replacement == replacements.end() ? word : replacement->second);
  }
  for (auto word : change_words)
    if (auto name = parse_flag(word).name; !name.empty() && present.count(name) == 0)
      append(word);
  return result;
}

bool matches_any_flag(std::string_view value, std::string_view wanted) {
  auto states = states_of(value);
  auto flags = parse_flags(wanted);
  return std::any_of(flags.begin(), flags.end(),
                     [&](const OptionFlag& flag) { return matches(states, flag); });
}

bool matches_all_flags(std::string_view value, std::string_view wanted) {
  auto states = states_of(value);
  auto flags = parse_flags(wanted);
  return std::all_of(flags.begin(), flags.end(),
                     [&](const OptionFlag& flag) { return matches(states, flag); });
}

} // namespace castor::cast
