#include "castor/actors/supervision/child_options.hpp"

#include "castor/actors/component/component.hpp"
#include "castor/base/duration.hpp"

namespace castor {

ChildOptions::ChildOptions(const ComponentDescription& x) {
  if (auto* option = x.option("restart"))
    for (auto& [name, type] : reflection_of<RestartType>().enumerators)
      if (option->value == name)
        restart = type;
  if (auto* option = x.option("shutdown"))
    shutdown = parse_duration(option->value);
}

} // namespace castor
