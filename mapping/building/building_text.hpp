#pragma once

#include "castor/mapping/building/building.hpp"

#include <string>

namespace castor::mapping {

/// The building in the language of building_file.hpp, whose parser makes the same building of it:
/// lengths are written to the tenth of a millimetre, angles to the thousandth of a degree.
std::string building_text(const Building& x);

} // namespace castor::mapping
