#include "castor/tools/chaos/chaos_report.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/coverage.hpp"
#include "castor/tools/chaos/recovery_times.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace castor::faults {

namespace {

constexpr std::string_view red = "\033[31m";
constexpr std::string_view green = "\033[32m";
constexpr std::string_view yellow = "\033[33m";

class Lines {
public:
  explicit Lines(bool coloured) : coloured_(coloured) {}

  void add(std::string_view text, std::string_view colour = {}) {
    if (coloured_ && !colour.empty())
      text_.append(colour).append(safe(text)).append("\033[0m\n");
    else
      text_.append(safe(text)).append("\n");
  }

  /// Lines, each indented.
  void add_lines(std::string_view text) {
    while (!text.empty()) {
      auto end = std::min(text.find('\n'), text.size());
      add(end == 0 ? std::string{} : "  " + std::string{text.substr(0, end)});
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  std::string take() { return std::move(text_); }

private:
  /// What comes out of a system under test is not to drive the terminal.
  static std::string safe(std::string_view text) { return printable(text); }

  bool coloured_;
  std::string text_;
};

void add_check(Lines& out, const CheckRecord& x) {
  switch (x.verdict) {
    case CheckRecord::Verdict::held:
      out.add(fmt::format("  ok         {:<28} {}", x.name, x.grounds), green);
      return;
    case CheckRecord::Verdict::violated:
      out.add(fmt::format("  VIOLATED   {:<28} {}", x.name, x.grounds), red);
      return;
    case CheckRecord::Verdict::undecided:
      out.add(fmt::format("  undecided  {:<28} {}", x.name, x.grounds), yellow);
      return;
  }
}

void add_workload(Lines& out, const WorkloadRecord& x) {
  out.add("  workload: " + x.file + ": " + summary_of(x));
  if (!x.answer_times.empty())
    out.add("  answers: half within " + rounded(*percentile(x.answer_times, 50)) + ", all within " +
            rounded(x.answer_times.back()));
}

void add_violation(Lines& out, const Violation& x) {
  out.add("");
  out.add(x.check + (x.at ? " at " + rounded(*x.at) : ""), red);
  out.add_lines(x.text);
  out.add("  seed " + std::to_string(x.seed) + ", again: " + x.replay);
}

} // namespace

std::string ChaosRun::vacuous() const {
  if (outages.empty())
    return "nothing went down";
  constexpr std::size_t enough_moments = 10;
  if (activity && activity->moments >= enough_moments &&
      2 * activity->busy_moments < activity->moments)
    return fmt::format("idle in {} of {} samples", activity->moments - activity->busy_moments,
                       activity->moments);
  return {};
}

std::string verdict_of(const ChaosRun& run) {
  if (auto reason = run.vacuous(); run.held() && !reason.empty())
    return "vacuous, " + reason;
  if (run.held())
    return "held";
  return run.violations.size() == 1 ? "1 violation"
                                    : std::to_string(run.violations.size()) + " violations";
}

std::string_view to_string(FaultState x) {
  switch (x) {
    case FaultState::armed:
      return "armed";
    case FaultState::happened:
      return "happened";
    case FaultState::never:
      return "never triggered";
    case FaultState::not_injected:
      return "not injected";
  }
  return {};
}

std::string fault_summary(const ChaosRun& run) {
  auto count = [&](FaultState x) { return std::ranges::count(run.faults, x, &FaultRecord::state); };
  auto result =
    fmt::format("{} of {} faults happened", count(FaultState::happened), run.faults.size());
  for (auto x : {FaultState::armed, FaultState::never, FaultState::not_injected})
    if (auto n = count(x); n > 0)
      result += fmt::format(", {} {}", n, to_string(x));
  return result;
}

std::string outage_summary(const ChaosRun& run) {
  std::map<std::string_view, std::size_t> counts;
  for (auto& x : run.outages)
    ++counts[x.kind];
  std::string kinds;
  for (auto& [kind, count] : counts)
    kinds += fmt::format("{}{} {}", kinds.empty() ? ": " : ", ", kind, count);
  return counted(run.outages.size(), "outage", "outages") + kinds;
}

std::string activity_summary(const Activity& x) {
  return fmt::format("{:.1f} callbacks and {:.1f} operations a second, active in {} of {} samples",
                     x.rate(x.callbacks), x.rate(x.operations), x.busy_moments, x.moments);
}

std::string recovery_summary(const ChaosRun& run) {
  auto times = recovery_times(run.outages);
  auto given_up =
    std::ranges::count_if(run.outages, [](auto& x) { return !x.recovery() && x.escalated; });
  auto neither =
    std::ranges::count_if(run.outages, [](auto& x) { return !x.recovery() && !x.escalated; });
  auto result = fmt::format("{} back, {} given up, {} neither", times.size(), given_up, neither);
  if (!times.empty())
    result += "; half within " + rounded(*percentile(times, 50)) + ", 99 % within " +
              rounded(*percentile(times, 99)) + ", all within " + rounded(times.back());
  return result;
}

namespace {

void add_verdict(Lines& out, const ChaosRun& run) {
  auto colour = !run.held() ? red : run.vacuous().empty() ? green : yellow;
  auto activity = run.activity ? "; " + activity_summary(*run.activity) : std::string{};
  out.add(fmt::format("{}: {} ({}{}; seed {}, {})", run.system, verdict_of(run),
                      outage_summary(run), activity, run.seed, rounded(run.duration)),
          colour);
}

} // namespace

std::string to_line(const ChaosRun& run, bool coloured) {
  Lines out{coloured};
  add_verdict(out, run);
  auto result = out.take();
  result.pop_back();
  return result;
}

std::string to_text(const ChaosRun& run, bool coloured) {
  Lines out{coloured};
  add_verdict(out, run);
  out.add("  faults: " + fault_summary(run));
  if (run.workload)
    add_workload(out, *run.workload);
  for (auto& x : run.checks)
    add_check(out, x);
  if (!run.outages.empty())
    out.add("  outages: " + recovery_summary(run));
  for (auto& [name, value] : run.facts)
    out.add("  " + name + ": " + value);
  for (auto& x : run.violations)
    add_violation(out, x);
  if (auto coverage = coverage_of(run); !coverage.empty()) {
    out.add("");
    out.add_lines(to_text(coverage));
  }
  return out.take();
}

} // namespace castor::faults
