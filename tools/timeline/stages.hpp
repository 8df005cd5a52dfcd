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
  /// It was not there when the stage began.
  bool is_new = false;
  /// It is not there when the stage ends.
  bool is_gone = false;
  Version version = 0;
  /// When it changed first in the stage.
  Timestamp since{0};
  /// The component that changed it last, and when.
  std::string writer;
  Timestamp time{0};
  /// None if it was not known in time, or is gone.
  Value value;
};

/// What changed until the next stage began.
struct Stage {
  Timestamp begin{0};
  Timestamp end{0};
  std::map<Address, ChangedEntry> changed;
  /// How long the pause before it was; none where work only went on elsewhere.
  Timestamp pause{0};
};

struct StageOptions {
  /// What has been going on ends with a pause of so long.
  Timestamp gap = std::chrono::milliseconds{250};
  /// What repeats itself counts as going on after so many times the gap.
  int patience = 4;
  /// No more stages than these: those with the shortest pauses between them become one.
  std::size_t most = 8;
};

/// Divides what happens in working memories into stages, for people to look at, as it happens; what
/// it keeps grows with the number of entries and not with that of changes.
///
/// A stage ends where something begins after a pause. What is overwritten (added, deleted) again
/// and again is going on: it begins nothing, and prolongs nothing either once it has gone on for
/// some time. What follows without a pause is divided where it passes on from one working memory to
/// another: whatever refers to an entry elsewhere that has changed in a stage belongs to a later
/// one, and so does all that happens there afterwards. So a stage is a state that the system may
/// have been in, although not one moment of it.
class Stages {
public:
  explicit Stages(StageOptions options = {}) : options_(options) {}

  /// The changes of one working memory in their order.
  /// @param entry as it was read, perhaps later; null if it was gone
  void add(const ChangeEvent& event, const EntryPtr& entry);

  const std::list<Stage>& list() const { return stages_; }

private:
  using Place = std::list<Stage>::iterator;

  bool is_news(const ChangeEvent& event);
  void begin_burst(Timestamp time, Timestamp pause);
  /// The stage that a change belongs to, of those after the last pause.
  Place place_of(const ChangeEvent& event, const EntryPtr& entry);
  void merge_shortest();

  StageOptions options_;
  std::list<Stage> stages_;
  Links links_;
  /// Where the work of each subarchitecture is, since the last pause.
  std::map<std::string, Place> current_;
  /// Where entries have changed first, since the last pause.
  std::unordered_map<Address, Place> first_changed_;
  Place burst_ = stages_.end();
  Timestamp last_news_{0};

  struct Series {
    Timestamp begin{0};
    Timestamp last{0};
  };
  /// Of operations on a type in a working memory, without a pause between them.
  std::map<std::tuple<std::string, std::string, Operation>, Series> going_on_;
};

} // namespace castor::timeline
