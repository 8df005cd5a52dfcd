#include "castor/benchmarks/people/tracking_score.hpp"

#include <algorithm>
#include <tuple>

namespace castor::benchmark {

namespace {

/// Metres between a person and a track of that person at most.
constexpr double near = 0.6;
/// A person has to be visible that long before a missing track is a miss, seconds.
constexpr double settling = 1.5;
/// An id that a person had longer ago may be given up, seconds.
constexpr double patience = 3;
/// Two people meet if they are so close, and have parted at that distance, metres.
constexpr double close = 0.8;
constexpr double parted = 1;
constexpr double hidden_at_most = 1.5; // seconds
/// Scans without a person after which a track is a false one.
constexpr int false_scans = 5;

} // namespace

void TrackingScore::add(std::span<const Truth> people,
                        std::span<const mapping::PersonTracks::Track> tracks, double time) {
  known_.resize(people.size());
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < people.size(); ++i)
    for (std::size_t j = 0; j < tracks.size(); ++j)
      if (const double off = distance(people[i].place, tracks[j].place); off < near)
        // An id that the person had already comes first.
        pairs.emplace_back(tracks[j].id == known_[i].id ? off - near : off, i, j);
  std::ranges::sort(pairs);
  std::vector<bool> has_track(people.size());
  std::vector<bool> has_person(tracks.size());
  std::vector<std::int64_t> ids(people.size());
  for (const auto& [off, i, j] : pairs) {
    if (has_track[i] || has_person[j])
      continue;
    has_track[i] = has_person[j] = true;
    ids[i] = tracks[j].id;
    if (people[i].is_visible) {
      error += distance(people[i].place, tracks[j].place);
      ++matches;
    }
  }
  for (std::size_t i = 0; i < people.size(); ++i) {
    auto& x = known_[i];
    if (!people[i].is_visible)
      x.visible_since = -1;
    else if (x.visible_since < 0)
      x.visible_since = time;
    if (people[i].is_visible && time - x.visible_since > settling) {
      ++visible;
      missed += has_track[i] ? 0 : 1;
    }
    if (!has_track[i])
      continue;
    if (x.id != 0 && ids[i] != x.id && time - x.tracked < patience)
      ++switches;
    x.id = ids[i];
    x.tracked = time;
  }
  for (std::size_t j = 0; j < tracks.size(); ++j) {
    // Of somebody who is out of sight, a track may be anywhere.
    if (has_person[j] || tracks[j].visibility < 0.4)
      continue;
    if (++of_nobody_[tracks[j].id] == false_scans)
      ++false_tracks;
  }
  watch_meetings(people, time);
  time_ = time;
}

void TrackingScore::watch_meetings(std::span<const Truth> people, double time) {
  for (std::size_t a = 0; a < people.size(); ++a)
    for (std::size_t b = a + 1; b < people.size(); ++b) {
      const double apart = distance(people[a].place, people[b].place);
      const auto meeting = meetings_.find({a, b});
      const bool in_sight = people[a].is_visible || people[b].is_visible;
      if (meeting == meetings_.end()) {
        const auto is_known = [&](const Known& x) {
          return x.id != 0 && time - x.tracked <= hidden_at_most;
        };
        if (apart < close && is_known(known_[a]) && is_known(known_[b]))
          meetings_[{a, b}] = {known_[a].id, known_[b].id, 0};
        continue;
      }
      auto& x = meeting->second;
      if (!in_sight)
        x.hidden += time - time_;
      if (apart < parted)
        continue;
      if (x.hidden <= hidden_at_most && people[a].is_visible && people[b].is_visible) {
        ++crossings;
        kept += known_[a].id == x.first && known_[b].id == x.second ? 1 : 0;
      }
      meetings_.erase(meeting);
    }
}

} // namespace castor::benchmark
