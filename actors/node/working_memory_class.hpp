#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/option.hpp"

#include <chrono>
#include <cstdint>

namespace castor {

/// The one class that WM lines may name, and its options.
struct WorkingMemoryClass {
  static constexpr const char* name = "SubarchitectureWorkingMemory";
  static constexpr const char* help =
    "holds the entries of a subarchitecture and tells of their changes";

  WorkingMemoryClass() = default;

  /// With the options of a WM line, which have been checked.
  explicit WorkingMemoryClass(const ComponentDescription& x) {
    for (auto& setting : x.options)
      options.set(setting.name(), setting.value);
  }

  OptionList options;
  Option<std::vector<std::string>> ignore{
    options,
    "ignore",
    {},
    "changes in these subarchitectures are not told to this one's components"};
  Option<bool> log{options, "log", false, "log every change at level debug"};
  Option<bool> debug{options, "debug", false, "log every change at level trace"};
  Option<std::chrono::milliseconds> lease{
    options, "lease", std::chrono::seconds{2},
    "how long the lease of an entry outlives the last sign of life of its holder"};
  Option<std::int64_t> largest_entry{options, "largest-entry", 256,
                                     "the largest entry that is taken, MB"};
};

} // namespace castor
