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

/// What became of a fault.
enum class FaultState : std::uint8_t {
  /// It is to take effect when something comes: a callback, a write, a message over a link.
  armed,
  /// It took effect.
  happened,
  /// What it was armed for never came.
  never,
  /// It could not be injected.
  not_injected,
};

/// "armed", "happened", "never came to it", "not injected".
std::string_view to_string(FaultState x);

/// A fault that was injected, or was to be.
struct FaultRecord {
  Timestamp at{0};
  /// When it took effect.
  std::optional<Timestamp> happened;
  /// Of one that lasted: when it was over.
  std::optional<Timestamp> until;
  /// "crash", "fail journal".
  std::string kind;
  /// Component, process, link or subarchitecture.
  std::string target;
  /// As in a plan.
  std::string fault;
  FaultState state = FaultState::happened;
  /// What came of it, why it could not be injected, or why it never came to it.
  std::string outcome;
  /// What came of it and must not; empty if nothing did.
  std::string violation = {};
};

/// A component or process that was down, and what became of it.
struct Outage {
  std::string target;
  Timestamp down{0};
  /// When it was there again.
  std::optional<Timestamp> up;
  /// When its first callback after that came to an end.
  std::optional<Timestamp> first_callback;
  /// When it was given up, so that its supervisor had to decide.
  std::optional<Timestamp> escalated;
  /// It has to be back, or given up, so long after it went down.
  Timestamp bound{0};
  std::string reason;
  /// What it is: "component", "working memory".
  std::string_view kind = "component";

  /// How long it took until it worked again; nothing if it never did.
  std::optional<Timestamp> recovery() const {
    auto back = first_callback ? first_callback : up;
    return back ? std::optional{*back - down} : std::nullopt;
  }
};

/// Something that must not be.
struct Violation {
  /// Which check found it.
  std::string check;
  /// Lines of text.
  std::string text;
  std::optional<Timestamp> at;
  /// What brings it about again.
  std::uint64_t seed = 0;
  std::string replay;
};

/// One thing that was looked into.
struct CheckRecord {
  enum class Verdict : std::uint8_t { held, violated, undecided };

  std::string name;
  Verdict verdict = Verdict::held;
  /// On what grounds: "1,203 operations on 12 entries".
  std::string grounds;
};

struct ResourceSample {
  Timestamp at{0};
  /// In bytes, as far as it is resident.
  std::uint64_t memory = 0;
  /// Open file descriptors.
  std::uint64_t files = 0;
  std::uint64_t threads = 0;
};

/// Of one process: if it is started again, that is another.
struct ProcessResources {
  std::string process;
  std::vector<ResourceSample> samples;
  /// By which the system tells processes of one name apart.
  std::int64_t id = 0;
};

/// What components did while faults were injected.
struct Activity {
  /// Over how long it was measured.
  Timestamp duration{0};
  std::uint64_t callbacks = 0;
  std::uint64_t operations = 0;
  /// Of so many moments, about one a second, those in which components that had not just been
  /// started had anything to do.
  std::size_t moments = 0;
  std::size_t busy_moments = 0;

  /// Per second.
  double rate(std::uint64_t count) const {
    auto seconds = std::chrono::duration<double>(duration).count();
    return seconds > 0 ? static_cast<double>(count) / seconds : 0;
  }
};

/// All that is to be said about one run of `castor chaos`.
struct ChaosRun {
  /// The .cast file.
  std::string system;
  /// The command line that makes the same run.
  std::string command;
  std::uint64_t seed = 0;
  Timestamp duration{0};
  /// The plan, with nothing left to draw.
  std::string plan;
  std::vector<FaultRecord> faults;
  std::vector<Outage> outages;
  std::vector<CheckRecord> checks;
  std::vector<Violation> violations;
  std::vector<ProcessResources> resources;
  /// What could be hit.
  FaultTargets targets;
  /// Nothing if it was not measured.
  std::optional<Activity> activity;
  /// What was done to the system besides, if anything was.
  std::optional<WorkloadRecord> workload;
  /// What else is worth knowing: names and values.
  std::vector<std::pair<std::string, std::string>> facts;

  /// Nothing is known that must not be.
  bool held() const { return violations.empty(); }

  /// Why the run shows nothing although nothing is known that must not be: nothing went down, or
  /// most of the time nothing was going on, as far as it was long enough to tell. Empty if it shows
  /// something.
  std::string vacuous() const;
};

} // namespace castor::faults
