#include "castor/actors/runtime/user_code.hpp"

#include <utility>

namespace castor {

std::string UserCode::set_doing(std::string what) {
  // A crash in between is one of nobody knows what.
  crash_note_.set_doing({});
  auto before = std::exchange(doing_, std::move(what));
  crash_note_.set_doing(doing_);
  return before;
}

} // namespace castor
