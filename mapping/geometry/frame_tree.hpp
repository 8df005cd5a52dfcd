#pragma once

#include "castor/mapping/geometry/transform_history.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::geometry {

/// A transform that does not fit into the tree, or a pose that cannot be had from it. The message
/// names the link that is missing.
class FrameException : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct FrameTreeOptions {
  /// How long the poses of a moving frame are remembered, counted back from the newest.
  Timestamp history = std::chrono::seconds{10};
  /// How many poses of a frame are remembered at most.
  std::size_t max_poses = 1000;
};

/// How frames lie in each other, over time: what the Transforms that were added say. Without
/// threads and clocks.
class FrameTree {
public:
  explicit FrameTree(FrameTreeOptions options = {}) : options_(options) {}

  /// Adds a pose to those of its frame, or replaces the fixed one. Throws FrameException, and
  /// changes nothing, if the frame has another parent or if this would close a cycle; or if it is
  /// no pose: a name is missing, a number is not finite, or the rotation is no unit quaternion.
  void add(const Transform& x);

  /// Forgets how the frame lies in its parent; frames within it stay in it.
  void remove(const std::string& frame);

  /// Pose of a frame in another one at that time; without a time, at the newest time at which it is
  /// known. Throws FrameException if it is not known.
  Pose pose_of(const std::string& frame, const std::string& in,
               std::optional<Timestamp> time = {}) const;

  /// The same, with nothing instead of the exception. The reason is written to `problem`, unless
  /// that is null.
  std::optional<Pose> find_pose(const std::string& frame, const std::string& in,
                                std::optional<Timestamp> time = {},
                                std::string* problem = nullptr) const;

  /// The same pose or box in another frame, at that time; as for `pose_of`.
  Pose transform(const Pose& x, const std::string& to, std::optional<Timestamp> time = {}) const;
  AlignedBox transform(const AlignedBox& x, const std::string& to,
                       std::optional<Timestamp> time = {}) const;

  /// All frames that are related to this one, without itself, in order of their names.
  std::vector<std::string> connected_to(const std::string& frame) const;

private:
  struct Link {
    std::string parent;
    TransformHistory history;
  };

  using NamedLink = std::pair<const std::string, Link>;

  /// The way from a frame to an ancestor, upwards.
  using Path = std::vector<const NamedLink*>;

  Path path_to_root(const std::string& frame) const;
  const std::string& root_of(const std::string& frame) const;
  std::string description_of_connected(const std::string& frame) const;
  static std::string description_of_known(const NamedLink& x);
  /// Newest time at which all links can be known, and one that is not known yet then, if there is
  /// one; 0 if none of them moves.
  static std::pair<Timestamp, const NamedLink*> newest_time(const Path& path);
  /// Pose of the lowest frame of the path in `top`, the parent of the highest.
  static Pose follow(const Path& path, const std::string& top, Timestamp time);

  FrameTreeOptions options_;
  /// By the frame that has a parent.
  std::map<std::string, Link> links_;
};

} // namespace castor::geometry
