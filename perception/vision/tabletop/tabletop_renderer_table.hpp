#pragma once

#include "castor/perception/vision/tabletop/tabletop_renderer_light.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Texture of the table's surface.
namespace castor::vision {

/// Makes the pattern of a table: boards with grain, woven cloth, or plain paint.
class TableTexture {
public:
  explicit TableTexture(const TableLook& look);

  /// The reflectance at (x, y). `footprint` is the width of a pixel on the table there, metres;
  /// finer detail is averaged out.
  LinearColour at(double x, double y, double footprint) const;

  /// The mean reflectance.
  const LinearColour& average() const { return colour_; }

private:
  double wood(double x, double y, double footprint) const;
  double cloth(double x, double y, double footprint) const;

  TableLook::Material material_;
  LinearColour colour_;
};

} // namespace castor::vision
