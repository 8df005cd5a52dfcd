#pragma once

#include "castor/mapping/geometry/types.hpp"

#include <string>

namespace castor::geometry {

// -- rotations

/// Turns `vector` by `rotation`.
Point3 rotate(const Rotation& rotation, const Point3& vector);

/// The inverse rotation.
Rotation inverse(const Rotation& rotation);

/// The rotation by `second`, followed by `first`, as in first * second * vector.
Rotation compose(const Rotation& first, const Rotation& second);

/// The rotation about the z axis by `radians`, anticlockwise as seen from above.
Rotation rotation_about_z(double radians);

/// The rotation whose images of the x, y and z axes are these; they are orthonormal, right-handed.
Rotation rotation_from_axes(const Point3& x_axis, const Point3& y_axis, const Point3& z_axis);

/// The angle of the rotation that leads from one to the other; radians, 0 to pi.
double angle_between(const Rotation& a, const Rotation& b);

/// A rotation between two, on the shorter way and at constant speed: `from` at 0, `to` at 1 (Ken
/// Shoemake, "Animating rotation with quaternion curves", 1985).
Rotation interpolate(const Rotation& from, const Rotation& to, double share);

// -- poses

/// What is at `point` of a body with that pose: the same point in the pose's frame.
Point3 transform(const Pose& body, const Point3& point);

/// Pose of a thing in the frame of `body`, if `thing` is its pose on that body.
Pose compose(const Pose& body, const Pose& thing);

/// Pose of the frame on the body, if `body` is the body's pose in that frame. The result's frame is
/// `name`, the body's.
Pose inverse(const Pose& body, std::string name);

/// A pose between two of one frame, as for rotations.
Pose interpolate(const Pose& from, const Pose& to, double share);

/// The smallest box along the axes of the body's frame that holds `box`, a box on the body.
AlignedBox transform(const Pose& body, const AlignedBox& box);

/// Distance of two points of one frame, metres.
double distance(const Point3& a, const Point3& b);

} // namespace castor::geometry
