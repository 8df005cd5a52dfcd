#include "castor/actors/system/system_inbox.hpp"

namespace castor {

void SystemInbox::end(int status, const std::string& reason) {
  std::lock_guard guard{mutex_};
  if (!ended_)
    ended_.emplace(status, reason);
  changed_.notify_all();
}

void SystemInbox::add(SystemOrder x) {
  std::lock_guard guard{mutex_};
  orders_.push_back(std::move(x));
  changed_.notify_all();
}

void SystemInbox::await_limit(Timestamp x) {
  std::lock_guard guard{mutex_};
  limit_ = x;
  is_at_limit_ = false;
}

void SystemInbox::note_limit(Timestamp x) {
  std::lock_guard guard{mutex_};
  if (limit_ != x)
    return;
  is_at_limit_ = true;
  changed_.notify_all();
}

bool SystemInbox::is_at_limit() const {
  std::lock_guard guard{mutex_};
  return is_at_limit_;
}

std::optional<std::pair<int, std::string>> SystemInbox::ended() const {
  std::lock_guard guard{mutex_};
  return ended_;
}

std::deque<SystemOrder> SystemInbox::take_orders() {
  std::lock_guard guard{mutex_};
  return std::exchange(orders_, {});
}

bool SystemInbox::wait(std::chrono::milliseconds at_most) {
  std::unique_lock guard{mutex_};
  changed_.wait_for(guard, at_most,
                    [this] { return ended_.has_value() || !orders_.empty() || is_at_limit_; });
  return ended_.has_value();
}

} // namespace castor
