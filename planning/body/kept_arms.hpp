#pragma once

#include "castor/planning/body/arm_body.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace castor::manipulation {

/// A simulated arm and its table, and the time until which it was simulated.
struct KeptArm {
  std::shared_ptr<ArmBody> body;
  Timestamp time{0};
};

/// The simulated arms of this process, by the names of their components: the world stays as it is
/// when the component that simulates it fails. Thread-safe.
class KeptArms {
public:
  static KeptArms& instance();

  void keep(const std::string& name, const KeptArm& x);

  /// Without a body if none was kept.
  KeptArm find(const std::string& name) const;

private:
  mutable std::mutex mutex_;
  std::map<std::string, KeptArm> arms_;
};

} // namespace castor::manipulation
