#include "castor/wm/entries/change_event_text.hpp"

namespace castor {

std::string to_string(const ChangeEvent& x) {
  std::string result;
  for_each_part(x, [&](std::string_view part) { result += part; });
  return result;
}

} // namespace castor
