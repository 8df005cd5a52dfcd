#pragma once

#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/random_plan.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor::faults {

/// What a component has done by some moment, since it was last started.
struct ComponentSample {
  std::string component;
  std::uint64_t incarnation = 1;
  std::uint64_t callbacks = 0;
  std::uint64_t operations = 0;
};

/// What components do, from samples of their counters. What a component did between its last sample
/// and its end is not known.
class ActivityMeter {
public:
  /// What was done before the first sample does not count.
  void take(Timestamp at, const std::vector<ComponentSample>& samples);

  Activity total() const;
  ActivityByComponent by_component() const;

private:
  struct Counts {
    ComponentSample last;
    std::uint64_t callbacks = 0;
    std::uint64_t operations = 0;
    /// Of its present life, the samples so far.
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
