#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::manipulation {

struct CollisionOptions {
  /// Metres that are kept between the arm, with what it holds, and everything else.
  double margin = 0.005;
  /// How far the gripper is open, metres; as far as possible, if nothing is said.
  std::optional<double> opening;
  /// Names of things that the gripper, and what it holds, may touch.
  std::vector<std::string> may_touch;
};

/// Two things that touch, or are nearer to each other than the margin.
struct Contact {
  /// "the LINK", "the gripper", or the name of what is held.
  std::string part;
  /// The name of a thing of the scene, or "the LINK".
  std::string other;
  /// The arm touches itself.
  bool is_of_arm = false;
};

/// Whether two things of one frame touch.
/// \throws std::invalid_argument if a length is not more than 0.
bool overlap(const NamedSolid& a, const NamedSolid& b);

/// Collision checks of an arm in a scene, by FCL. Links that one joint joins touch always and are
/// not checked against each other, nor are those that touch in the home configuration; the base,
/// which does not move, is not checked against the scene. Not for several threads at once.
class CollisionChecker {
public:
  /// \throws std::invalid_argument if a length of a solid is not more than 0.
  CollisionChecker(const ArmModel& arm, const Scene& scene, const CollisionOptions& options = {});
  CollisionChecker(CollisionChecker&&) noexcept;
  CollisionChecker& operator=(CollisionChecker&&) noexcept;
  ~CollisionChecker();

  /// The first contact that is found, or nothing.
  /// \throws std::invalid_argument for a configuration of another arm, as all of these.
  std::optional<Contact> contact(std::span<const double> configuration);

  bool is_free(std::span<const double> configuration) { return !contact(configuration); }

  /// Distance of the arm from the nearest thing that it may not touch, metres; 0 in contact.
  /// Infinite without things.
  double clearance(std::span<const double> configuration);

  /// Two free configurations that are no further apart than this, in the Euclidean norm, have no
  /// contact between them: on the straight line no point of the arm is further than the margin from
  /// where it is in the nearer of both.
  double step() const;

  /// Whether all configurations on the straight line between two are free.
  bool is_free_between(std::span<const double> from, std::span<const double> to);

  /// How many configurations were checked.
  std::size_t checks() const;

private:
  struct World;
  std::unique_ptr<World> world_;
};

} // namespace castor::manipulation
