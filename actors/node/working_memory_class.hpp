#pragma once

#include "castor/actors/component/option.hpp"

namespace castor {

/// The one class that WM lines may name, and its options.
struct WorkingMemoryClass {
  static constexpr const char* name = "SubarchitectureWorkingMemory";
  static constexpr const char* help =
    "holds the entries of a subarchitecture and tells of their changes";

  OptionList options;
  Option<std::vector<std::string>> ignore{
    options,
    "ignore",
    {},
    "changes in these subarchitectures are not told to this one's components"};
};

} // namespace castor
