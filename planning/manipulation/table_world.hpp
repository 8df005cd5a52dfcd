#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// A thing of a TableWorld.
struct WorldThing {
  /// In the arm's frame.
  NamedSolid thing;
  /// What it stands on: "the table", the name of another thing, "the floor", or "the gripper".
  std::string support;
};

/// Things on a table that can be grasped, carried, and put down. Simple statics, without time: what
/// is let go falls straight down and turns onto its nearest side. It stays on a flat top, or on the
/// table, if its middle is above it; otherwise it slides off to where it touches nothing, and may
/// fall over the edge. What stands on a thing is carried with it.
class TableWorld {
public:
  /// @param table a box; its top is where things stand
  explicit TableWorld(NamedSolid table);

  /// Lets go of a thing at its pose; it falls from there.
  /// \throws std::invalid_argument if the name is taken, or a length is not more than 0.
  void add(const NamedSolid& thing);

  /// Takes a thing out of the world; what stood on it falls.
  /// \throws std::invalid_argument if there is none of this name.
  void remove(const std::string& name);

  /// The thing that is between the fingers, which are so far open, with the tool at that pose, or
  /// null.
  const WorldThing* between_fingers(const Gripper& gripper, const Pose& tool, double opening) const;

  /// Closes the gripper, which is so far open, with the tool at that pose: it holds the thing that
  /// is between its fingers, if it holds none yet. Returns its name, or nothing if the fingers
  /// close on each other.
  std::optional<std::string> close_gripper(const Gripper& gripper, const Pose& tool,
                                           double opening);

  /// Moves the tool with what the gripper holds.
  void move_tool(const Pose& tool);

  /// Opens the gripper; what it held falls from where the tool was last. Returns its name.
  std::optional<std::string> open_gripper();

  /// Pushes a thing, and what stands on it, along x and y; it falls if its middle comes over an
  /// edge. False if it would touch another thing, or is held; nothing moves then.
  /// \throws std::invalid_argument if there is none of this name.
  bool push(const std::string& name, double x, double y);

  /// Puts all things where those of the same names in an earlier `things()` were, and the tool.
  /// \throws std::invalid_argument if there are others.
  void restore(const std::vector<WorldThing>& things, const Pose& tool);

  /// In the order in which they were added.
  const std::vector<WorldThing>& things() const { return things_; }

  /// \throws std::invalid_argument if there is none of this name.
  const WorldThing& thing(const std::string& name) const;

  /// What the gripper holds, or null.
  const WorldThing* held() const;

  /// What an arm may touch: the table, the things on it, and what is held. Things that stand on
  /// what is held are not in it.
  Scene scene() const;

private:
  std::size_t index_of(const std::string& name) const;
  std::size_t between(const Gripper& gripper, const Pose& tool, double opening) const;
  /// Indices of a thing and of what stands on it, from below.
  std::vector<std::size_t> stack(std::size_t bottom) const;
  void settle(const std::vector<std::size_t>& from_below);
  void fall(WorldThing& falling) const;
  /// Top of the thing, or the table, that a middle at this point stands on if it falls.
  const WorldThing* support_below(const WorldThing& falling) const;
  /// A thing in whose place it would be.
  const WorldThing* obstacle_at(const WorldThing& falling) const;

  NamedSolid table_;
  std::vector<WorldThing> things_;
  Pose tool_;
};

} // namespace castor::manipulation
