#pragma once

#include "castor/mapping/people/person_tracks.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace castor::benchmark {

/// Compares tracks of people with the truth, scan by scan. A person has the track that is nearest,
/// within `near`; one track is of one person.
class TrackingScore {
public:
  struct Truth {
    mapping::Point2 place;
    bool is_visible = false;
  };

  /// All in one frame, in the order of the people.
  /// @param time seconds
  void add(std::span<const Truth> people, std::span<const mapping::PersonTracks::Track> tracks,
           double time);

  // -- results

  /// Scans in which people were visible for more than `settling`, and those without a track.
  std::int64_t visible = 0;
  std::int64_t missed = 0;
  /// Sum of the distances between people and their tracks, and their number.
  double error = 0;
  std::int64_t matches = 0;
  /// People who were close to one another and parted in sight, and those who both kept their ids.
  /// Both may be hidden meanwhile, for `hidden_at_most`.
  int crossings = 0;
  int kept = 0;
  /// A visible person has another id than before.
  int switches = 0;
  /// Tracks that were of nobody for half a second.
  int false_tracks = 0;

private:
  struct Known {
    std::int64_t id = 0;
    /// Time since when the person has been visible; when there was a track.
    double visible_since = -1;
    double tracked = -1;
  };
  /// Ids of two people before they came close.
  struct Meeting {
    std::int64_t first = 0;
    std::int64_t second = 0;
    /// Time when both were out of sight, seconds.
    double hidden = 0;
  };

  void watch_meetings(std::span<const Truth> people, double time);

  std::vector<Known> known_;
  double time_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, Meeting> meetings_;
  /// Scans in which the track was of nobody.
  std::map<std::int64_t, int> of_nobody_;
};

} // namespace castor::benchmark
