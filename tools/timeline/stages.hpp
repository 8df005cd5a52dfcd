#pragma once

#include "castor/tools/timeline/links.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstddef>
#include <list>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

namespace castor::timeline {

/// An entry at the end of a stage in which it changed.
struct ChangedEntry {
  std::string type;
  /// Added in this stage.
  bool is_new = false;
  /// Deleted in this stage.
  bool is_gone = false;
  Version version = 0;
  /// Time of the first change in the stage.
  Timestamp since{0};
  /// Writer and time of the last change.
  std::string writer;
  Timestamp time{0};
  /// Empty if it could not be read in time, or the entry was deleted.
  Value value;
};

/// Changes up to the beginning of the next stage.
struct Stage {
  Timestamp begin{0};
  Timestamp end{0};
  std::map<Address, ChangedEntry> changed;
  /// Length of the pause before it; 0 if the stage began only because activity passed to another
  /// working memory.
  Timestamp pause{0};
};

struct StageOptions {
  /// Shortest pause that ends a stage.
  Timestamp gap = std::chrono::milliseconds{250};
  /// Repeated operations are considered background activity after this many times the gap.
  int patience = 4;
  /// Maximum number of stages: those with the shortest pauses between them are merged.
  std::size_t most = 8;
};

/// Divides the changes of working memories into stages for display, while they happen. Memory use
/// grows with the number of entries, not with that of changes.
///
/// A new stage begins with the first change after a pause. Repeated overwrites (additions,
/// deletions) of a type are background activity: they begin no stage, and after some time no longer
/// prolong one. Changes without a pause in between are divided where activity passes from one
/// working memory to another: a change that refers to an entry elsewhere that changed in a stage
/// belongs to a later stage, and so do all later changes in that working memory. So a stage is a
/// consistent state of the system, although not its state at one moment.
class Stages {
public:
  explicit Stages(StageOptions options = {}) : options_(options) {}

  /// Adds a change. Changes of one working memory have to come in their order.
  /// @param entry as it was read, perhaps after later changes; null if it was deleted
  void add(const ChangeEvent& event, const EntryPtr& entry);

  const std::list<Stage>& list() const { return stages_; }

private:
  using Place = std::list<Stage>::iterator;

  bool is_news(const ChangeEvent& event);
  void begin_burst(Timestamp time, Timestamp pause);
  /// Stage of a change, among those after the last pause.
  Place place_of(const ChangeEvent& event, const EntryPtr& entry);
  void merge_shortest();

  StageOptions options_;
  std::list<Stage> stages_;
  Links links_;
  /// Current stage of each subarchitecture since the last pause.
  std::map<std::string, Place> current_;
  /// Stage of the first change of each entry since the last pause.
  std::unordered_map<Address, Place> first_changed_;
  Place burst_ = stages_.end();
  Timestamp last_news_{0};

  struct Series {
    Timestamp begin{0};
    Timestamp last{0};
  };
  /// Repeated operations on a type in a working memory, without a pause between them.
  std::map<std::tuple<std::string, std::string, Operation>, Series> going_on_;
};

} // namespace castor::timeline
