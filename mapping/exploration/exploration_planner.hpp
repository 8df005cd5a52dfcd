#pragma once

#include "castor/mapping/exploration/frontiers.hpp"
#include "castor/mapping/exploration/types.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

struct ExplorationOptions {
  FreeFloor::Options floor;
  FrontierOptions frontiers;
  /// How strongly the length of a way counts against what is to be seen, 1/m: a frontier is worth
  /// gain * exp(-aversion * cost) (H. Gonzalez-Banos and J.-C. Latombe, "Navigation strategies for
  /// exploring indoor environments", 2002, with 0.2/m). The default drove least in the generated
  /// buildings 1 to 5.
  double aversion = 0.6;
  /// How often the robot goes to a frontier at most, or tries to.
  int attempts = 2;
  /// Frontiers nearer to each other than that are taken for the same one at another time, metres.
  double same_within = 0.4;
};

/// Decides where a robot that explores goes next.
class ExplorationPlanner {
public:
  explicit ExplorationPlanner(ExplorationOptions options = {}) : options_(options) {
    // nop
  }

  /// Finds the frontiers of the map as it is now.
  void look(const CellMap& map, const Pose2& robot);

  /// The best frontier that can be gone to, by the last look; nothing if there is none.
  std::optional<Frontier> choose() const;

  /// Whether the frontier is still there, and reachable, by the last look.
  bool is_open(const Frontier& x) const;

  /// The robot was there. If the frontier remains, what is behind it cannot be seen.
  void arrived(const Frontier& x) { note(x, "what is behind it cannot be seen from near"); }
  /// The robot did not get there.
  void failed(const Frontier& x, const std::string& reason) { note(x, reason); }

  /// Frontiers by the last look.
  /// @param goal the one that is gone to
  std::vector<FrontierReport> report(const std::optional<Frontier>& goal) const;

  /// Known to be free by the last look, square metres.
  double seen() const { return seen_; }

private:
  struct Attempts {
    Point2 place;
    int count = 0;
    std::string reason;
  };

  void note(const Frontier& x, const std::string& reason);
  const Attempts* attempts_at(const Frontier& x) const;
  bool is_given_up(const Frontier& x) const;

  ExplorationOptions options_;
  std::vector<Frontier> frontiers_;
  std::vector<Attempts> attempts_;
  double seen_ = 0;
};

} // namespace castor::mapping
