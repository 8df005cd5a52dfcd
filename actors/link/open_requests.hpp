#pragma once

#include "castor/actors/link/link_record.hpp"
#include "castor/base/caf.hpp"

#include <caf/message_id.hpp>

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

namespace castor {

/// Replies to a request that its receiver has ended; any other message needs no reply.
void reply_receiver_down(const caf::strong_actor_ptr& sender, caf::message_id id);

/// Unanswered requests of local actors to remote ones, so that none waits for a process that is
/// lost. Safe to use from any thread.
class OpenRequests {
public:
  struct Request {
    caf::strong_actor_ptr sender;
    caf::message_id id;
  };

  /// From now on requests may go to a process.
  void add_process(ProcessNumber x);

  /// Remembers a request until it is answered; false if its process is lost.
  bool add(ProcessNumber to, const caf::strong_actor_ptr& sender, caf::message_id id);

  /// The request was answered; nothing happens if it is not known.
  void remove(const caf::strong_actor_ptr& sender, caf::message_id response);

  /// Whether a process has not answered all.
  bool awaits(ProcessNumber x) const;

  /// The process is lost; returns the requests that it will not answer.
  std::vector<Request> remove_process(ProcessNumber x);

private:
  struct Entry {
    Request request;
    ProcessNumber to = 0;
  };

  mutable std::mutex mutex_;
  std::set<ProcessNumber> processes_;
  /// By the sender, and the id of the response.
  std::map<std::pair<caf::actor_id, std::uint64_t>, Entry> requests_;
};

} // namespace castor
