#include "castor/tools/chaos/action_parser.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/tools/chaos/statement_error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>

namespace castor::faults {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view say_remedy = R"(write say "Where is the ball?")";
constexpr std::string_view write_remedy = R"(write write TYPE {"field": 1} to SUBARCHITECTURE)";
constexpr std::string_view move_remedy = "write move red sphere to 0.1 0.2";
constexpr std::string_view add_remedy = "write add red sphere at 0.1 0.2 size 0.07";
constexpr std::string_view remove_remedy = "write remove red sphere";
constexpr std::string_view same_remedy = "write same TYPE, TYPE but for FIELD, FIELD";

/// Lists and objects within one another in a value, at most.
constexpr int deepest_value = 64;

[[noreturn]] void fail(const std::string& problem, std::string_view remedy) {
  throw StatementError(problem, std::string{remedy});
}

/// Where a JSON value ends with which the text begins: behind its closing bracket, or at the next
/// blank; the end of the text if that is missing.
std::size_t end_of_value(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (quoted)
      continue;
    else if (c == '{' || c == '[') {
      if (++depth > deepest_value)
        fail("the value has more than " + std::to_string(deepest_value) +
               " objects and lists within one another",
             "write a flatter value");
    } else if (c == '}' || c == ']') {
      if (--depth <= 0)
        return i + 1;
    } else if (depth == 0 && is_blank(c))
      return i;
  }
  return text.size();
}

/// A number, maybe with the unit of a length.
bool is_length(std::string_view word) {
  if (word.starts_with('-'))
    word.remove_prefix(1);
  for (std::string_view unit : {"mm", "cm", "m"})
    if (word.ends_with(unit)) {
      word.remove_suffix(unit.size());
      break;
    }
  auto point = std::min(word.find('.'), word.size());
  auto whole = word.substr(0, point);
  auto fraction = word.substr(std::min(point + 1, word.size()));
  return !(whole.empty() && fraction.empty()) && std::ranges::all_of(whole, is_digit) &&
         std::ranges::all_of(fraction, is_digit);
}

/// The words of a text that stands for several.
std::string with_single_blanks(std::string_view text) {
  std::string result;
  for (auto word = take_word(text); !word.empty(); word = take_word(text))
    result.append(result.empty() ? "" : " ").append(word);
  return result;
}

class ActionParser {
public:
  explicit ActionParser(std::string_view text) : rest_(text) { advance(); }

  std::vector<Action> actions() {
    std::vector<Action> result;
    do
      read_action(result);
    while (accept("or"));
    expect_end("write `or` before another action, and # before a comment");
    return result;
  }

  SameEntries same() {
    SameEntries result;
    result.types = names("type");
    if (accept("but")) {
      expect("for", same_remedy);
      result.but_for = names("field");
    }
    expect_end(same_remedy);
    return result;
  }

  Expectation expectation() {
    constexpr std::string_view remedy =
      "write expect answer within 10s, expect rest within 10min, or expect growth within 100MB";
    Expectation result;
    if (accept("growth"))
      return growth(remedy);
    if (accept("rest"))
      result.kind = Expectation::Kind::rest;
    else
      expect("answer", remedy);
    expect("within", remedy);
    auto word = next("how soon that is expected is missing", time_remedy);
    auto time = word.quoted ? std::nullopt : parse_time(word.text);
    if (!time || time->count() == 0)
      fail(in_quotes(word.text) + " is not a time above zero", time_remedy);
    expect_end(remedy);
    result.within = *time;
    return result;
  }

private:
  Expectation growth(std::string_view remedy) {
    constexpr std::string_view size_remedy = "write whole megabytes, such as 100MB";
    constexpr int most_digits = 6;
    expect("within", remedy);
    const auto word = next("how much more memory is expected is missing", size_remedy);
    const std::string_view text = word.text;
    const auto digits = std::min(text.find_first_not_of("0123456789"), text.size());
    std::uint64_t megabytes = 0;
    if (!word.quoted && digits <= most_digits && text.substr(digits) == "MB")
      std::from_chars(text.data(), text.data() + digits, megabytes);
    if (megabytes == 0)
      fail(in_quotes(word.text) + " is no size above zero", size_remedy);
    expect_end(remedy);
    Expectation result;
    result.kind = Expectation::Kind::growth;
    result.bytes = megabytes * 1'000'000;
    return result;
  }

