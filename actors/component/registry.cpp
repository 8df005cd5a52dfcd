#include "castor/actors/component/registry.hpp"

#include "castor/base/log.hpp"

#include <mutex>
#include <utility>

namespace castor {

namespace {

/// Held while the classes are looked at or added to: components are checked by several threads.
std::mutex mutex;

} // namespace

Registry& Registry::instance() {
  static Registry result;
  return result;
}

void Registry::add(ComponentClass x) {
  auto name = x.name;
  std::lock_guard guard{mutex};
  if (!classes_.try_emplace(name, std::move(x)).second)
    log_runtime(LogLevel::error, "castor",
                "two libraries have a component class " + name + "; the one loaded first is used");
}

const ComponentClass* Registry::find(const std::string& name) const {
  std::lock_guard guard{mutex};
  auto i = classes_.find(name);
  return i == classes_.end() ? nullptr : &i->second;
}

std::vector<const ComponentClass*> Registry::all() const {
  std::vector<const ComponentClass*> result;
  std::lock_guard guard{mutex};
  for (auto& [name, x] : classes_)
    result.push_back(&x);
  return result;
}

} // namespace castor
