#pragma once

#include "castor/planning/motivation/table_reach.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace castor::planning {

/// What an arm has said of the places of an arrangement, so that it is asked once for each of them.
/// It is asked for some places only: a place beside one that is beyond its reach counts as such.
class TableLandings {
public:
  /// \param ask may be empty: then things can be put anywhere
  explicit TableLandings(TableLanding ask = {}) : ask_(std::move(ask)) {}

  bool has_arm() const { return static_cast<bool>(ask_); }

  /// Begins to ask for places of another arrangement.
  /// \param may_put_between whether things may be put down on their way there; as that takes longer
  /// to find out, fewer places are asked for
  void begin(bool may_put_between);

  /// Whether it can be put there. False if too many places were asked for.
  bool lands(const TableThing& thing, const spatial::GroundPoint& at);

  /// Whether the arm has said that it cannot be put there, or to a place beside it.
  bool is_beyond(const TableThing& thing, const spatial::GroundPoint& at) const;

  /// The first of these points at which it can be put, rather without a stop between; nothing if
  /// there is none, or nobody to ask.
  std::optional<spatial::GroundPoint>
  first_of(const TableThing& thing, const std::vector<spatial::GroundPoint>& points) const;

  /// The thing that it cannot put at most of the places that it was asked for; null if there is
  /// none.
  const TableThing* most_often_beyond() const;

private:
  struct Said {
    const TableThing* thing = nullptr;
    spatial::GroundPoint at;
    spatial::Reach reach = spatial::Reach::none;
    /// Whether it has looked for places between.
    bool has_looked_between = false;
  };

  const Said* said_of(const TableThing& thing, const spatial::GroundPoint& at) const;

  TableLanding ask_;
  std::vector<Said> said_;
  bool may_put_between_ = true;
  std::size_t asked_ = 0;
};

} // namespace castor::planning
