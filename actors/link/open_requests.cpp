#include "castor/actors/link/open_requests.hpp"

#include <caf/detail/sync_request_bouncer.hpp>

#include <algorithm>

namespace castor {

void reply_receiver_down(const caf::strong_actor_ptr& sender, caf::message_id id) {
  caf::detail::sync_request_bouncer{caf::make_error(caf::sec::request_receiver_down)}(sender, id);
}

void OpenRequests::add_process(ProcessNumber x) {
  std::lock_guard guard{mutex_};
  processes_.insert(x);
}

bool OpenRequests::add(ProcessNumber to, const caf::strong_actor_ptr& sender, caf::message_id id) {
  std::lock_guard guard{mutex_};
  if (processes_.count(to) == 0)
    return false;
  requests_[{sender->id(), id.response_id().integer_value()}] = {{sender, id}, to};
  return true;
}

void OpenRequests::remove(const caf::strong_actor_ptr& sender, caf::message_id response) {
  std::lock_guard guard{mutex_};
  requests_.erase({sender->id(), response.integer_value()});
}

bool OpenRequests::awaits(ProcessNumber x) const {
  std::lock_guard guard{mutex_};
  return std::ranges::any_of(requests_, [&](auto& entry) { return entry.second.to == x; });
}

std::vector<OpenRequests::Request> OpenRequests::remove_process(ProcessNumber x) {
  std::vector<Request> result;
  std::lock_guard guard{mutex_};
  processes_.erase(x);
  std::erase_if(requests_, [&](auto& entry) {
    if (entry.second.to != x)
      return false;
    result.push_back(entry.second.request);
    return true;
  });
  return result;
}

} // namespace castor
