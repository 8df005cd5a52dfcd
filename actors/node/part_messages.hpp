#pragma once

#include "castor/actors/link/link_messages.hpp"
#include "castor/wm/events/receipts.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace castor {

/// What the links of a process have to know of the messages of its part: which of them carry
/// events, that working memories are to be acknowledged the events that other processes have, and
/// what is too large.
class PartMessages : public LinkMessages {
public:
  using LinkMessages::LinkMessages;

  /// A working memory of another process takes values of up to so many bytes: larger ones are
  /// refused before they are sent. One that takes another's place has the same subarchitecture.
  void set_largest_value(ActorName working_memory, const std::string& subarchitecture,
                         std::size_t bytes);

  std::size_t count_events(const Content& x) const override;
  std::optional<Failure> check(ActorName to, const Content& x) const override;
  Failure too_large(const Content& x, std::size_t size, std::size_t largest) const override;
  std::optional<caf::message> failed_outcome(const Content& x, const Failure& why) const override;
  std::optional<caf::message> receipt_if_dropped(const Content& x) const override;
  OnArrival on_arrival(ProcessNumber peer, const caf::strong_actor_ptr& sender,
                       const Content& x) override;
  void process_ended(ProcessNumber peer) override;

private:
  mutable std::mutex mutex_;
  /// Of the events that working memories send to a process, by both.
  std::map<std::pair<ProcessNumber, caf::actor_id>, std::shared_ptr<Receipts>> receipts_;
  /// By working memory: its subarchitecture, and the largest value that it takes.
  std::map<ActorName, std::pair<std::string, std::size_t>> largest_values_;
};

} // namespace castor
