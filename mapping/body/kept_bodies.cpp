#include "castor/mapping/body/kept_bodies.hpp"

namespace castor::mapping {

KeptBodies& KeptBodies::instance() {
  static KeptBodies result;
  return result;
}

void KeptBodies::keep(const std::string& name, const SavedBody& x) {
  const std::lock_guard guard{mutex_};
  bodies_[name] = x;
}

std::optional<SavedBody> KeptBodies::find(const std::string& name) const {
  const std::lock_guard guard{mutex_};
  const auto i = bodies_.find(name);
  return i == bodies_.end() ? std::nullopt : std::optional{i->second};
}

} // namespace castor::mapping
