#pragma once

#include <array>
#include <vector>

#include "castor/perception/vision/segmentation/grid.hpp"
#include "castor/perception/vision/segmentation/watershed.hpp"
#include "castor/perception/vision/segmentation/working_picture.hpp"

namespace castor::vision {

/// Boundary of an area with another one.
struct Contact {
  int area = 0;
  /// The number of neighbouring pixel pairs across the boundary, and the sum of their contrasts.
  int length = 0;
  double contrast = 0;

  double mean_contrast() const { return contrast / length; }
};

/// A sum of colours over the pixels of an area.
using ColourSum = std::array<double, 3>;

/// A corner of a convex hull; pixels.
struct Corner {
  int x = 0;
  int y = 0;
};

/// A connected set of pixels.
struct Area {
  /// Empty for an area that has been joined to another.
  std::vector<int> cells;
  std::vector<Contact> contacts;
  std::vector<Corner> hull;
  /// The number of pixels on the border of the image.
  int border = 0;
  /// The area's own colours, and those of the ground as they would be there: linear light (B, G, R)
  /// and L*a*b*.
  ColourSum light{};
  ColourSum lab{};
  ColourSum ground_light{};
  ColourSum ground_lab{};

  double pixels() const { return static_cast<double>(cells.size()); }
  /// The length of all its boundaries with other areas.
  int boundary() const;
};

/// Parts of the convex hull around two areas that belong to neither, as shares of their own pixels.
struct HullRest {
  double ground = 0;
  double others = 0;
};

/// The areas of a picture with their properties and boundaries, which are kept when two are joined.
class AreaGraph {
public:
  AreaGraph(Division division, const WorkingPicture& picture);

  int count() const { return static_cast<int>(areas_.size()); }
  const Area& area(int id) const { return areas_[static_cast<std::size_t>(id)]; }
  bool exists(int id) const { return !area(id).cells.empty(); }
  /// An area that is not the ground.
  bool is_part(int id) const { return id != ground_ && exists(id); }
  /// The area of every pixel.
  const Grid<int>& labels() const { return labels_; }

  /// Joins two areas; the ground, else the larger one, survives and is returned.
  int join(int a, int b);

  /// Their boundary; nullptr if they do not touch.
  const Contact* contact(int a, int b) const;

  /// The area that is ground; -1 until set.
  int ground() const { return ground_; }
  void set_ground(int id) { ground_ = id; }

  /// Sets every area's colours of the ground at its place, and the shade of every pixel.
  /// \param colour,lab of the ground at every pixel.
  /// \param own_lab the picture's own L*a*b*.
  void set_ground_colours(const Grid<Colour>& colour, const Grid<Colour>& lab,
                          const Grid<Colour>& own_lab);

  /// The lightness L* of every pixel as a share of the ground's at its place; empty until the
  /// colours of the ground are set.
  const Grid<float>& shade() const { return shade_; }

  HullRest hull_rest(int a, int b);

private:
  Area& mutable_area(int id) { return areas_[static_cast<std::size_t>(id)]; }
  const std::vector<Corner>& hull(int id);

  Grid<int> labels_;
  Grid<float> shade_;
  std::vector<Area> areas_;
  int ground_ = -1;
};

} // namespace castor::vision