  using Reader = void (ActionParser::*)(std::vector<Action>&);

  static const std::map<std::string_view, Reader>& readers() {
    static const std::map<std::string_view, Reader> result{{"say", &ActionParser::say},
                                                           {"write", &ActionParser::write},
                                                           {"move", &ActionParser::move},
                                                           {"add", &ActionParser::add},
                                                           {"remove", &ActionParser::remove}};
    return result;
  }

  void read_action(std::vector<Action>& out) {
    constexpr std::string_view remedy = R"(write what is done, such as say "Where is the ball?")";
    if (!next_)
      fail("the action is missing", remedy);
    auto reader = next_->quoted ? readers().end() : readers().find(next_->text);
    if (reader == readers().end()) {
      std::vector<std::string_view> verbs;
      for (auto& [verb, unused] : readers())
        verbs.push_back(verb);
      fail(in_quotes(next_->text) + " is not an action",
           remedy_for(next_->text, verbs, "write one of " + list_of(verbs, verbs.size())));
    }
    advance();
    (this->*reader->second)(out);
  }

  void say(std::vector<Action>& out) {
    do {
      auto word = next("the sentence is missing", say_remedy);
      if (!word.quoted)
        fail("the sentence does not stand in quotes", say_remedy);
      auto sentence = with_single_blanks(word.text);
      if (sentence.empty())
        fail("the sentence is empty", say_remedy);
      out.push_back(Say{std::move(sentence)});
    } while (accept_or_text());
  }

  void write(std::vector<Action>& out) {
    WriteEntry result;
    result.type = name("type", write_remedy, false);
    result.value = value();
    advance();
    expect("to", write_remedy);
    auto where = name("subarchitecture", write_remedy);
    auto slash = where.find('/');
    result.subarchitecture = where.substr(0, slash);
    if (slash != where.npos)
      result.id = where.substr(slash + 1);
    if (result.subarchitecture.empty() || (slash != where.npos && result.id.empty()))
      fail(in_quotes(where) + " is neither a subarchitecture nor an entry of one",
           "write to SUBARCHITECTURE, or to SUBARCHITECTURE/ID");
    out.push_back(std::move(result));
  }

  std::string value() {
    while (!rest_.empty() && is_blank(rest_.front()))
      rest_.remove_prefix(1);
    auto text = rest_.substr(0, end_of_value(rest_));
    rest_.remove_prefix(text.size());
    if (text.empty())
      fail("the value is missing", write_remedy);
    try {
      auto json = Json::parse(text);
      if (!json.is_object())
        fail(in_quotes(text) + " is not the value of an entry", write_remedy);
      return json.dump();
    } catch (const Json::exception&) {
      fail(in_quotes(text) + " is no JSON",
           R"(names and texts stand in double quotes: {"number": 3, "text": "a"})");
    }
  }

  void move(std::vector<Action>& out) {
    MoveThing result;
    result.thing = thing(move_remedy);
    expect("to", move_remedy);
    result.x = length(move_remedy);
    result.y = length(move_remedy);
    if (next_ && next_->is("over"))
      fail("a thing is moved instantly", "remove what follows the place");
    out.push_back(std::move(result));
  }

  void add(std::vector<Action>& out) {
    AddThing result;
    result.thing = thing(add_remedy);
    expect("at", add_remedy);
    result.place = length(add_remedy);
    result.place += ' ' + length(add_remedy);
    while (next_ && !next_->is("or")) {
      auto word = next({}, {});
      if (word.quoted || !std::ranges::all_of(word.text, continues_name))
        fail(in_quotes(word.text) + " is not part of the line of a scene", add_remedy);
      result.place += ' ' + word.text;
    }
    out.push_back(std::move(result));
  }

