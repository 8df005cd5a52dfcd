#pragma once

#include "castor/base/source_location.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace castor::faults {

/// Somebody says a sentence to the robot.
struct Say {
  std::string sentence;

  friend bool operator==(const Say&, const Say&) = default;
};

/// An operator writes an entry: a new one each time, or always the one with that id.
struct WriteEntry {
  std::string type;
  /// JSON, as `castor wm add` takes it.
  std::string value;
  std::string subarchitecture;
  /// Empty for a new entry.
  std::string id;

  friend bool operator==(const WriteEntry&, const WriteEntry&) = default;
};

/// A thing on the table seen by the camera is moved. Lengths are as in scene files.
struct MoveThing {
  std::string thing;
  std::string x;
  std::string y;

  friend bool operator==(const MoveThing&, const MoveThing&) = default;
};

/// A thing is put on the table; it replaces one of the same name.
struct AddThing {
  std::string thing;
  /// The rest of the line after `at` in a scene file.
  std::string place;

  friend bool operator==(const AddThing&, const AddThing&) = default;
};

/// A thing is taken from the table.
struct RemoveThing {
  std::string thing;

  friend bool operator==(const RemoveThing&, const RemoveThing&) = default;
};

using Action = std::variant<Say, WriteEntry, MoveThing, AddThing, RemoveThing>;

/// One line of a workload: a trigger and its action. If there are several actions, one is drawn
/// each time.
struct WorkloadStatement {
  /// Never After.
  Trigger trigger;
  std::vector<Action> actions;
  /// Where it stands, and how it is written there.
  SourceLocation where;
  std::string line;

  friend bool operator==(const WorkloadStatement& a, const WorkloadStatement& b) {
    return a.trigger == b.trigger && a.actions == b.actions;
  }
};

/// Entries whose final state must be the same as in a run without faults.
struct SameEntries {
  /// Types of the entries.
  std::vector<std::string> types;
  /// Names of fields to ignore, at any depth.
  std::vector<std::string> but_for;
  SourceLocation where;
  std::string line;

  friend bool operator==(const SameEntries& a, const SameEntries& b) {
    return a.types == b.types && a.but_for == b.but_for;
  }
};

/// A change that must not happen, whatever fails.
struct ForbiddenChange {
  ChangeFilter filter;
  SourceLocation where;
  std::string line;

  friend bool operator==(const ForbiddenChange& a, const ForbiddenChange& b) {
    return a.filter == b.filter;
  }
};

/// Each entry with a change that `begin` matches has a later one that `end` matches, whatever
/// fails: at the latest that time after the last fault.
struct ExpectedChange {
  ChangeFilter begin;
  ChangeFilter end;
  Timestamp within{0};
  SourceLocation where;
  std::string line;

  friend bool operator==(const ExpectedChange& a, const ExpectedChange& b) {
    return a.begin == b.begin && a.end == b.end && a.within == b.within;
  }
};

/// Actions on a running system, and their expected results. The language is described in
/// docs/fault-plans.md.
struct Workload {
  std::string file;
  /// Seed for random choices of the statements; nothing for the seed of the faults.
  std::optional<std::uint64_t> seed;
  std::vector<WorkloadStatement> statements;
  /// Longest time to the answer to, or apology for, a sentence.
  std::optional<Timestamp> answer_within;
  /// Longest time from the last fault until nothing changes any more; nothing for a minute.
  std::optional<Timestamp> rest_within;
  /// Memory that a process may come to have in addition, bytes; nothing for what does not count as
  /// a leak (ResourceTolerance).
  std::optional<std::uint64_t> growth_within;
  std::optional<SameEntries> same;
  std::vector<ForbiddenChange> never;
  std::vector<ExpectedChange> each;

  friend bool operator==(const Workload& a, const Workload& b) {
    return a.seed == b.seed && a.statements == b.statements && a.answer_within == b.answer_within &&
           a.rest_within == b.rest_within && a.growth_within == b.growth_within &&
           a.same == b.same && a.never == b.never && a.each == b.each;
  }
};

/// Whether the action changes the scene seen by the camera.
bool changes_scene(const Action& x);

/// In the syntax of workloads.
std::string to_string(const Action& x);

/// As a line of a workload, without a line break.
std::string to_string(const WorkloadStatement& x);

/// A workload with the same statements and expectations.
std::string to_string(const Workload& x);

} // namespace castor::faults
