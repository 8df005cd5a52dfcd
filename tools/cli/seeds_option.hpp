#pragma once

#include "castor/tools/simulation/seeds.hpp"

#include <stdexcept>
#include <string>

namespace castor::cli {

/// Of an option that takes seeds: what is wrong with it, or nothing.
inline std::string check_seeds(const std::string& text) {
  try {
    simulation::parse_seeds(text);
    return {};
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

} // namespace castor::cli
