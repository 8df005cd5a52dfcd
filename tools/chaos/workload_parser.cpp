#include "castor/tools/chaos/workload_parser.hpp"

#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/base/text.hpp"
#include "castor/tools/chaos/action_parser.hpp"
#include "castor/tools/chaos/fault_words.hpp"
#include "castor/tools/chaos/quantities.hpp"
#include "castor/tools/chaos/statement_error.hpp"
#include "castor/tools/chaos/statement_parser.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor::faults {

namespace {

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
    if (word == "expect") {
      const auto x = parse_expectation(behind);
      if (x.kind == Expectation::Kind::growth)
        return set(workload_.growth_within, x.bytes);
      return set(x.kind == Expectation::Kind::rest ? workload_.rest_within
                                                   : workload_.answer_within,
                 x.within);
    }
    if (word == "same") {
      auto same = parse_same(behind);
      same.where = line.where();
      same.line = line.text;
      return set(workload_.same, std::move(same));
    }
    if (word == "never") {
      workload_.never.push_back({parse_forbidden(behind), line.where(), std::string{line.text}});
      return;
    }
    if (word == "each") {
      auto expected = parse_expected(behind);
      expected.where = line.where();
      expected.line = line.text;
      workload_.each.push_back(std::move(expected));
      return;
    }
    if (std::ranges::find(triggers, word) == triggers.end())
      throw StatementError(
        in_quotes(word) + " is not the beginning of a statement",
        remedy_for(word, {"at", "every", "rate", "expect", "same", "never", "each", "seed"},
                   "write at TIME, every TIME or rate NUMBER/s before an action, expect answer "
                   "within TIME, expect rest within TIME, expect growth within SIZE, same TYPE, "
                   "never FILTER, or each FILTER becomes FILTER within TIME"));
    WorkloadStatement statement;
    auto rest = line.text;
    statement.trigger = parse_trigger(rest);
    statement.actions = parse_actions(rest);
    statement.where = line.where();
    statement.line = line.text;
    workload_.statements.push_back(std::move(statement));
  }

  /// Where `wanted` first stands outside of quotes; the end of the text if it does not.
  static std::size_t find_unquoted(std::string_view text, std::string_view wanted) {
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '"' && (i == 0 || text[i - 1] != '\\'))
        is_quoted = !is_quoted;
      if (!is_quoted && text.substr(i).starts_with(wanted))
        return i;
    }
    return text.size();
  }

  /// The line up to a comment.
  static std::string_view without_comment(std::string_view text) {
    return text.substr(0, find_unquoted(text, "#"));
  }

  static ChangeFilter parse_forbidden(std::string_view text) {
    return parse_filter(without_comment(text),
                        "write what must not happen, such as never Alarm where level > 3");
  }

  static ExpectedChange parse_expected(std::string_view text) {
    constexpr std::string_view becomes = " becomes ";
    constexpr std::string_view within = " within ";
    const std::string remedy = "write each FILTER becomes FILTER within TIME, such as each added "
                               "Order becomes overwritten Order where is_served == true within 10s";
    text = without_comment(text);
    const auto middle = find_unquoted(text, becomes);
    const auto end = text.rfind(within);
    if (middle == text.size() || end == text.npos || end < middle)
      throw StatementError("it is not said what each entry is to become, and how soon", remedy);
    ExpectedChange result;
    result.begin = parse_filter(text.substr(0, middle), remedy);
    const auto behind = middle + becomes.size();
    result.end = parse_filter(text.substr(behind, std::max(end, behind) - behind), remedy);
    const auto word = trim(text.substr(end + within.size()));
    const auto time = parse_time(word);
    if (!time || time->count() == 0)
      throw StatementError(in_quotes(word) + " is not a time above zero", std::string{time_remedy});
    result.within = *time;
    return result;
  }

  static ChangeFilter parse_filter(std::string_view text, const std::string& remedy) {
    if (trim(text).empty())
      throw StatementError("the change filter is missing", remedy);
    try {
      return parse_change_filter(text);
    } catch (const ChangeFilterError& e) {
      throw StatementError(e.what(), {});
    }
  }

  template <class T>
  static void set(std::optional<T>& member, T value) {
    if (member)
      throw StatementError("this is given twice", "remove one of the lines");
    member = std::move(value);
  }

  static constexpr std::array<std::string_view, 3> triggers{"at", "every", "rate"};

  DiagnosticLog& log_;
  Workload workload_;
};

WorkloadResult workload_from(const cast::Source& source, const std::string& file,
                             DiagnosticLog& log) {
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

WorkloadResult parse_workload_file(const std::string& file, const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return workload_from(cast::read_source(file, options, log), file, log);
}

WorkloadResult parse_workload(std::string_view text, const std::string& file_name,
                              const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return workload_from(cast::read_source(text, file_name, options, log), file_name, log);
}

} // namespace castor::faults
