#include "castor/planning/motivation/motive_templates.hpp"

#include "castor/base/duration.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <set>
#include <utility>

namespace castor::planning {

namespace {

constexpr std::array<std::string_view, 10> parts{
  "when", "on", "goal", "words", "because", "about", "priority", "cost", "resources", "patience"};

/// What requests say (request_values.hpp).
constexpr std::array<std::string_view, 7> request_parts{
  "text", "speaker", "patient", "patient-proxy", "destination", "destination-proxy", "relation"};

/// Names in braces.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> result;
  for (auto begin = text.find('{'); begin != std::string_view::npos;
       begin = text.find('{', begin + 1)) {
    const auto end = text.find('}', begin);
    if (end == std::string_view::npos)
      break;
    result.emplace_back(text.substr(begin + 1, end - begin - 1));
  }
  return result;
}

/// Words, variables and parentheses.
std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> result;
  bool is_in_word = false;
  for (const char c : text) {
    if (is_blank(c) || c == '(' || c == ')') {
      is_in_word = false;
      if (!is_blank(c))
        result.emplace_back(1, c);
    } else if (is_in_word) {
      result.back() += c;
    } else {
      result.emplace_back(1, c);
      is_in_word = true;
    }
  }
  return result;
}

class MotiveReader {
public:
  explicit MotiveReader(std::string file) : file_(std::move(file)) {
    // nop
  }

  MotiveTemplates read(std::string_view text) {
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      ++number_;
      line_ = text.substr(0, end);
      read_line();
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    finish();
    std::ranges::stable_sort(result_.problems, {},
                             [](const Diagnostic& x) { return x.where.line(); });
    return std::move(result_);
  }

private:
  void problem(std::size_t line, std::string message, std::string remedy) {
    Diagnostic x;
    x.where = SourceLocation(file_, line);
    if (line == number_)
      x.line = shorten(line_, 200);
    x.message = std::move(message);
    x.remedy = std::move(remedy);
    result_.problems.push_back(std::move(x));
  }

  void read_line() {
    auto rest = trim(line_.substr(0, line_.find('#')));
    if (rest.empty())
      return;
    const bool is_indented = is_blank(line_.front());
    const auto first = take_word(rest);
    rest = trim(rest);
    if (!is_indented)
      begin(first, rest);
    else if (result_.templates.empty())
      problem(number_, in_quotes(first) + " belongs to no motive", "begin with: motive NAME");
    else
      read_part(first, rest);
  }

  void begin(std::string_view first, std::string_view name) {
    finish();
    if (first != "motive" || name.empty() || name.find(' ') != std::string_view::npos) {
      problem(number_, "no motive begins here",
              "write: motive NAME, and indent what belongs to it");
      return;
    }
    for (const auto& x : result_.templates)
      if (x.name == name)
        problem(number_, "there are two motives " + in_quotes(name), "rename one of the two");
    begun_ = number_;
    seen_.clear();
    result_.templates.emplace_back().name = name;
  }

  void read_part(std::string_view part, std::string_view value) {
    auto& x = result_.templates.back();
    if (std::ranges::find(parts, part) == parts.end()) {
      const std::vector<std::string_view> known(parts.begin(), parts.end());
      const auto remedy = did_you_mean(part, known);
      return problem(number_, "a motive has no part " + in_quotes(part),
                     remedy.empty() ? "its parts are " + list_of(known, known.size()) : remedy);
    }
    if (value.empty())
      return problem(number_, "nothing stands after " + in_quotes(part),
                     "write a value, or remove it");
    if (part != "when" && !seen_.emplace(part).second)
      return problem(number_, "the motive has two parts " + in_quotes(part),
                     "remove one of the two");
    if (part == "when")
      read_occasion(x, value);
    else if (part == "priority")
      read_number(value, x.priority);
    else if (part == "cost")
      read_number(value, x.cost);
    else if (part == "patience")
      read_duration(value, x.patience);
    else if (part == "resources")
      while (!trim(value).empty())
        x.resources.emplace_back(take_word(value));
    else
      text_of(x, part) = value;
  }

  static std::string& text_of(MotiveTemplate& x, std::string_view part) {
    return part == "on"        ? x.on
           : part == "goal"    ? x.goal
           : part == "words"   ? x.words
           : part == "because" ? x.because
                               : x.about;
  }

  void read_occasion(MotiveTemplate& x, std::string_view value) {
    if (value.front() == '(') {
      const auto tokens = tokens_of(value);
      if (std::ranges::count(tokens, "(") != std::ranges::count(tokens, ")"))
        problem(number_, "the parentheses of the fact do not match",
                "write (PREDICATE OBJECT ...)");
      x.when.push_back(lower_case(value));
      return;
    }
    if (take_word(value) != "idle")
      return problem(number_, "the occasion is neither a fact nor idleness",
                     "write: when (PREDICATE ?x ...), or: when idle 30s");
    std::chrono::microseconds idle{0};
    read_duration(trim(value), idle);
    x.idle = idle;
  }

