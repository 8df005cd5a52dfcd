#include "castor/mapping/building/building_picture.hpp"

#include "castor/base/picture_files.hpp"
#include "castor/mapping/building/solids.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

constexpr int margin = 60; // pixels
/// Positions are drawn with so many binary digits of a pixel's fraction.
constexpr int fraction_bits = 4;

// B, G, R.
const cv::Scalar ink(60, 50, 45);
const cv::Scalar faint_ink(120, 110, 105);
const cv::Scalar route_colour(200, 90, 170);
const cv::Scalar start_colour(60, 60, 220);

/// Pale colours of rooms; neighbours in the file get different ones.
const cv::Scalar palest(246, 246, 244);
const std::array<cv::Scalar, 6> pale{cv::Scalar(214, 232, 250), cv::Scalar(222, 245, 222),
                                     cv::Scalar(250, 234, 216), cv::Scalar(210, 245, 250),
                                     cv::Scalar(240, 224, 240), cv::Scalar(238, 242, 214)};

cv::Scalar scalar(const Colour& x) {
  return {static_cast<double>(x.blue), static_cast<double>(x.green), static_cast<double>(x.red)};
}

cv::Scalar mixed(const cv::Scalar& a, const cv::Scalar& b, double share_of_b) {
  return a * (1 - share_of_b) + b * share_of_b;
}

class Plan {
public:
  Plan(const Building& x, const PictureOptions& options) : x_(x), extent_(extent(x)) {
    const double width = extent_.high.x - extent_.low.x;
    const double height = extent_.high.y - extent_.low.y;
    if (!(width > 0) || !(height > 0))
      throw std::runtime_error("the building has neither walls nor furniture that could be drawn");
    scale_ = options.size / std::max(width, height);
    constexpr int foot = 40;
    image_ =
      cv::Mat(static_cast<int>(height * scale_) + 2 * margin + foot,
              static_cast<int>(width * scale_) + 2 * margin, CV_8UC3, cv::Scalar(255, 255, 255));
  }

  std::vector<std::uint8_t> draw() {
    draw_rooms();
    for (const auto& thing : x_.furniture)
      draw_solid(thing.body, mixed(scalar(thing.body.colour), {255, 255, 255}, 0.35));
    draw_walls();
    draw_people();
    draw_start();
    for (const auto& object : x_.objects)
      draw_object(object);
    draw_labels();
    draw_scale();
    return encode_png(image_.cols, image_.rows, image_.channels(),
                      {image_.data, image_.total() * image_.elemSize()});
  }

private:
  cv::Point pixel(const Point2& p) const {
    const double x = margin + (p.x - extent_.low.x) * scale_;
    const double y = margin + (extent_.high.y - p.y) * scale_;
    constexpr double fractions = 1 << fraction_bits;
    return {static_cast<int>(std::lround(x * fractions)),
            static_cast<int>(std::lround(y * fractions))};
  }

  cv::Point whole_pixel(const Point2& p) const {
    const auto fine = pixel(p);
    return {fine.x >> fraction_bits, fine.y >> fraction_bits};
  }

  int pixels(double metres) const {
    return static_cast<int>(std::lround(metres * scale_ * (1 << fraction_bits)));
  }

  void fill(const Polygon& outline, const cv::Scalar& colour) {
    std::vector<cv::Point> points;
    for (const auto& p : outline)
      points.push_back(pixel(p));
    cv::fillPoly(image_, std::vector{points}, colour, cv::LINE_AA, fraction_bits);
  }

  void outline(const Polygon& corners, const cv::Scalar& colour, int thickness) {
    std::vector<cv::Point> points;
    for (const auto& p : corners)
      points.push_back(pixel(p));
    cv::polylines(image_, points, true, colour, thickness, cv::LINE_AA, fraction_bits);
  }

  void line(const Point2& from, const Point2& to, const cv::Scalar& colour, int thickness) {
    cv::line(image_, pixel(from), pixel(to), colour, thickness, cv::LINE_AA, fraction_bits);
  }

