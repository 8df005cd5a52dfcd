#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <span>

namespace castor::mapping {

/// How far a disc can drive at a velocity, along its arc, before its edge is within `gap` of a
/// point; metres, at most `farthest`. A point that is nearer already counts only if the disc comes
/// nearer to it still. All in the frame of the pose.
double free_arc(const Pose2& robot, const Twist2& velocity, std::span<const Point2> points,
                double radius, double gap, double farthest);

} // namespace castor::mapping
