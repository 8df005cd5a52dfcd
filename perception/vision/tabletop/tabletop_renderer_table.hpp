#pragma once

#include "castor/perception/vision/tabletop/tabletop_renderer_light.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// What the table's surface looks like from close by.
namespace castor::vision {

/// Makes the pattern of a table: boards with grain, woven cloth, or plain paint.
class TableTexture {
public:
  explicit TableTexture(const TableLook& look);

  /// The reflectance at (x, y). `footprint` is how much of the table a pixel covers there, metres;
  /// finer detail than that is averaged out.
  LinearColour at(double x, double y, double footprint) const;

  /// The reflectance on the whole.
  const LinearColour& average() const { return colour_; }

private:
  double wood(double x, double y, double footprint) const;
  double cloth(double x, double y, double footprint) const;

  TableLook::Material material_;
  LinearColour colour_;
};

} // namespace castor::vision
