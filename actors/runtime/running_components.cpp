#include "castor/actors/runtime/running_components.hpp"

#include <mutex>

namespace castor {

namespace {

/// Never destroyed: components may outlive main().
struct Running {
  std::mutex mutex;
  std::list<const RunningComponent*> components;
};

Running& running() {
  static auto* result = new Running;
  return *result;
}

/// Which part of its own code a component is in, by how far it has come.
const char* part_of_code(ComponentState x) {
  switch (x) {
    case ComponentState::created:
      return "configure()";
    case ComponentState::configured:
      return "start()";
    case ComponentState::started:
    case ComponentState::running:
    case ComponentState::stopped:
    case ComponentState::failed:
      break;
  }
  return "run(), stop() or a callback";
}

} // namespace

RunningComponent::RunningComponent(const ComponentRecord& record) : record_(record) {
  auto& x = running();
  std::lock_guard guard{x.mutex};
  position_ = x.components.insert(x.components.end(), this);
}

RunningComponent::~RunningComponent() {
  auto& x = running();
  std::lock_guard guard{x.mutex};
  x.components.erase(position_);
}

std::vector<std::string> components_in_own_code() {
  std::vector<std::string> result;
  auto& x = running();
  std::lock_guard guard{x.mutex};
  auto now = ComponentRecord::Clock::now();
  for (auto* component : x.components) {
    auto& record = component->record_;
    if (record.in_user_code_for(now).count() > 0)
      result.push_back(
        record.identity().full_name() + " in " +
        (component->in_destructor_ ? "its destructor" : part_of_code(record.state())));
  }
  return result;
}

} // namespace castor
