#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/benchmarks/node_process.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace castor::benchmark {

/// A running guarded circle.
struct CircleSystem {
  System& system;
  /// By their names, as their numbers in the system.
  std::map<std::string, NodeProcess>& processes;
  std::map<std::string, ProcessNumber> numbers;
};

/// Something that fails, and the robot has to stop.
struct FailureKind {
  std::string name;
  std::function<void(const CircleSystem&)> fail;
  /// Once the robot stands.
  std::function<void(const CircleSystem&)> mend = [](const CircleSystem&) {};
};

std::vector<FailureKind> failure_kinds();

} // namespace castor::benchmark
