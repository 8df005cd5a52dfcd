#include "castor/actors/runtime/user_code.hpp"

#include <utility>

namespace castor {

std::string UserCode::set_activity(std::string what) {
  // A crash in between is one of nobody knows what.
  crash_note_.set_activity({});
  auto before = record_.exchange_activity(std::move(what));
  // Only this thread changes the text.
  crash_note_.set_activity(record_.own_activity());
  return before;
}

} // namespace castor