  void read_number(std::string_view text, double& result) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (error != std::errc{} || end != text.data() + text.size())
      problem(number_, in_quotes(text) + " is no number", "write a number such as 2.5");
  }

  void read_duration(std::string_view text, std::chrono::microseconds& result) {
    const auto duration = parse_duration(text);
    if (duration)
      result = std::chrono::duration_cast<std::chrono::microseconds>(*duration);
    else
      problem(number_, in_quotes(text) + " is no duration",
              "write a number and a unit: 30s, 10min");
  }

  /// Looks at the motive that has been read.
  void finish() {
    if (begun_ == 0)
      return;
    const auto& x = result_.templates.back();
    if (x.goal.empty() || x.words.empty())
      problem(begun_, "the motive " + in_quotes(x.name) + " has no goal, or no words",
              "add: goal (PREDICATE ...), and: words what is done");
    if (x.when.empty() && !x.idle && x.on.empty())
      problem(begun_, "nothing occasions the motive " + in_quotes(x.name),
              "add: when (PREDICATE ?x ...), when idle 30s, or: on ACTION, question or statement");
    if (!x.on.empty()) {
      for (const auto& name : x.names())
        if (std::ranges::find(request_parts, name) == request_parts.end())
          problem(begun_,
                  "the motive " + in_quotes(x.name) + " uses {" + name + "}, which no request has",
                  "use: " + list_of(request_parts, request_parts.size()));
    } else {
      std::set<std::string> bound;
      for (const auto& fact : x.when)
        for (const auto& token : tokens_of(fact))
          if (token.front() == '?')
            bound.insert(token.substr(1));
      for (const auto& name : x.names())
        if (!bound.contains(name))
          problem(begun_,
                  "the motive " + in_quotes(x.name) + " uses {" + name +
                    "}, which is in none of its facts",
                  "write ?" + name + " in one of them");
    }
    begun_ = 0;
  }

  std::string file_;
  MotiveTemplates result_;
  std::string_view line_;
  std::size_t number_ = 0;
  /// Line that the motive begins in; 0 for none.
  std::size_t begun_ = 0;
  std::set<std::string, std::less<>> seen_;
};

/// Values with which the pattern is the fact; false if there are none.
bool match(const std::vector<std::string>& pattern, const std::vector<std::string>& fact,
           MotiveValues& values) {
  if (pattern.size() != fact.size())
    return false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i].front() != '?') {
      if (pattern[i] != fact[i])
        return false;
    } else if (fact[i] == "(" || fact[i] == ")" ||
               values.emplace(pattern[i].substr(1), fact[i]).first->second != fact[i]) {
      return false;
    }
  }
  return true;
}

} // namespace

std::vector<std::string> MotiveTemplate::names() const {
  std::vector<std::string> result;
  for (const auto* text : {&goal, &words, &because, &about}) {
    auto names = names_in(*text);
    result.insert(result.end(), names.begin(), names.end());
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

MotiveTemplates parse_motives(const std::string& file, std::string_view text) {
  return MotiveReader(file).read(text);
}

std::optional<Motive> make_motive(const MotiveTemplate& x, const MotiveValues& values) {
  const auto has_value = [&](const std::string& name) { return values.contains(name); };
  if (!std::ranges::all_of(x.names(), has_value))
    return {};
  const auto filled = [&](std::string_view text) {
    std::string result;
    while (!text.empty()) {
      const auto begin = text.find('{');
      const auto end = begin == std::string_view::npos ? begin : text.find('}', begin);
      if (end == std::string_view::npos)
        break;
      result += text.substr(0, begin);
      result += values.find(text.substr(begin + 1, end - begin - 1))->second;
      text.remove_prefix(end + 1);
    }
    return result.append(text);
  };
  Motive result;
  result.kind = x.name;
  result.goal.goal = filled(x.goal);
  result.words = filled(x.words);
  result.because = filled(x.because);
  result.about = filled(x.about);
  result.priority = x.priority;
  result.cost = x.cost;
  result.resources = x.resources;
  result.patience = std::chrono::duration<double>(x.patience).count();
  return result;
}

std::vector<MotiveValues> matches(const std::vector<std::string>& patterns,
                                  const std::vector<std::string>& facts) {
  std::vector<std::vector<std::string>> tokens;
  for (const auto& fact : facts)
    tokens.push_back(tokens_of(lower_case(fact)));
  std::vector<MotiveValues> result{{}};
  for (const auto& pattern : patterns) {
    std::vector<MotiveValues> next;
    for (const auto& values : result)
      for (const auto& fact : tokens)
        if (auto extended = values; match(tokens_of(pattern), fact, extended))
          next.push_back(std::move(extended));
    result = std::move(next);
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

} // namespace castor::planning
