#include "castor/actors/registry.hpp"

#include "castor/actors/component/log.hpp"

#include <utility>

namespace castor {

Registry& Registry::instance() {
  static Registry result;
  return result;
}

void Registry::add(ComponentClass x) {
  auto name = x.name;
  if (!classes_.try_emplace(name, std::move(x)).second)
    note(LogLevel::error, "castor",
         "two libraries have a component class " + name + "; the one loaded first is used");
}

const ComponentClass* Registry::find(const std::string& name) const {
  auto i = classes_.find(name);
  return i == classes_.end() ? nullptr : &i->second;
}

std::vector<const ComponentClass*> Registry::all() const {
  std::vector<const ComponentClass*> result;
  for (auto& [name, x] : classes_)
    result.push_back(&x);
  return result;
}

} // namespace castor
