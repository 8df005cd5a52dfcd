#include "castor/actors/runtime/user_code.hpp"

#include <utility>

namespace castor {

std::string UserCode::set_activity(std::string what) {
  // A crash in between is one of nobody knows what.
  crash_note_.set_activity({});
  auto before = std::exchange(activity_, std::move(what));
  crash_note_.set_activity(activity_);
  return before;
}

} // namespace castor
