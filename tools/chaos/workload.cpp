#include "castor/tools/chaos/workload.hpp"

#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/base/text.hpp"
#include "castor/tools/chaos/action_parser.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/tools/chaos/statement_error.hpp"
#include "castor/tools/chaos/statement_parser.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor::faults {

namespace {


/// Words that stand behind the name of a thing.
bool is_joint(std::string_view word) {
  return word == "to" || word == "at" || word == "or";
}

std::string text_of_thing(const std::string& thing) {
  std::string_view rest = thing;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest))
    if (is_joint(word) || name_in_plan(std::string{word}).front() == '"')
      return quoted(thing);
  return thing;
}

std::string name_in_workload(const std::string& name) {
  return is_joint(name) ? quoted(name) : name_in_plan(name);
}

std::string text_of(const std::vector<std::string>& names) {
  std::string result;
  for (auto& x : names)
    result += (result.empty() ? "" : ", ") + name_in_workload(x);
  return result;
}

struct ActionPrinter {
  std::string operator()(const Say& x) const { return "say " + quoted(x.sentence); }
  std::string operator()(const WriteEntry& x) const {
    auto where = x.id.empty() ? x.subarchitecture : x.subarchitecture + '/' + x.id;
    return "write " + name_in_workload(x.type) + ' ' + x.value + " to " + name_in_workload(where);
  }
  std::string operator()(const MoveThing& x) const {
    return "move " + text_of_thing(x.thing) + " to " + x.x + ' ' + x.y;
  }
  std::string operator()(const AddThing& x) const {
    return "add " + text_of_thing(x.thing) + " at " + x.place;
  }
  std::string operator()(const RemoveThing& x) const { return "remove " + text_of_thing(x.thing); }
};

std::string to_string(const SameEntries& x) {
  return "same " + text_of(x.types) + (x.but_for.empty() ? "" : " but for " + text_of(x.but_for));
}

class WorkloadParser {
public:
  explicit WorkloadParser(DiagnosticLog& log) : log_(log) {}

  void read(const SourceLine& line) {
    if (line.kind != SourceLine::Kind::text || line.text.empty() || line.text.front() == '#')
      return;
    try {
      read_statement(line);
    } catch (const StatementError& e) {
      log_.report(Severity::error, line, e.what(), e.remedy());
    }
  }

  Workload take() { return std::move(workload_); }

private:
  void read_statement(const SourceLine& line) {
    auto behind = line.text;
    auto word = take_word(behind);
    if (auto seed = parse_seed(line.text))
      return set(workload_.seed, *seed);
    if (word == "expect")
      return set(workload_.answer_within, parse_expectation(behind));
    if (word == "same") {
      auto same = parse_same(behind);
      same.where = line.where();
      same.line = line.text;
      return set(workload_.same, std::move(same));
    }
    if (std::ranges::find(triggers, word) == triggers.end())
      throw StatementError(
        in_quotes(word) + " is not the beginning of a statement",
        remedy_for(word, {"at", "every", "rate", "expect", "same", "seed"},
                   "write at TIME, every TIME or rate NUMBER/s before an action, expect answer "
                   "within TIME, or same TYPE"));
    WorkloadStatement statement;
    auto rest = line.text;
    statement.trigger = parse_trigger(rest);
    statement.actions = parse_actions(rest);
    statement.where = line.where();
    statement.line = line.text;
    workload_.statements.push_back(std::move(statement));
  }

  template <class T>
  static void set(std::optional<T>& member, T value) {
    if (member)
      throw StatementError("this is said twice", "remove one of the lines");
    member = std::move(value);
  }

  static constexpr std::array<std::string_view, 3> triggers{"at", "every", "rate"};

  DiagnosticLog& log_;
  Workload workload_;
};

WorkloadResult finish(const cast::Source& source, const std::string& file, DiagnosticLog& log) {
  WorkloadParser parser{log};
  for (auto& line : source.lines)
    parser.read(line);
  WorkloadResult result;
  if (!log.has_errors()) {
    result.workload = parser.take();
    result.workload->file = file;
  }
  result.diagnostics = log.take();
  return result;
}

} // namespace

bool changes_scene(const Action& x) {
  return !std::holds_alternative<Say>(x) && !std::holds_alternative<WriteEntry>(x);
}

std::string to_string(const Action& x) {
  return std::visit(ActionPrinter{}, x);
}

std::string to_string(const WorkloadStatement& x) {
  auto result = to_string(x.trigger);
  std::string_view separator = " ";
  for (auto& action : x.actions) {
    result.append(separator).append(to_string(action));
    separator = " or ";
  }
  return result;
}

std::string to_string(const Workload& x) {
  std::string result;
  if (x.seed)
    result += "seed " + std::to_string(*x.seed) + "\n";
  for (auto& statement : x.statements)
    result += to_string(statement) + "\n";
  if (x.answer_within)
    result += "expect answer within " + to_text(*x.answer_within) + "\n";
  if (x.same)
    result += to_string(*x.same) + "\n";
  return result;
}

WorkloadResult parse_workload_file(const std::string& file, const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return finish(cast::read_source(file, options, log), file, log);
}

WorkloadResult parse_workload(std::string_view text, const std::string& file_name,
                              const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return finish(cast::read_source(text, file_name, options, log), file_name, log);
}

} // namespace castor::faults
