#include "castor/tools/chaos/fault_parser.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/tools/chaos/statement_error.hpp"

#include <functional>
#include <map>

namespace castor::faults {

namespace {


constexpr std::string_view percent_remedy = "write a part such as 10% or 0.5%, up to 100%";
constexpr std::string_view link_remedy = "write between NODE and NODE, or on any link";

class FaultParser {
public:
  explicit FaultParser(std::string_view text) {
    bool unfinished = false;
    words_ = split_words(text, unfinished);
    if (unfinished)
      throw StatementError("a quote has no end", "write \" behind the name");
  }

  std::vector<Fault> run() {
    std::vector<Fault> result;
    do
      result.push_back(fault());
    while (accept("or"));
    if (!at_end())
      fail("do not know what to do with " + in_quotes(peek().text),
           peek().is("for") ? "this is not a fault that lasts"
                            : "write `for TIME` at the end of a fault, and `or` before another");
    return result;
  }

private:
  using Reader = std::function<Fault(FaultParser&)>;

  [[noreturn]] static void fail(const std::string& problem, std::string remedy) {
    throw StatementError(problem, std::move(remedy));
  }

  static const std::map<std::string_view, Reader>& readers() {
    static const std::map<std::string_view, Reader> result{
      {"crash", [](FaultParser& x) -> Fault { return Crash{x.component()}; }},
      {"throw", &FaultParser::throw_fault},
      {"hang", &FaultParser::hang},
      {"block", &FaultParser::block},
      {"slow", &FaultParser::slow},
      {"kill", [](FaultParser& x) -> Fault { return Kill{x.process()}; }},
      {"stop", &FaultParser::stop},
      {"continue", [](FaultParser& x) -> Fault { return Continue{x.process()}; }},
      {"use", &FaultParser::use_up},
      {"flood", &FaultParser::flood},
      {"partition", &FaultParser::partition},
      {"delay", &FaultParser::delay},
      {"drop", &FaultParser::disturbance<Drop>},
      {"duplicate", &FaultParser::disturbance<Duplicate>},
      {"reorder", &FaultParser::disturbance<Reorder>},
      {"fail", &FaultParser::fail_journal},
      {"remove", [](FaultParser& x) -> Fault { return RemoveJournal{x.journal()}; }},
      {"claim", [](FaultParser& x) -> Fault { return ClaimJournal{x.journal()}; }},
      {"jump", &FaultParser::jump}};
    return result;
  }

  Fault fault() {
    auto verb = next("the fault is missing",
                     "write what is to happen, such as `crash segmentor` or `stop node1 for 2s`");
    if (verb.is("for"))
      fail("how long a fault lasts stands at its end", "write at 10s hang tracker for 2s");
    auto reader = verb.quoted ? readers().end() : readers().find(verb.text);
    if (reader == readers().end()) {
      std::vector<std::string_view> verbs;
      std::string list;
      for (auto& [known, unused] : readers()) {
        verbs.push_back(known);
        list += (list.empty() ? "" : ", ") + std::string{known};
      }
      fail(in_quotes(verb.text) + " is not a fault",
           remedy_for(verb.text, verbs, "write one of " + list));
    }
    return reader->second(*this);
  }

  Fault throw_fault() {
    Throw result;
    expect("in", "write throw in callback 3 of COMPONENT, or throw in COMPONENT");
    if ((peek(1).is("of") || peek(2).is("of")) && accept("callback")) {
      auto remedy = "write which of the next callbacks, such as callback 3";
      auto word = next("the number of the callback is missing", remedy);
      auto number = parse_whole<std::uint32_t>(word.text);
      if (!number || *number == 0)
        fail(in_quotes(word.text) + " is not the number of a callback", remedy);
      result.callback = *number;
      expect("of", "write throw in callback 3 of COMPONENT");
    }
    result.component = component();
    return result;
  }

  Fault hang() {
    auto target = component();
    return Hang{std::move(target), lasting()};
  }

  Fault block() {
    auto remedy = "write block start of COMPONENT, or block configure of COMPONENT";
    Block result;
    if (accept("configure"))
      result.phase = Block::Phase::configure;
    else
      expect("start", remedy);
    expect("of", remedy);
    result.component = component();
    result.duration = lasting();
    return result;
  }

  Fault slow() {
    if (peek().is("journal") && peek(1).is("of")) {
      auto memory = journal();
      auto by = how_much();
      return SlowJournal{std::move(memory), by, lasting()};
    }
    auto target = component();
    auto by = how_much();
    return Slow{std::move(target), by, lasting()};
  }

  Fault stop() {
    auto target = process();
    return Stop{std::move(target), lasting()};
  }

  Fault use_up() {
    for (auto word : {"up", "descriptors", "of"})
      expect(word, "write use up descriptors of NODE for 2s");
    auto target = process();
    return UseUpDescriptors{std::move(target), lasting()};
  }

  Fault flood() {
    Flood result;
    result.process = process();
    if (accept("with")) {
      auto word = next("the rate is missing", std::string{rate_remedy});
      auto rate = word.quoted ? std::nullopt : parse_rate(word.text);
      if (!rate)
        fail(in_quotes(word.text) + " is not a rate", std::string{rate_remedy});
      result.rate = *rate;
    }
    result.duration = lasting();
    return result;
  }

