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

} // namespace castor
