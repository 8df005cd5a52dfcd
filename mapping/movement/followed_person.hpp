#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>

namespace castor::mapping {

/// Somebody whom a tracker sees now, in the map frame.
struct SeenPerson {
  std::int64_t id = 0;
  Point2 place;
  /// Direction of walking, radians.
  double heading = 0;
  /// m/s.
  double speed = 0;
};

struct FollowedPersonOptions {
  /// Somebody new is the person who was lost if so near to where that one would be by now, metres.
  double reach = 1;
  /// Who was lost goes on at most so much faster than before, and not farther than that from where
  /// he was seen last, metres.
  double hurry = 1.3;
  double farthest = 4;
  /// Slower people do not walk, m/s.
  double walking = 0.3;
  /// Somebody who was lost does not come back the other way within that time; microseconds.
  std::int64_t turns_after = 10'000'000;
  /// A track that within `window` slows down to half its speed, or turns by more than that, may
  /// have been lost to something else: for so long after that, somebody new who walks on where it
  /// would be is the person. Radians, microseconds.
  double turn = 1.2;
  std::int64_t window = 1'000'000;
  std::int64_t doubt = 4'000'000;
};

/// Decides who of those in sight is the person to follow: the one with the same id, or, when that
/// id is gone or its track stops at once, somebody new where the person has to be.
class FollowedPerson {
public:
  FollowedPerson(std::int64_t id, const FollowedPersonOptions& options)
    : id_(id), options_(options) {}

  /// @param time microseconds
  std::optional<SeenPerson> find(std::span<const SeenPerson> people, std::int64_t time);

  /// Of now: a person who was lost for a while may have got another one.
  std::int64_t id() const { return id_; }

private:
  using People = std::span<const SeenPerson>;

  struct Sight {
    std::int64_t time = 0;
    SeenPerson person;
  };

  /// Whether somebody goes on as at the beginning of the window.
  bool goes_on(const SeenPerson& x) const;
  void remember(const SeenPerson& x);
  /// Where somebody who was there then is by now.
  Point2 expected(const Sight& x) const;
  /// Somebody new who walks on as the person did, while the track of the person does not.
  People::iterator find_successor(People people) const;
  /// Somebody new who may be the person who was lost.
  People::iterator find_lost(People people);
  /// Whether somebody may have walked there from where the person was seen last.
  bool may_have_walked_to(const SeenPerson& x) const;
  /// Among others, whose track has turned as well: where the two crossed, they swapped tracks.
  bool has_swapped(const SeenPerson& x) const;
  /// Whether somebody else, who walked where the track of the person goes now, was beside it when
  /// it turned.
  bool is_taken(const SeenPerson& x) const;
  void remember_all(People people);
  /// Whether somebody who comes into sight again walks the other way, as the person would not.
  bool comes_back(const SeenPerson& x) const;

  std::int64_t id_;
  FollowedPersonOptions options_;
  std::optional<Sight> last_;
  /// The window, oldest first, up to when the track went on as before.
  std::deque<Sight> steady_;
  bool is_in_doubt_ = false;
  /// Since when, microseconds.
  std::int64_t doubt_since_ = 0;
  std::int64_t time_ = 0;
  /// Those in sight lately, by id, oldest first.
  std::map<std::int64_t, std::deque<Sight>> lately_;
  /// Who was in sight together with the person, and so is somebody else.
  std::set<std::int64_t> others_;
};

} // namespace castor::mapping
