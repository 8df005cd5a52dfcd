#pragma once

#include "castor/tools/simulation/seeds.hpp"

#include <stdexcept>
#include <string>

namespace castor::cli {

/// For CLI11's `check` of an option for seeds: an error message, or empty if the text is valid.
inline std::string check_seeds(const std::string& text) {
  try {
    simulation::parse_seeds(text);
    return {};
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

} // namespace castor::cli
