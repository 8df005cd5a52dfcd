#pragma once

#include "castor/wm/memory/committed_change.hpp"
#include "castor/wm/memory/deferred_reply.hpp"
#include "castor/wm/memory/output_gate.hpp"
#include "castor/wm/memory/working_memory_options.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Sends the changes of a working memory to its journal, and holds back all messages that depend on
/// them until they are safe there (see OutputGate). Without a journal, everything is sent at once.
class JournalOutbox {
public:
  explicit JournalOutbox(WorkingMemoryActor::pointer self) : self_(self) {}

  /// Starts to use an opened journal; to be called first. `now` is the time since the system began.
  /// A journal that could not be opened is reported in the status.
  void open(const WorkingMemoryOptions& options, Timestamp now);

  /// Sends the changes of one write to the journal, if there is one. To be called before any
  /// message about them.
  void write(const std::vector<CommittedChange>& changes) {
    if (writer_)
      append(changes);
  }

  /// Calls `f`, which sends a message: at once, or when the gate opens.
  template <class F>
  void emit(F&& f) {
    if (gate_.holds())
      hold(std::forward<F>(f));
    else
      f();
  }

  /// Replies to the current message: at once, or when the gate opens.
  template <class Reply>
  caf::result<Reply> reply(caf::result<Reply> reply) {
    if (!gate_.holds() || reply.flag != caf::rt_value)
      return reply;
    auto deferred = defer<Reply>(self_);
    hold([deferred, message = std::move(reply.value)] {
      deferred->deliver(Reply{message.template get_as<Reply>(0)});
    });
    return deferred->promise();
  }

  /// Sends a deferred reply: at once, or when the gate opens.
  template <class Reply>
  void reply(DeferredReplyPtr<Reply> deferred, Reply reply) {
    emit([deferred = std::move(deferred), reply = std::move(reply)]() mutable {
      deferred->deliver(std::move(reply));
    });
  }

  /// Handles progress of the journal. If it has failed, the working memory goes on without it or
  /// ends, depending on its options.
  void receive(const JournalNews& news);

  void inject_fault(const JournalFault& fault);

  JournalStatus status() const;

private:
  void append(const std::vector<CommittedChange>& changes);
  void hold(std::function<void()> output) {
    gate_.push(std::move(output));
    if (clock_ && !time_hold_)
      time_hold_ = clock_->hold();
  }
  void release_time_if_empty();

  WorkingMemoryActor::pointer self_;
  std::string subarchitecture_;
  JournalOptions options_;
  /// Null without a journal.
  caf::actor writer_;
  OutputGate gate_;
  /// Null for the real clock. Time stands while messages are held back.
  std::shared_ptr<SimulatedClock> clock_;
  std::optional<TimeHold> time_hold_;
  /// Without the figures of `gate_`.
  JournalStatus status_;
  /// Origin of event times.
  UnixTime began_{0};
};

} // namespace castor
