#include "castor/actors/component/task_event.hpp"

namespace castor {

std::string_view to_string(TaskStep x) {
  switch (x) {
    case TaskStep::adopted:
      return "ADOPTED";
    case TaskStep::rejected:
      return "REJECTED";
    case TaskStep::waiting:
      return "WAITING";
    case TaskStep::retracted:
      return "RETRACTED";
    case TaskStep::completed:
      return "COMPLETED";
  }
  return "UNKNOWN";
}

} // namespace castor
