#include "castor/tools/chaos/fault_plan.hpp"

#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/base/text.hpp"
#include "castor/tools/chaos/statement_error.hpp"
#include "castor/tools/chaos/statement_parser.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <utility>

namespace castor::faults {

namespace {


struct TriggerPrinter {
  std::string operator()(const At& x) const { return "at " + to_text(x.time); }
  std::string operator()(const Every& x) const { return "every " + to_text(x.period); }
  std::string operator()(const AtRandom& x) const { return "rate " + to_text(x.rate); }
  std::string operator()(const After& x) const {
    std::string result = x.repeated ? "after every " : "after ";
    if (x.repeated || x.count != 1)
      result += std::to_string(x.count) + " ";
    return result + change_filter_text(x.filter) + ":";
  }
};

class PlanParser {
public:
  explicit PlanParser(DiagnosticLog& log) : log_(log) {}

  void read(const SourceLine& line) {
    if (line.kind != SourceLine::Kind::text || line.text.empty() || line.text.front() == '#')
      return;
    try {
      if (auto seed = parse_seed(line.text))
        set_seed(line, *seed);
      else
        add(line);
    } catch (const StatementError& e) {
      log_.report(Severity::error, line, e.what(), e.remedy());
    }
  }

  FaultPlan take() { return std::move(plan_); }

private:
  void set_seed(const SourceLine& line, std::uint64_t seed) {
    if (plan_.seed)
      log_.report(Severity::error, line, "the seed is given twice", "remove one of the lines");
    plan_.seed = seed;
  }

  void add(const SourceLine& line) {
    auto statement = parse_statement(line.text);
    statement.where = line.where();
    statement.line = line.text;
    plan_.statements.push_back(std::move(statement));
  }

  DiagnosticLog& log_;
  FaultPlan plan_;
};

PlanResult finish(const cast::Source& source, const std::string& file, DiagnosticLog& log) {
  PlanParser parser{log};
  for (auto& line : source.lines)
    parser.read(line);
  PlanResult result;
  if (!log.has_errors()) {
    result.plan = parser.take();
    result.plan->file = file;
  }
  result.diagnostics = log.take();
  return result;
}

} // namespace

std::vector<ChangeFilter> watched_by(const FaultPlan& x) {
  std::vector<ChangeFilter> result;
  for (auto& statement : x.statements)
    if (auto after = std::get_if<After>(&statement.trigger))
      result.push_back(after->filter);
  return result;
}

std::string to_string(const Trigger& x) {
  return std::visit(TriggerPrinter{}, x);
}

std::string to_string(const Statement& x) {
  auto result = to_string(x.trigger);
  std::string_view separator = " ";
  for (auto& fault : x.faults) {
    result.append(separator).append(to_string(fault));
    separator = " or ";
  }
  return result;
}

std::string to_string(const FaultPlan& x) {
  std::string result;
  if (x.seed)
    result += "seed " + std::to_string(*x.seed) + "\n";
  for (auto& statement : x.statements)
    result += to_string(statement) + "\n";
  return result;
}

PlanResult parse_plan_file(const std::string& file, const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return finish(cast::read_source(file, options, log), file, log);
}

PlanResult parse_plan(std::string_view text, const std::string& file_name,
                      const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return finish(cast::read_source(text, file_name, options, log), file_name, log);
}

} // namespace castor::faults
