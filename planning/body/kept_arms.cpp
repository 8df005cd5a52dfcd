#include "castor/planning/body/kept_arms.hpp"

namespace castor::manipulation {

KeptArms& KeptArms::instance() {
  static KeptArms result;
  return result;
}

void KeptArms::keep(const std::string& name, const KeptArm& x) {
  const std::lock_guard guard{mutex_};
  arms_[name] = x;
}

KeptArm KeptArms::find(const std::string& name) const {
  const std::lock_guard guard{mutex_};
  const auto i = arms_.find(name);
  return i == arms_.end() ? KeptArm{} : i->second;
}

} // namespace castor::manipulation