  void draw_rooms() {
    // Those around others first: holes are filled by what is in them.
    std::vector<std::size_t> order(x_.rooms.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t i) {
      return std::abs(signed_area(x_.rooms[i].outline));
    });
    // The largest is a neighbour of most.
    for (auto i : order) {
      fill(x_.rooms[i].outline,
           i == order.front() && order.size() > 2 ? palest : pale[i % pale.size()]);
      for (const auto& hole : x_.rooms[i].holes)
        fill(hole, {255, 255, 255});
    }
  }

  static Polygon corners(const Solid& x) {
    Polygon result;
    for (auto [a, b] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
      result.push_back(transform(x.pose, Point2{a * x.length / 2, b * x.width / 2}));
    return result;
  }

  void draw_solid(const Solid& x, const cv::Scalar& colour) {
    const auto edge = mixed(colour, ink, 0.6);
    if (x.shape == SolidShape::disc) {
      const auto centre = pixel({x.pose.x, x.pose.y});
      cv::circle(image_, centre, pixels(x.length / 2), colour, cv::FILLED, cv::LINE_AA,
                 fraction_bits);
      cv::circle(image_, centre, pixels(x.length / 2), edge, 1, cv::LINE_AA, fraction_bits);
      return;
    }
    fill(corners(x), colour);
    outline(corners(x), edge, 1);
  }

  void draw_walls() {
    auto bare = x_;
    bare.furniture.clear();
    bare.objects.clear();
    // Doors are drawn by themselves.
    for (auto& door : bare.doors)
      door.is_open = true;
    for (const auto& solid : between_heights(solids_of(bare), 0, 0.1))
      fill(corners(solid), ink);
    for (const auto& door : x_.doors)
      draw_door(door);
  }

  /// As on plans: the leaf, and the arc that it swings along if it is open.
  void draw_door(const Door& door) {
    const cv::Scalar colour(55, 95, 170);
    if (!door.is_open) {
      line(door.opening.from, door.opening.to, colour, 4);
      return;
    }
    const double width = length(door.opening);
    const double along =
      std::atan2(door.opening.to.y - door.opening.from.y, door.opening.to.x - door.opening.from.x);
    const Pose2 hinge{door.opening.from.x, door.opening.from.y, along};
    line(door.opening.from, transform(hinge, Point2{0, width}), colour, 2);
    Point2 last = door.opening.to;
    constexpr int steps = 16;
    for (int i = 1; i <= steps; ++i) {
      const double angle = std::numbers::pi / 2 * i / steps;
      const auto next = transform(hinge, Point2{width * std::cos(angle), width * std::sin(angle)});
      line(last, next, mixed(colour, {255, 255, 255}, 0.5), 1);
      last = next;
    }
  }

  void dashed(const Point2& from, const Point2& to, const cv::Scalar& colour) {
    constexpr double dash = 0.15; // metres
    const double way = distance(from, to);
    for (double at = 0; at < way; at += 2 * dash)
      line(point_at({from, to}, at / way), point_at({from, to}, std::min(1.0, (at + dash) / way)),
           colour, 2);
  }

  void draw_people() {
    for (const auto& person : x_.people) {
      for (std::size_t i = 0; i + 1 < person.route.size(); ++i)
        dashed(person.route[i], person.route[i + 1], route_colour);
      if (person.is_loop)
        dashed(person.route.back(), person.route.front(), route_colour);
      const auto& begin = person.route.front();
      cv::circle(image_, pixel(begin), pixels(person.radius), route_colour, 2, cv::LINE_AA,
                 fraction_bits);
      label(person.name, whole_pixel({begin.x, begin.y + person.radius + 0.12}), 0.5, route_colour);
    }
  }

  /// The robot's footprint, and an arrow.
  void draw_start() {
    constexpr double radius = 0.25;
    const Point2 start{x_.start.x, x_.start.y};
    cv::circle(image_, pixel(start), pixels(radius), start_colour, 2, cv::LINE_AA, fraction_bits);
    cv::arrowedLine(image_, whole_pixel(start),
                    whole_pixel(transform(x_.start, Point2{2.2 * radius, 0})), start_colour, 2,
                    cv::LINE_AA, 0, 0.35);
    label("start", whole_pixel({start.x, start.y - radius - 0.15}), 0.5, start_colour);
  }

  void draw_object(const BuildingObject& x) {
    const auto centre = pixel({x.body.pose.x, x.body.pose.y});
    // Small ones are larger than they are, so that they are seen.
    const int radius = std::max(pixels(x.body.length / 2), 5 << fraction_bits);
    cv::circle(image_, centre, radius, scalar(x.body.colour), cv::FILLED, cv::LINE_AA,
               fraction_bits);
    cv::circle(image_, centre, radius, ink, 1, cv::LINE_AA, fraction_bits);
  }

  /// Place of a text with its middle there.
  static cv::Rect place_of(const std::string& text, const cv::Point& middle, double size,
                           int thickness) {
    int below = 0;
    auto box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, thickness, &below);
    return {middle.x - box.width / 2, middle.y - box.height / 2, box.width, box.height};
  }

  /// Text with its middle there, on a pale ground.
  void label(const std::string& text, const cv::Point& middle, double size,
             const cv::Scalar& colour, int thickness = 1) {
    auto place = place_of(text, middle, size, thickness);
    place.x = std::clamp(place.x, 2, std::max(2, image_.cols - place.width - 2));
    const cv::Point at(place.x, place.y + place.height);
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, thickness + 3,
                cv::LINE_AA);
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, thickness, cv::LINE_AA);
    labels_.push_back(place + cv::Size(6, 8) - cv::Point(3, 4));
  }

  void draw_room_label(const Room& room) {
    // Where there is neither furniture nor anything else that is drawn.
    auto taken = room.holes;
    auto avoid = [&](double x, double y, double half) {
      taken.push_back(
        {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}});
    };
    for (const auto& thing : x_.furniture)
      taken.push_back(corners(thing.body));
    for (const auto& object : x_.objects)
      avoid(object.body.pose.x, object.body.pose.y, std::max(0.15, object.body.length / 2));
    for (const auto& person : x_.people)
      avoid(person.route.front().x, person.route.front().y, person.radius);
    avoid(x_.start.x, x_.start.y, 0.4);
    // Labels are wider than high: as if everything were narrower.
    constexpr double narrower = 0.4;
    auto narrow = [](Polygon outline) {
      for (auto& p : outline)
        p.x *= narrower;
      return outline;
    };
    for (auto& x : taken)
      x = narrow(std::move(x));
    const auto place = label_point(narrow(room.outline), taken);
    const auto middle = whole_pixel({place.x / narrower, place.y});
    label(room.name, {middle.x, middle.y - 8}, 0.75, ink, 2);
    char area[32];
    std::snprintf(area, sizeof area, "%.1f m2", room.area);
    label(area, {middle.x, middle.y + 14}, 0.45, faint_ink);
  }

  /// Below the object, or wherever around it no other label is.
  void draw_object_label(const BuildingObject& object) {
    constexpr double size = 0.36;
    const auto middle = whole_pixel({object.body.pose.x, object.body.pose.y});
    const auto box = place_of(object.name, middle, size, 1);
    const int radius = std::max(5, static_cast<int>(object.body.length / 2 * scale_));
    const int aside = radius + 6 + box.width / 2;
    const int away = radius + 8;
    const std::array<cv::Point, 4> places{
      cv::Point(middle.x, middle.y + away), cv::Point(middle.x, middle.y - away),
      cv::Point(middle.x + aside, middle.y), cv::Point(middle.x - aside, middle.y)};
    auto is_free = [&](const cv::Point& p) {
      const auto place = place_of(object.name, p, size, 1);
      return std::ranges::none_of(labels_,
                                  [&](const cv::Rect& x) { return (x & place).area() > 0; });
    };
    const auto* free = std::ranges::find_if(places, is_free);
    label(object.name, free == places.end() ? places.front() : *free, size, ink);
  }

  void draw_labels() {
    for (const auto& room : x_.rooms)
      if (!room.outline.empty())
        draw_room_label(room);
    for (const auto& object : x_.objects)
      draw_object_label(object);
  }

  /// A round length of about a quarter of the picture.
  void draw_scale() {
    double metres = 1;
    for (double step : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
      if (step * scale_ <= image_.cols / 4.0)
        metres = step;
    const int y = image_.rows - 45;
    const int left = margin;
    const int right = left + static_cast<int>(metres * scale_);
    cv::line(image_, {left, y}, {right, y}, ink, 3);
    for (int x : {left, right})
      cv::line(image_, {x, y - 8}, {x, y + 8}, ink, 3);
    label(std::to_string(static_cast<int>(metres)) + " m", {(left + right) / 2, y + 22}, 0.6, ink);
    if (!x_.name.empty())
      label(x_.name, {right + 120, y + 4}, 0.9, ink, 2);
  }

  const Building& x_;
  Extent extent_;
  /// Pixels per metre.
  double scale_ = 1;
  cv::Mat image_;
  /// Places of the labels so far.
  std::vector<cv::Rect> labels_;
};

} // namespace

std::vector<std::uint8_t> picture_of(const Building& x, const PictureOptions& options) {
  return Plan(x, options).draw();
}

} // namespace castor::mapping
