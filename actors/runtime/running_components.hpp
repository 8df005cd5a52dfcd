#pragma once

#include "castor/actors/runtime/record.hpp"

#include <atomic>
#include <list>
#include <string>
#include <vector>

namespace castor {

class RunningComponent;

/// Components of this process whose own code is running, which keeps the process from ending:
/// "vision.learner in configure()".
std::vector<std::string> components_in_own_code();

/// The component has a thread in this process, for as long as this object lives.
class RunningComponent {
public:
  /// The record has to outlive it.
  explicit RunningComponent(const ComponentRecord& record);
  RunningComponent(const RunningComponent&) = delete;
  RunningComponent& operator=(const RunningComponent&) = delete;
  ~RunningComponent();

  /// Its destructor runs from now on.
  void begin_destructor() { in_destructor_ = true; }

private:
  friend std::vector<std::string> components_in_own_code();

  const ComponentRecord& record_;
  std::atomic<bool> in_destructor_{false};
  std::list<const RunningComponent*>::iterator position_;
};

} // namespace castor