  Fault partition() {
    Partition result;
    result.group = names();
    if (accept("from"))
      result.from = names();
    result.duration = lasting();
    return result;
  }

  Fault delay() {
    Delay result;
    result.by = time("how long the delay is");
    result.link = link();
    result.duration = lasting();
    return result;
  }

  template <class T>
  Fault disturbance() {
    T result;
    auto word = next("which part of what passes the link is missing", std::string{percent_remedy});
    auto part = parse_percent(word.text);
    if (!part)
      fail(in_quotes(word.text) + " is not a part of what passes a link",
           std::string{percent_remedy});
    result.part = *part;
    result.link = link();
    result.duration = lasting();
    return result;
  }

  Fault fail_journal() {
    auto memory = journal();
    return FailJournal{std::move(memory), lasting()};
  }

  Fault jump() {
    auto remedy = "write jump clock of SUBARCHITECTURE by 5s";
    expect("clock", remedy);
    expect("of", remedy);
    JumpClock result{memory()};
    expect("by", remedy);
    result.by = signed_time();
    return result;
  }

  // -- parts

  ComponentTarget component() {
    if (!accept("any"))
      return {name("component"), {}};
    expect("component", "write any component, or any component of SUBARCHITECTURE");
    return {{}, accept("of") ? name("subarchitecture") : std::string{}};
  }

  ProcessTarget process() {
    if (!accept("any"))
      return {name("node or of the isolated component")};
    expect("node", "write any node");
    return {};
  }

  MemoryTarget memory() {
    if (accept("any"))
      return {};
    return {name("subarchitecture")};
  }

  MemoryTarget journal() {
    auto remedy = "write journal of SUBARCHITECTURE";
    expect("journal", remedy);
    expect("of", remedy);
    return memory();
  }

  LinkTarget link() {
    if (accept("on")) {
      expect("any", std::string{link_remedy});
      expect("link", std::string{link_remedy});
      return {};
    }
    LinkTarget result;
    expect("between", std::string{link_remedy});
    result.first = name("node");
    expect("and", std::string{link_remedy});
    result.second = name("node");
    return result;
  }

  std::vector<std::string> names() {
    std::vector<std::string> result;
    do
      result.push_back(name("node"));
    while (accept(","));
    return result;
  }

  std::string name(std::string_view of_what) {
    auto problem = "the name of the " + std::string{of_what} + " is missing";
    auto word = next(problem, {});
    if (word.quoted) {
      if (word.text.empty())
        fail("the name of the " + std::string{of_what} + " is empty", {});
      return word.text;
    }
    if (word.text == ",")
      fail(problem, "remove the comma, or write a name beside it");
    if (is_reserved(word.text))
      fail(problem, "write it before " + in_quotes(word.text) + "; if that is the name, write \"" +
                      word.text + "\" with the quotes");
    if (!std::ranges::all_of(word.text, continues_name))
      fail(in_quotes(word.text) + " is not a name", "write such a name in quotes");
    return word.text;
  }

  Timestamp how_much() {
    expect("by", "write by how much, such as by 20ms");
    return time("by how much");
  }

  Timestamp time(const std::string& what) {
    auto word = next(what + " is missing", std::string{time_remedy});
    auto result = word.quoted ? std::nullopt : parse_time(word.text);
    if (!result || result->count() == 0)
      fail(in_quotes(word.text) + " is not a time above zero", std::string{time_remedy});
    return *result;
  }

  Timestamp signed_time() {
    auto backwards = !peek().quoted && peek().text.starts_with('-');
    if (backwards)
      words_[position_].text.erase(0, 1);
    auto result = time("by how much");
    return backwards ? -result : result;
  }

  Lasting lasting() {
    if (!accept("for"))
      return std::nullopt;
    return time("how long it lasts");
  }

  // -- words

  bool at_end() const { return position_ == words_.size(); }

  /// The next word, or one further on.
  const Word& peek(std::size_t distance = 0) const {
    static const Word nothing{{}, true};
    return position_ + distance < words_.size() ? words_[position_ + distance] : nothing;
  }

  Word next(const std::string& problem, std::string remedy) {
    if (at_end())
      fail(problem, std::move(remedy));
    return words_[position_++];
  }

  bool accept(std::string_view keyword) {
    if (!peek().is(keyword))
      return false;
    ++position_;
    return true;
  }

  void expect(std::string_view keyword, std::string remedy) {
    if (accept(keyword))
      return;
    if (at_end())
      fail(in_quotes(keyword) + " is missing at the end", std::move(remedy));
    fail("there is " + in_quotes(peek().text) + " where " + in_quotes(keyword) + " has to stand",
         std::move(remedy));
  }

  std::vector<Word> words_;
  std::size_t position_ = 0;
};

} // namespace

std::vector<Fault> parse_faults(std::string_view text) {
  return FaultParser{text}.run();
}

} // namespace castor::faults
