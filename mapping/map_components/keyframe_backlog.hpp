#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace castor::mapping {

/// A keyframe at its corrected pose in the map.
struct PlacedKeyframe {
  EntryOf<Keyframe> keyframe;
  Pose2 robot;
};

/// Keyframes that a follower has to be told of: new ones, and those whose poses were corrected. It
/// is told in passes, by increasing numbers. New keyframes join the pass that goes on; one that is
/// corrected after it was told in this pass belongs to the next one. So each pass ends, and the
/// follower has then been told of one state of all keyframes or of a newer one.
class KeyframeBacklog {
public:
  /// A keyframe is new; a known one is ignored.
  void add(const EntryOf<Keyframe>& keyframe);

  /// The entry was deleted. Returns whether the follower knows of it.
  bool remove(const std::string& id);

  /// Poses were corrected. A pose that has moved by less than a tenth of a millimetre, or of a
  /// milliradian, since the follower was told of it is not corrected.
  void correct(std::shared_ptr<const GraphPoses> graph);

  /// The next keyframe of this pass; nothing at its end.
  std::optional<PlacedKeyframe> take();

  /// Whether the pass goes on.
  bool has_next() const { return !pass_.empty(); }

  /// Highest number of a keyframe; -1 without.
  std::int64_t newest() const { return known_.empty() ? -1 : known_.rbegin()->first; }

  /// To be called at the end of a pass. Returns whether there is something to tell in the new one.
  bool begin_pass();

private:
  struct Known {
    EntryOf<Keyframe> keyframe;
    /// Pose that the follower was told of.
    std::optional<Pose2> told;
  };

  /// By number of keyframe.
  std::map<std::int64_t, Known> known_;
  std::map<std::string, std::int64_t> numbers_;
  /// Whether something of the pass was told.
  bool is_under_way_ = false;
  std::set<std::int64_t> pass_;
  std::set<std::int64_t> next_pass_;
  std::shared_ptr<const GraphPoses> graph_;
};

} // namespace castor::mapping
