#pragma once

#include <vector>

namespace castor {

/// A picture in rows from the top; of each pixel as many values as there are channels, B, G, R if
/// there are three.
template <class T>
struct Pixels {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<T> values;
};

} // namespace castor
