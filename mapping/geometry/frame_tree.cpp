#include "castor/mapping/geometry/frame_tree.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <ranges>
#include <utility>

namespace castor::geometry {

namespace {

/// By how much the length of a quaternion may differ from 1, as of one written by hand.
constexpr double length_tolerance = 1e-3;

bool are_finite(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

void require_pose(const Transform& x) {
  if (x.frame.empty() || x.pose.frame.empty())
    throw FrameException(fmt::format("the transform from '{}' to '{}' lacks the name of a frame: "
                                     "set both `frame` and `pose.frame`",
                                     x.pose.frame, x.frame));
  auto& p = x.pose.position;
  auto& q = x.pose.rotation;
  if (!are_finite({p.x, p.y, p.z, q.w, q.x, q.y, q.z}))
    throw FrameException(fmt::format(
      "the transform from '{}' to '{}' has numbers that are not finite", x.pose.frame, x.frame));
  if (auto length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
      std::abs(length - 1) > length_tolerance)
    throw FrameException(fmt::format("the rotation of the transform from '{}' to '{}' is no unit "
                                     "quaternion: its length is {:.3g}. Divide it by that",
                                     x.pose.frame, x.frame, length));
}

Transform normalised(Transform x) {
  auto& q = x.pose.rotation;
  const double length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
  q = {q.w / length, q.x / length, q.y / length, q.z / length};
  return x;
}

std::string in_seconds(Timestamp x) {
  return fmt::format("{:.6g} s", std::chrono::duration<double>(x).count());
}

} // namespace

void FrameTree::add(const Transform& x) {
  require_pose(x);
  const auto& parent = x.pose.frame;
  const auto known = links_.find(x.frame);
  if (known != links_.end() && known->second.parent != parent)
    throw FrameException(fmt::format("'{0}' has the parent '{1}', so '{2}' cannot be its parent "
                                     "too: delete the Transform from '{1}' to '{0}' before",
                                     x.frame, known->second.parent, parent));
  if (known == links_.end() && root_of(parent) == x.frame) {
    std::string cycle = '\'' + x.frame + '\'';
    for (auto* link : path_to_root(parent) | std::views::reverse)
      cycle += fmt::format(" -> '{}'", link->first);
    throw FrameException(fmt::format("the transform from '{}' to '{}' would close a cycle: {} -> "
                                     "'{}'",
                                     parent, x.frame, cycle, x.frame));
  }
  auto& link = links_[x.frame];
  link.parent = parent;
  link.history.add(normalised(x), options_.history, options_.max_poses);
}

void FrameTree::remove(const std::string& frame) {
  links_.erase(frame);
}

FrameTree::Path FrameTree::path_to_root(const std::string& frame) const {
  Path result;
  for (auto link = links_.find(frame); link != links_.end();
       link = links_.find(link->second.parent))
    result.push_back(&*link);
  return result;
}

const std::string& FrameTree::root_of(const std::string& frame) const {
  const auto path = path_to_root(frame);
  return path.empty() ? frame : path.back()->second.parent;
}

std::vector<std::string> FrameTree::connected_to(const std::string& frame) const {
  const auto& root = root_of(frame);
  std::vector<std::string> result;
  if (root != frame)
    result.push_back(root);
  for (const auto& [name, link] : links_)
    if (name != frame && root_of(name) == root)
      result.push_back(name);
  std::ranges::sort(result);
  return result;
}

std::string FrameTree::description_of_known(const NamedLink& x) {
  const auto [from, to] = x.second.history.known();
  return fmt::format("that from '{}' to '{}' is known from {} to {}", x.second.parent, x.first,
                     in_seconds(from), in_seconds(to));
}

std::string FrameTree::description_of_connected(const std::string& frame) const {
  const auto others = connected_to(frame);
  return fmt::format("connected to '{}': {}", frame,
                     others.empty() ? "nothing" : fmt::format("{}", fmt::join(others, ", ")));
}

std::pair<Timestamp, const FrameTree::NamedLink*> FrameTree::newest_time(const Path& path) {
  std::optional<Timestamp> newest;
  for (const auto* x : path)
    if (!x->second.history.is_fixed())
      newest = std::min(newest.value_or(Timestamp::max()), x->second.history.known().second);
  if (!newest)
    return {};
  const auto late = std::ranges::find_if(path, [&](const auto* x) {
    return !x->second.history.is_fixed() && x->second.history.known().first > *newest;
  });
  return {*newest, late == path.end() ? nullptr : *late};
}

Pose FrameTree::follow(const Path& path, const std::string& top, Timestamp time) {
  Pose result;
  result.frame = top;
  for (const auto* x : path)
    result = compose(*x->second.history.at(time), result);
  return result;
}

std::optional<Pose> FrameTree::find_pose(const std::string& frame, const std::string& in,
                                         std::optional<Timestamp> time,
                                         std::string* problem) const {
  const auto none = [&](const auto& reason) -> std::optional<Pose> {
    if (problem)
      *problem = fmt::format("no transform between '{}' and '{}'{}: {}", in, frame,
                             time ? " at " + in_seconds(*time) : "", reason());
    return std::nullopt;
  };
  if (frame.empty() || in.empty())
    return none([] { return "a frame without a name is related to nothing"; });
  if (frame == in)
    return Pose{{}, {}, in};
  if (root_of(frame) != root_of(in))
    return none([&] {
      return fmt::format("'{}' is not connected; {}; {}", frame, description_of_connected(in),
                         description_of_connected(frame));
    });
  // Both up to where they meet.
  auto up = path_to_root(frame);
  auto down = path_to_root(in);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  if (!time) {
    auto both = up;
    both.insert(both.end(), down.begin(), down.end());
    const auto newest = newest_time(both);
    if (const auto* late = newest.second)
      return none([&] {
        return fmt::format("{}, and another one until {}", description_of_known(*late),
                           in_seconds(newest.first));
      });
    time = newest.first;
  }
  const auto& meeting = up.empty() ? frame : up.back()->second.parent;
  for (const auto* path : {&up, &down})
    for (const auto* x : *path)
      if (!x->second.history.at(*time))
        return none([&] { return description_of_known(*x); });
  return compose(inverse(follow(down, meeting, *time), in), follow(up, meeting, *time));
}

Pose FrameTree::pose_of(const std::string& frame, const std::string& in,
                        std::optional<Timestamp> time) const {
  std::string problem;
  auto result = find_pose(frame, in, time, &problem);
  if (!result)
    throw FrameException(problem);
  return *std::move(result);
}

Pose FrameTree::transform(const Pose& x, const std::string& to,
                          std::optional<Timestamp> time) const {
  return compose(pose_of(x.frame, to, time), x);
}

AlignedBox FrameTree::transform(const AlignedBox& x, const std::string& to,
                                std::optional<Timestamp> time) const {
  return geometry::transform(pose_of(x.frame, to, time), x);
}

} // namespace castor::geometry
