#include "castor/wm/clock/activity.hpp"

#include <algorithm>

namespace castor {

void Activity::add_listener(const std::shared_ptr<QuietListener>& x) {
  std::lock_guard guard{mutex_};
  auto listeners = std::make_shared<Listeners>(*listeners_);
  std::erase_if(*listeners, [](auto& y) { return y.expired(); });
  listeners->push_back(x);
  listeners_ = std::move(listeners);
}

} // namespace castor
