#include "castor/tools/chaos/scene_text.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <array>

namespace castor::faults {

namespace {

constexpr std::array<std::string_view, 7> other_lines{"table", "camera", "image", "light",
                                                      "noise", "seed",   "after"};

bool is_colour_code(std::string_view word) {
  return word.size() == 7 && word.substr(1).find_first_not_of("0123456789abcdef") == word.npos;
}

/// In lower case, without the comment.
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> result;
  while (true) {
    auto word = lower_case(take_word(line));
    if (word.empty() || (word.front() == '#' && !is_colour_code(word)))
      return result;
    result.push_back(std::move(word));
  }
}

std::string joined(const std::vector<std::string>& words, std::size_t begin, std::size_t end) {
  std::string result;
  for (auto i = begin; i < end; ++i)
    result.append(result.empty() ? "" : " ").append(words[i]);
  return result;
}

/// A line that puts a thing on the table.
struct ThingLine {
  std::string colour_and_shape;
  /// Empty if it has none.
  std::string name;
  /// What follows the place.
  std::string rest;

  bool is(const std::string& wanted) const {
    return wanted == colour_and_shape || (!name.empty() && wanted == name);
  }
};

std::optional<ThingLine> thing_in(std::string_view line) {
  auto words = words_of(line);
  auto at = static_cast<std::size_t>(std::ranges::find(words, "at") - words.begin());
  if (at == 0 || at + 2 >= words.size() ||
      std::ranges::find(other_lines, words.front()) != other_lines.end())
    return std::nullopt;
  ThingLine result{joined(words, 0, at), {}, joined(words, at + 3, words.size())};
  constexpr std::string_view key = "name=";
  for (auto& word : words)
    if (word.starts_with(key))
      result.name = word.substr(key.size());
  return result;
}

} // namespace

SceneText::SceneText(std::string_view text) {
  while (!text.empty()) {
    auto end = std::min(text.find('\n'), text.size());
    lines_.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::vector<std::string> SceneText::things() const {
  std::vector<std::string> result;
  for (auto& line : lines_)
    if (auto thing = thing_in(line))
      result.push_back(thing->name.empty() ? thing->colour_and_shape : thing->name);
  return result;
}

std::optional<std::size_t> SceneText::find(std::string_view thing) const {
  const auto wanted = lower_case(thing);
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (auto known = thing_in(lines_[i]); known && known->is(wanted))
      return i;
  return std::nullopt;
}

void SceneText::move(std::string_view thing, std::string_view x, std::string_view y) {
  auto i = find(thing);
  if (!i)
    return;
  auto known = *thing_in(lines_[*i]);
  auto& line = lines_[*i];
  line = known.colour_and_shape + " at ";
  line.append(x).append(" ").append(y);
  if (!known.rest.empty())
    line += " " + known.rest;
}

void SceneText::add(const std::string& thing, const std::string& place) {
  remove(thing);
  lines_.push_back(thing + " at " + place);
}

void SceneText::remove(std::string_view thing) {
  if (auto i = find(thing))
    lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(*i));
}

std::string SceneText::text() const {
  std::string result;
  for (auto& line : lines_)
    result += line + '\n';
  return result;
}

} // namespace castor::faults
