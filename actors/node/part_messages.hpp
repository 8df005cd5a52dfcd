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

/// LinkMessages for the messages between parts: counts change events, acknowledges events to
/// working memories once another process has them, and refuses messages that are too large.
class PartMessages : public LinkMessages {
public:
  using LinkMessages::LinkMessages;

  /// Sets the largest value, in bytes, that a working memory of another process takes: larger ones
  /// are refused before they are sent. Replaces the setting of a predecessor of the same
  /// subarchitecture.
  void set_largest_value(ActorName working_memory, const std::string& subarchitecture,
                         std::size_t bytes);

  std::size_t count_events(const Content& x) const override;
  std::optional<Failure> check(ActorName to, const Content& x) const override;
  Failure too_large(const Content& x, std::size_t size, std::size_t largest) const override;
  std::optional<caf::message> failed_outcome(const Content& x, const Failure& why) const override;
  std::optional<caf::message> receipt_if_dropped(const Content& x) const override;
  bool may_repeat(const Content& x) const override;
  OnArrival on_arrival(ProcessNumber peer, const caf::strong_actor_ptr& sender,
                       const Content& x) override;
  void process_ended(ProcessNumber peer) override;

private:
  mutable std::mutex mutex_;
  /// Receipts of change events, by receiving process and sending working memory.
  std::map<std::pair<ProcessNumber, caf::actor_id>, std::shared_ptr<Receipts>> receipts_;
  /// By working memory: its subarchitecture, and the largest value that it takes.
  std::map<ActorName, std::pair<std::string, std::size_t>> largest_values_;
};

} // namespace castor
