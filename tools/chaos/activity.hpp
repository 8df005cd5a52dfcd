#pragma once

#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/random_plan.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor::faults {

/// Counters of a component at some moment, since it was last started.
struct ComponentSample {
  std::string component;
  std::uint64_t incarnation = 1;
  std::uint64_t callbacks = 0;
  std::uint64_t operations = 0;
};

/// Activity of components, computed from samples of their counters. Work between a component's last
/// sample and its end is not counted.
class ActivityMeter {
public:
  /// Adds a sample. Work before the first sample is not counted.
  void take(Timestamp at, const std::vector<ComponentSample>& samples);

  Activity total() const;
  ActivityByComponent by_component() const;

private:
  struct Counts {
    ComponentSample last;
    std::uint64_t callbacks = 0;
    std::uint64_t operations = 0;
    /// Samples of the current incarnation.
    std::size_t seen = 0;
  };

  bool is_first_ = true;
  Timestamp begin_{0};
  Timestamp end_{0};
  std::size_t moments_ = 0;
  std::size_t busy_moments_ = 0;
  std::map<std::string, Counts> components_;
};

} // namespace castor::faults
