#include "castor/wm/filters/change_filter_parser.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor {

namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr char quote = '"';
constexpr char escape = '\\';

class Words {
public:
  explicit Words(std::string_view text) : rest_(text) {}

  /// Empty at the end.
  std::string_view next() {
    auto result = peek();
    skip();
    rest_.remove_prefix(result.size());
    return result;
  }

  std::string_view peek() {
    skip();
    return rest_.substr(0, rest_.find_first_of(blanks));
  }

  /// A word, or in quotes any text: "two words"; `\"` and `\\` in it are the character.
  std::string next_name() {
    skip();
    if (!rest_.starts_with(quote))
      return std::string{next()};
    std::string result;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == quote) {
        rest_.remove_prefix(i + 1);
        return result;
      }
      if (rest_[i] == escape && i + 1 < rest_.size())
        ++i;
      result += rest_[i];
    }
    throw ChangeFilterError("there is no quote at the end of " + std::string{rest_});
  }

  std::string_view rest() { return std::exchange(rest_, {}); }

private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }

  std::string_view rest_;
};

const std::map<std::string_view, std::optional<Operation>> operations{
  {"added", Operation::add},
  {"ADD", Operation::add},
  {"overwritten", Operation::overwrite},
  {"OVERWRITE", Operation::overwrite},
  {"deleted", Operation::remove},
  {"DELETE", Operation::remove},
  {"changed", std::nullopt},
};

const std::set<std::string_view> clauses{"in", "from", "at", "changing", "where"};

std::string quoted(std::string_view x) {
  return '"' + std::string{x} + '"';
}

std::vector<std::string> fields(std::string_view text) {
  std::vector<std::string> result;
  while (!text.empty()) {
    auto comma = text.find(',');
    result.emplace_back(text.substr(0, comma));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return result;
}

void read_clause(Words& words, ChangeFilter& filter) {
  auto clause = words.next();
  if (clauses.count(clause) == 0)
    throw ChangeFilterError("do not know what to do with " + quoted(clause) +
                            ": before the type, write added, overwritten, deleted or changed; "
                            "after it in, from, at, changing or where");
  if (clause == "where") {
    try {
      filter.predicate = Predicate::parse(words.rest());
    } catch (const PredicateError& e) {
      throw ChangeFilterError(e.what());
    }
    return;
  }
  auto word = words.next_name();
  if (word.empty())
    throw ChangeFilterError("there is nothing behind " + quoted(clause));
  if (clause == "in")
    filter.subarchitecture = std::move(word);
  else if (clause == "from")
    filter.source = std::move(word);
  else if (clause == "at")
    filter.id = std::move(word);
  else
    filter = filter.changing_any(fields(word));
}

} // namespace

std::string change_filter_word(std::string_view x) {
  if (x.find_first_of(blanks) == std::string_view::npos && !x.starts_with(quote))
    return std::string{x};
  std::string result{quote};
  for (const char c : x) {
    if (c == quote || c == escape)
      result += escape;
    result += c;
  }
  return result + quote;
}

std::string change_filter_text(const std::vector<std::string>& arguments) {
  std::string result;
  bool names_id = false;
  for (auto& x : arguments) {
    const bool is_quoted = x.starts_with(quote);
    result += (result.empty() ? "" : " ") + (names_id && !is_quoted ? change_filter_word(x) : x);
    names_id = x == "at";
  }
  return result;
}

ChangeFilter parse_change_filter(std::string_view text) {
  ChangeFilter result;
  result.subarchitecture = "";
  Words words{text};
  if (auto i = operations.find(words.peek()); i != operations.end()) {
    result.operation = i->second;
    words.next();
  }
  if (!words.peek().empty() && clauses.count(words.peek()) == 0)
    result.type = words.next();
  while (!words.peek().empty())
    read_clause(words, result);
  return result;
}

std::string change_filter_text(const ChangeFilter& x) {
  std::string result = "changed";
  // The words as in code come after those as in traces.
  for (auto& [word, operation] : operations)
    if (operation && operation == x.operation)
      result = word;
  auto add = [&](std::string_view clause, std::string_view word) {
    if (!word.empty())
      result.append(clause).append(word);
  };
  add(" ", x.type);
  add(" in ", x.subarchitecture.value_or(""));
  add(" from ", x.source);
  add(" at ", change_filter_word(x.id));
  std::string names;
  for (auto& name : x.changing)
    names += (names.empty() ? "" : ",") + name;
  add(" changing ", names);
  add(" where ", x.predicate.text());
  return result;
}

} // namespace castor
