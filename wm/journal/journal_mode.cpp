#include "castor/wm/journal/journal_mode.hpp"

namespace castor {

std::string_view to_string(JournalMode x) {
  switch (x) {
    case JournalMode::off:
      return "off";
    case JournalMode::full:
      return "full";
    case JournalMode::batched:
      return "batched";
  }
  return "unknown";
}

} // namespace castor
