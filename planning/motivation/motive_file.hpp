#pragma once

#include "castor/planning/motivation/motive_templates.hpp"

#include <string>
#include <vector>

namespace castor::planning {

/// The templates of a file.
/// \throws std::runtime_error that says all problems, if it cannot be used
std::vector<MotiveTemplate> load_motives(const std::string& file);

} // namespace castor::planning
