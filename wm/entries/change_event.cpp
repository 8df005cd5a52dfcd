#include "castor/wm/entries/change_event.hpp"

#include "castor/wm/entries/change_event_text.hpp"

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
  std::string result;
  for_each_part(x, [&](std::string_view part) { result += part; });
  return result;
}

} // namespace castor
