#pragma once

#include "castor/wm/values/reflect.hpp"
#include "castor/wm/values/descriptor_of.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Entry types that together use everything a reflected type may hold.
namespace castor::test {

/// Gaps, and the largest number its underlying type has.
enum class Side : std::uint8_t { left, right = 7, both = 255 };
CASTOR_REFLECT_ENUM(Side, left, right, both)

enum class Trend : std::int16_t { falling = -5, flat = 0, rising = 40 };
CASTOR_REFLECT_ENUM(Trend, falling, flat, rising)

/// Beyond what a signed number holds.
enum class Huge : std::uint64_t { one = 1, all = 0xffffffffffffffff };
CASTOR_REFLECT_ENUM(Huge, one, all)

struct Nothing {
  bool operator==(const Nothing&) const = default;
};
CASTOR_REFLECT(Nothing)

struct Point {
  double x = 0;
  double y = 0;
  float z = 0;

  bool operator==(const Point&) const = default;
};
CASTOR_REFLECT(Point, x, y, z)

struct Pose {
  Point position;
  double heading = 0;

  bool operator==(const Pose&) const = default;
};
CASTOR_REFLECT(Pose, position, heading)

struct Box {
  std::string label;
  Pose pose;

  bool operator==(const Box&) const = default;
};
CASTOR_REFLECT(Box, label, pose)

struct PaintedBox : Box {
  std::vector<std::string> colours;

  bool operator==(const PaintedBox&) const = default;
};
CASTOR_REFLECT_DERIVED(PaintedBox, Box, colours)

struct SignedBox : PaintedBox {
  Side side = Side::left;
  std::optional<std::string> signature;

  bool operator==(const SignedBox&) const = default;
};
CASTOR_REFLECT_DERIVED(SignedBox, PaintedBox, side, signature)

/// Adds nothing to its base but its name.
struct Crate : Box {
  bool operator==(const Crate&) const = default;
};
CASTOR_REFLECT_DERIVED(Crate, Box)

struct Tree {
  std::string name;
  std::vector<Tree> children;

  bool operator==(const Tree&) const = default;
};
CASTOR_REFLECT(Tree, name, children)

struct Numbers {
  bool truth = false;
  std::int8_t i8 = 0;
  std::int16_t i16 = 0;
  std::int32_t i32 = 0;
  std::int64_t i64 = 0;
  std::uint8_t u8 = 0;
  std::uint16_t u16 = 0;
  std::uint32_t u32 = 0;
  std::uint64_t u64 = 0;
  float f32 = 0;
  double f64 = 0;

  bool operator==(const Numbers&) const = default;
};
CASTOR_REFLECT(Numbers, truth, i8, i16, i32, i64, u8, u16, u32, u64, f32, f64)

/// Every kind of field, and every kind inside every container that matters.
struct Rich {
  Numbers numbers;
  std::string text;
  Bytes bytes;
  std::vector<char> chars;
  Side side = Side::left;
  Trend trend = Trend::flat;
  Huge huge = Huge::one;
  std::optional<double> maybe_number;
  std::optional<Pose> maybe_pose;
  std::optional<std::vector<std::string>> maybe_texts;
  std::array<std::int16_t, 3> triple{};
  std::array<std::string, 2> pair;
  std::array<std::optional<Side>, 2> sides;
  std::vector<bool> flags;
  std::vector<std::int8_t> small;
  std::vector<double> doubles;
  std::vector<std::vector<std::uint32_t>> table;
  std::vector<std::optional<Point>> gaps;
  std::vector<std::array<float, 2>> pixels;
  std::vector<Trend> trends;
  std::vector<Bytes> blobs;
  std::vector<Nothing> nothings;
  Nothing nothing;
  SignedBox box;
  std::vector<PaintedBox> boxes;
  Tree tree;
  std::uint32_t last = 0;

  bool operator==(const Rich&) const = default;
};
CASTOR_REFLECT(Rich, numbers, text, bytes, chars, side, trend, huge, maybe_number, maybe_pose,
               maybe_texts, triple, pair, sides, flags, small, doubles, table, gaps, pixels, trends,
               blobs, nothings, nothing, box, boxes, tree, last)

/// A signed box with something in every field.
inline SignedBox signed_box() {
  SignedBox result;
  result.label = "tea";
  result.pose = {{1.5, -2.25, 0.5f}, 3.0};
  result.colours = {"red", "", "green"};
  result.side = Side::right;
  result.signature = "Nick";
  return result;
}

} // namespace castor::test
