#include "castor/wm/entries/change_event.hpp"

namespace castor {

std::string_view to_string(Operation x) {
  switch (x) {
    case Operation::add:
      return "ADD";
    case Operation::overwrite:
      return "OVERWRITE";
    case Operation::remove:
      return "DELETE";
  }
  return "UNKNOWN";
}

std::string to_string(const ChangeEvent& x) {
  auto result = std::string{to_string(x.operation)} + ' ' + x.type_name() + ' ' +
                to_string(x.address) + " v" + std::to_string(x.version) + " by " + x.source;
  const char* separator = ", changed ";
  for (auto& name : x.changed_fields()) {
    result += separator + name;
    separator = " and ";
  }
  if (x.coalesced)
    result += ", coalesced";
  return result;
}

} // namespace castor
