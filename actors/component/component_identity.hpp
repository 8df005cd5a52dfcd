#pragma once

#include <cstdint>
#include <string>

namespace castor {

/// Identity of a component; immutable.
struct ComponentIdentity {
  std::string name;
  /// Empty for a component outside the subarchitectures.
  std::string subarchitecture;
  std::string class_name;
  /// Position in the system's file, from 0; part of the ids that the component makes.
  std::uint32_t number = 0;
  /// Number of this start of the component, from 1.
  std::uint64_t incarnation = 1;

  /// "vision.segmentor", the form in logs.
  std::string full_name() const {
    return subarchitecture.empty() ? name : subarchitecture + '.' + name;
  }
};

} // namespace castor
