#include "castor/tools/chaos/plan_parser.hpp"

#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/tools/chaos/statement_error.hpp"
#include "castor/tools/chaos/statement_parser.hpp"

#include <utility>

namespace castor::faults {

namespace {

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

PlanResult plan_from(const cast::Source& source, const std::string& file, DiagnosticLog& log) {
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

PlanResult parse_plan_file(const std::string& file, const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return plan_from(cast::read_source(file, options, log), file, log);
}

PlanResult parse_plan(std::string_view text, const std::string& file_name,
                      const cast::ParseOptions& options) {
  DiagnosticLog log{options.limits.diagnostics};
  return plan_from(cast::read_source(text, file_name, options, log), file_name, log);
}

} // namespace castor::faults
