#include "castor/actors/faults/chaos_report.hpp"

#include "castor/actors/cast/text.hpp"
#include "castor/actors/faults/recovery_times.hpp"
#include "castor/actors/faults/rounded.hpp"

#include <fmt/core.h>

#include <algorithm>

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

  std::string take() { return std::move(text_); }

private:
  /// What comes out of a system under test is not to drive the terminal.
  static std::string safe(std::string_view text) { return cast::printable(text); }

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

void add_violation(Lines& out, const Violation& x) {
  out.add("");
  out.add(x.check + (x.at ? " at " + rounded(*x.at) : ""), red);
  std::string_view rest = x.text;
  while (!rest.empty()) {
    auto end = std::min(rest.find('\n'), rest.size());
    out.add("  " + std::string{rest.substr(0, end)});
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  out.add("  seed " + std::to_string(x.seed) + ", again: " + x.replay);
}

} // namespace

std::string verdict_of(const ChaosRun& run) {
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
      return "never came to it";
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

std::string to_text(const ChaosRun& run, bool coloured) {
  Lines out{coloured};
  out.add(fmt::format("{}: {} (seed {}, {}, {})", run.system, verdict_of(run), run.seed,
                      rounded(run.duration), fault_summary(run)),
          run.held() ? green : red);
  for (auto& x : run.checks)
    add_check(out, x);
  if (!run.outages.empty())
    out.add("  outages: " + recovery_summary(run));
  for (auto& [name, value] : run.facts)
    out.add("  " + name + ": " + value);
  for (auto& x : run.violations)
    add_violation(out, x);
  return out.take();
}

} // namespace castor::faults
