#pragma once

#include "castor/actors/component/callback_component.hpp"
#include "castor/actors/component/component.hpp"
#include "castor/actors/component/component_kind.hpp"
#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/component/task_manager.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace castor {

/// A class that .cast files may name.
struct ComponentClass {
  std::string name;
  /// One line, for `castor components`.
  std::string help;
  ComponentKind kind = ComponentKind::managed;
  std::function<std::unique_ptr<Component>()> make;
  /// Whether each has a thread of its own.
  bool has_thread = true;
};

/// The component classes that this process has. Filled by CASTOR_COMPONENT while libraries are
/// loaded, which happens on one thread.
class Registry {
public:
  static Registry& instance();

  /// Of classes with the same name the first is kept; others are logged and left out.
  void add(ComponentClass x);

  /// Null if there is none.
  const ComponentClass* find(const std::string& name) const;

  /// By name.
  std::vector<const ComponentClass*> all() const;

private:
  std::map<std::string, ComponentClass> classes_;
};

namespace detail {

template <class T>
constexpr ComponentKind kind_of_component() {
  static_assert(std::is_base_of_v<Component, T>);
  if (std::is_base_of_v<TaskManager, T>)
    return ComponentKind::task_manager;
  if (std::is_base_of_v<ManagedComponent, T>)
    return ComponentKind::managed;
  if (std::is_base_of_v<SubarchitectureComponent, T>)
    return ComponentKind::unmanaged;
  return ComponentKind::standalone;
}

template <class T>
bool register_component(std::string name, std::string help) {
  Registry::instance().add({std::move(name), std::move(help), kind_of_component<T>(),
                            [] { return std::make_unique<T>(); },
                            !std::is_base_of_v<CallbackComponent, T>});
  return true;
}

} // namespace detail

} // namespace castor

/// Makes a class known to .cast files by its unqualified name; in a source file, in the namespace
/// of the class. `help_text` is one line that says what the component does.
#define CASTOR_COMPONENT(Class, help_text)                          \
  namespace {                                                       \
  [[maybe_unused]] const bool castor_registered_##Class =           \
    ::castor::detail::register_component<Class>(#Class, help_text); \
  }
