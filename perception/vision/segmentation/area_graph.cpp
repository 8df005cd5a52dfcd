#include "castor/perception/vision/segmentation/area_graph.hpp"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace castor::vision {

namespace {

void add(ColourSum& sum, const Colour& colour) {
  for (std::size_t c = 0; c < sum.size(); ++c)
    sum[c] += static_cast<double>(colour[c]);
}

void add(ColourSum& sum, const ColourSum& other) {
  for (std::size_t c = 0; c < sum.size(); ++c)
    sum[c] += other[c];
}

auto find_contact(std::vector<Contact>& contacts, int id) {
  return std::find_if(contacts.begin(), contacts.end(),
                      [id](const Contact& contact) { return contact.area == id; });
}

void add_contact(std::vector<Contact>& contacts, const Contact& contact) {
  const auto found = find_contact(contacts, contact.area);
  if (found == contacts.end()) {
    contacts.push_back(contact);
  } else {
    found->length += contact.length;
    found->contrast += contact.contrast;
  }
}

void remove_contact(std::vector<Contact>& contacts, int id) {
  const auto found = find_contact(contacts, id);
  if (found != contacts.end()) {
    *found = contacts.back();
    contacts.pop_back();
  }
}

std::vector<Corner> convex_hull(const std::vector<cv::Point>& points) {
  std::vector<cv::Point> corners;
  cv::convexHull(points, corners);
  std::vector<Corner> result;
  result.reserve(corners.size());
  for (const auto& corner : corners)
    result.push_back({corner.x, corner.y});
  return result;
}

std::vector<Corner> convex_hull(const std::vector<Corner>& a, const std::vector<Corner>& b) {
  std::vector<cv::Point> points;
  points.reserve(a.size() + b.size());
  for (const auto* corners : {&a, &b}) {
    for (const auto& corner : *corners)
      points.emplace_back(corner.x, corner.y);
  }
  return convex_hull(points);
}

} // namespace

int Area::boundary() const {
  int length = 0;
  for (const auto& contact : contacts)
    length += contact.length;
  return length;
}

AreaGraph::AreaGraph(Division division, const WorkingPicture& picture)
  : labels_(std::move(division.area)), areas_(static_cast<std::size_t>(division.count)) {
  const int width = labels_.width();
  const int height = labels_.height();
  const auto touch = [&](int cell, int next) {
    const int a = labels_[cell];
    const int b = labels_[next];
    if (a == b)
      return;
    const double contrast =
      static_cast<double>(std::max(picture.contrast[cell], picture.contrast[next]));
    add_contact(mutable_area(a).contacts, {b, 1, contrast});
    add_contact(mutable_area(b).contacts, {a, 1, contrast});
  };
  for (int cell = 0; cell < labels_.size(); ++cell) {
    const int x = cell % width;
    const int y = cell / width;
    Area& area = mutable_area(labels_[cell]);
    area.cells.push_back(cell);
    add(area.light, linear(picture.colour[cell]));
    add(area.lab, picture.lab[cell]);
    if (x == 0 || y == 0 || x + 1 == width || y + 1 == height)
      ++area.border;
    if (x + 1 < width)
      touch(cell, cell + 1);
    if (y + 1 < height)
      touch(cell, cell + width);
  }
}

int AreaGraph::join(int a, int b) {
  if (b == ground_ || (a != ground_ && area(b).cells.size() > area(a).cells.size()))
    std::swap(a, b);
  Area& into = mutable_area(a);
  Area& from = mutable_area(b);
  for (const int cell : from.cells)
    labels_[cell] = a;
  into.cells.insert(into.cells.end(), from.cells.begin(), from.cells.end());
  into.border += from.border;
  add(into.light, from.light);
  add(into.lab, from.lab);
  add(into.ground_light, from.ground_light);
  add(into.ground_lab, from.ground_lab);
  remove_contact(into.contacts, b);
  for (const auto& contact : from.contacts) {
    if (contact.area == a)
      continue;
    add_contact(into.contacts, contact);
    auto& theirs = mutable_area(contact.area).contacts;
    remove_contact(theirs, b);
    add_contact(theirs, {a, contact.length, contact.contrast});
  }
  if (into.hull.empty() || from.hull.empty())
    into.hull.clear();
  else
    into.hull = convex_hull(into.hull, from.hull);
  from = {};
  return a;
}

const Contact* AreaGraph::contact(int a, int b) const {
  const auto& contacts = area(a).contacts;
  const auto found = std::find_if(contacts.begin(), contacts.end(),
                                  [b](const Contact& contact) { return contact.area == b; });
  return found == contacts.end() ? nullptr : &*found;
}

void AreaGraph::set_ground_colours(const Grid<Colour>& colour, const Grid<Colour>& lab,
                                   const Grid<Colour>& own_lab) {
  shade_ = Grid<float>(lab.width(), lab.height());
  for (int cell = 0; cell < lab.size(); ++cell)
    shade_[cell] = own_lab[cell][0] / std::max(1.0F, lab[cell][0]);
  for (int id = 0; id < count(); ++id) {
    if (!is_part(id))
      continue;
    Area& part = mutable_area(id);
    for (const int cell : part.cells) {
      add(part.ground_light, linear(colour[cell]));
      add(part.ground_lab, lab[cell]);
    }
  }
}

const std::vector<Corner>& AreaGraph::hull(int id) {
  Area& part = mutable_area(id);
  if (part.hull.empty()) {
    std::vector<cv::Point> points;
    points.reserve(part.cells.size());
    for (const int cell : part.cells)
      points.emplace_back(cell % labels_.width(), cell / labels_.width());
    part.hull = convex_hull(points);
  }
  return part.hull;
}

HullRest AreaGraph::hull_rest(int a, int b) {
  const auto corners = convex_hull(hull(a), hull(b));
  std::vector<cv::Point> polygon;
  polygon.reserve(corners.size());
  for (const auto& corner : corners)
    polygon.emplace_back(corner.x, corner.y);
  const cv::Rect box = cv::boundingRect(polygon);
  for (auto& corner : polygon)
    corner -= box.tl();
  cv::Mat_<std::uint8_t> inside(box.size(), std::uint8_t{0});
  cv::fillConvexPoly(inside, polygon, 1);
  int ground = 0;
  int others = 0;
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      if (inside(y, x) == 0)
        continue;
      const int id = labels_.at(x + box.x, y + box.y);
      if (id == ground_)
        ++ground;
      else if (id != a && id != b)
        ++others;
    }
  }
  const double own = area(a).pixels() + area(b).pixels();
  return {ground / own, others / own};
}

} // namespace castor::vision
