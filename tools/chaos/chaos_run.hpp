#pragma once

#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/workload_record.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::faults {

/// State of a fault.
enum class FaultState : std::uint8_t {
  /// Waits for its occasion: a callback, a write, a message over a link.
  armed,
  /// It took effect.
  happened,
  /// Its occasion never came.
  never,
  /// It could not be injected.
  not_injected,
};

/// "armed", "happened", "never triggered", "not injected".
std::string_view to_string(FaultState x);

/// A fault that was scheduled, whether or not it could be injected.
struct FaultRecord {
  Timestamp at{0};
  /// When it took effect.
  std::optional<Timestamp> happened;
  /// End of a fault that lasts.
  std::optional<Timestamp> until;
  /// "crash", "fail journal".
  std::string kind;
  /// Component, process, link or subarchitecture.
  std::string target;
  /// The fault in the syntax of plans.
  std::string fault;
  FaultState state = FaultState::happened;
  /// Effect of the fault, or why it could not be injected or never happened.
  std::string outcome;
  /// Forbidden effect of the fault; empty if there was none.
  std::string violation = {};
};

/// A period in which a component or process was down.
struct Outage {
  std::string target;
  Timestamp down{0};
  /// When it was up again.
  std::optional<Timestamp> up;
  /// When its first callback after that was completed.
  std::optional<Timestamp> first_callback;
  /// When it was given up and the failure was escalated to its supervisor.
  std::optional<Timestamp> escalated;
  /// Longest time after `down` within which it must be up again or given up.
  Timestamp bound{0};
  std::string reason;
  /// Kind of the target: "component", "working memory".
  std::string_view kind = "component";

  /// Time from `down` to the first completed callback, or to `up` if there was none; nothing if it
  /// never recovered.
  std::optional<Timestamp> recovery() const {
    auto back = first_callback ? first_callback : up;
    return back ? std::optional{*back - down} : std::nullopt;
  }
};

/// A violated promise.
struct Violation {
  /// Name of the check that found it.
  std::string check;
  /// Lines of text.
  std::string text;
  std::optional<Timestamp> at;
  /// Seed and command line that reproduce it.
  std::uint64_t seed = 0;
  std::string replay;
};

/// Result of one check.
struct CheckRecord {
  enum class Verdict : std::uint8_t { held, violated, undecided };

  std::string name;
  Verdict verdict = Verdict::held;
  /// Amount of data checked: "1,203 operations on 12 entries".
  std::string grounds;
};

struct ResourceSample {
  Timestamp at{0};
  /// Resident memory, bytes.
  std::uint64_t memory = 0;
  /// Open file descriptors.
  std::uint64_t files = 0;
  std::uint64_t threads = 0;
};

/// Resources of one process. A restarted process is another process.
struct ProcessResources {
  std::string process;
  std::vector<ResourceSample> samples;
  /// Process id, to distinguish processes of one name.
  std::int64_t id = 0;
};

/// Activity of components while faults were injected.
struct Activity {
  /// Length of the measurement.
  Timestamp duration{0};
  std::uint64_t callbacks = 0;
  std::uint64_t operations = 0;
  /// Number of samples, about one a second, and of those in which components did anything that had
  /// not just been started.
  std::size_t moments = 0;
  std::size_t busy_moments = 0;

  /// Per second.
  double rate(std::uint64_t count) const {
    auto seconds = std::chrono::duration<double>(duration).count();
    return seconds > 0 ? static_cast<double>(count) / seconds : 0;
  }
};

/// All results of one run of `castor chaos`.
struct ChaosRun {
  /// The .cast file.
  std::string system;
  /// Command line that repeats the run.
  std::string command;
  std::uint64_t seed = 0;
  Timestamp duration{0};
  /// The plan with all random choices replaced by their results.
  std::string plan;
  std::vector<FaultRecord> faults;
  std::vector<Outage> outages;
  std::vector<CheckRecord> checks;
  std::vector<Violation> violations;
  std::vector<ProcessResources> resources;
  /// Possible targets of faults.
  FaultTargets targets;
  /// Nothing if it was not measured.
  std::optional<Activity> activity;
  /// The workload that ran meanwhile, if there was one.
  std::optional<WorkloadRecord> workload;
  /// Further facts about the run: names and values.
  std::vector<std::pair<std::string, std::string>> facts;

  /// No violation was found.
  bool held() const { return violations.empty(); }

  /// Why a run without violations proves nothing: nothing went down, or components were idle most
  /// of the time (if the run was long enough to tell). Empty if it proves something.
  std::string vacuous() const;
};

} // namespace castor::faults