  void remove(std::vector<Action>& out) { out.push_back(RemoveThing{thing(remove_remedy)}); }

  /// "red sphere", or a name; in quotes whatever words it has.
  std::string thing(std::string_view remedy) {
    constexpr std::string_view problem = "which thing is missing";
    if (next_ && next_->quoted) {
      auto result = with_single_blanks(next(std::string{problem}, remedy).text);
      if (result.empty())
        fail("the name of the thing is empty", remedy);
      return result;
    }
    std::string result;
    while (next_ && !next_->quoted && !is_joint(next_->text)) {
      if (!std::ranges::all_of(next_->text, continues_name))
        fail(in_quotes(next_->text) + " is not the name of a thing", "write such a name in quotes");
      result.append(result.empty() ? "" : " ").append(next_->text);
      advance();
    }
    if (result.empty())
      fail(std::string{problem}, remedy);
    return result;
  }

  static bool is_joint(std::string_view word) {
    return word == "to" || word == "at" || word == "or";
  }

  std::string length(std::string_view remedy) {
    auto word = next("a length is missing", remedy);
    if (word.quoted || !is_length(word.text))
      fail(in_quotes(word.text) + " is not a length", remedy);
    return word.text;
  }

  std::vector<std::string> names(std::string_view of_what) {
    std::vector<std::string> result;
    do
      result.push_back(name(of_what, same_remedy));
    while (accept(","));
    return result;
  }

  /// @param and_advance whether what follows is a word, too
  std::string name(std::string_view of_what, std::string_view remedy, bool and_advance = true) {
    auto problem = "the name of the " + std::string{of_what} + " is missing";
    if (!next_)
      fail(problem, remedy);
    auto word = *next_;
    if (word.quoted && word.text.empty())
      fail("the name of the " + std::string{of_what} + " is empty", remedy);
    if (!word.quoted && (is_joint(word.text) || word.text == "," || is_reserved(word.text)))
      fail(problem, remedy);
    if (!word.quoted && !std::ranges::all_of(word.text, continues_name))
      fail(in_quotes(word.text) + " is not a name", "write such a name in quotes");
    if (and_advance)
      advance();
    return word.text;
  }

  // -- words

  void advance() {
    bool unfinished = false;
    next_ = take_next_word(rest_, unfinished);
    if (unfinished)
      fail("a quote has no end", "write \" behind the text");
  }

  Word next(const std::string& problem, std::string_view remedy) {
    if (!next_)
      fail(problem, remedy);
    auto result = *std::move(next_);
    advance();
    return result;
  }

  bool accept(std::string_view keyword) {
    if (!next_ || !next_->is(keyword))
      return false;
    advance();
    return true;
  }

  /// Whether `or` and another sentence follow; then the sentence is the next word.
  bool accept_or_text() {
    if (!next_ || !next_->is("or"))
      return false;
    auto behind = rest_;
    bool unfinished = false;
    auto word = take_next_word(behind, unfinished);
    return word && word->quoted && accept("or");
  }

  void expect(std::string_view keyword, std::string_view remedy) {
    if (accept(keyword))
      return;
    if (!next_)
      fail(in_quotes(keyword) + " is missing at the end", remedy);
    fail("there is " + in_quotes(next_->text) + " where " + in_quotes(keyword) + " has to stand",
         remedy);
  }

  void expect_end(std::string_view remedy) {
    if (next_)
      fail("do not know what to do with " + in_quotes(next_->text), remedy);
  }

  std::string_view rest_;
  std::optional<Word> next_;
};

} // namespace

std::vector<Action> parse_actions(std::string_view text) {
  return ActionParser{text}.actions();
}

SameEntries parse_same(std::string_view text) {
  return ActionParser{text}.same();
}

Expectation parse_expectation(std::string_view text) {
  return ActionParser{text}.expectation();
}

} // namespace castor::faults
