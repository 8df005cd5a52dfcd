#include "castor/mapping/exports/g2o_text.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace castor::mapping {

std::string g2o_text(const MapContents& map) {
  std::string result;
  auto out = std::back_inserter(result);
  for (std::size_t i = 0; i < map.keyframes.size(); ++i) {
    auto& pose = map.keyframes[i].pose;
    fmt::format_to(out, "VERTEX_SE2 {} {} {} {}\n", i, pose.x, pose.y, pose.heading);
    // Without it, the solution could be anywhere.
    if (i == 0)
      fmt::format_to(out, "FIX 0\n");
  }
  for (auto& x : map.constraints) {
    if (x.from >= map.keyframes.size() || x.to >= map.keyframes.size())
      throw std::out_of_range(
        fmt::format("a constraint is about the keyframes {} and {}, and there "
                    "are {}",
                    x.from, x.to, map.keyframes.size()));
    fmt::format_to(out, "EDGE_SE2 {} {} {} {} {} {}\n", x.from, x.to, x.relative.x, x.relative.y,
                   x.relative.heading, fmt::join(x.information, " "));
  }
  return result;
}

} // namespace castor::mapping
