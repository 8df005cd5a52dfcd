#pragma once

#include "castor/base/source_location.hpp"
#include "castor/tools/chaos/fault_plan.hpp"

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

/// An operator writes an entry: a new one each time, or always the one of that id.
struct WriteEntry {
  std::string type;
  /// JSON, as `castor wm add` takes it.
  std::string value;
  std::string subarchitecture;
  /// Empty for a new entry.
  std::string id;

  friend bool operator==(const WriteEntry&, const WriteEntry&) = default;
};

/// A thing on the table that the camera sees is put elsewhere. Lengths are as in scene files.
struct MoveThing {
  std::string thing;
  std::string x;
  std::string y;

  friend bool operator==(const MoveThing&, const MoveThing&) = default;
};

/// A thing is put on the table; one that is called the same goes.
struct AddThing {
  std::string thing;
  /// What follows `at` in a scene file.
  std::string place;

  friend bool operator==(const AddThing&, const AddThing&) = default;
};

/// A thing is taken from the table.
struct RemoveThing {
  std::string thing;

  friend bool operator==(const RemoveThing&, const RemoveThing&) = default;
};

using Action = std::variant<Say, WriteEntry, MoveThing, AddThing, RemoveThing>;

/// One line of a workload: when something is done, and what. Of several actions one is drawn each
/// time.
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

/// Which entries have to be the same in the end as in a run without faults.
struct SameEntries {
  /// Of these types.
  std::vector<std::string> types;
  /// Fields that do not count, wherever they stand.
  std::vector<std::string> but_for;
  SourceLocation where;
  std::string line;

  friend bool operator==(const SameEntries& a, const SameEntries& b) {
    return a.types == b.types && a.but_for == b.but_for;
  }
};

/// What people and programs do to a system while it runs, and what has to come of it. The language
/// is described in docs/fault-plans.md.
struct Workload {
  std::string file;
  /// Draws what the statements leave open; nothing for the seed of the faults.
  std::optional<std::uint64_t> seed;
  std::vector<WorkloadStatement> statements;
  /// Every sentence has to be answered, or apologised for, so soon.
  std::optional<Timestamp> answer_within;
  std::optional<SameEntries> same;

  friend bool operator==(const Workload& a, const Workload& b) {
    return a.seed == b.seed && a.statements == b.statements && a.answer_within == b.answer_within &&
           a.same == b.same;
  }
};

/// Whether it is a change of the scene that the camera sees.
bool changes_scene(const Action& x);

/// As in a workload.
std::string to_string(const Action& x);

/// As a line of a workload, without a line break.
std::string to_string(const WorkloadStatement& x);

/// A workload with the same statements and expectations.
std::string to_string(const Workload& x);

} // namespace castor::faults
