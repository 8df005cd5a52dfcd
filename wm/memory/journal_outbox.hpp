#pragma once

#include "castor/wm/memory/committed_change.hpp"
#include "castor/wm/memory/deferred_reply.hpp"
#include "castor/wm/memory/output_gate.hpp"
#include "castor/wm/memory/working_memory_options.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Hands the changes of a working memory to its journal, and sends whatever others may conclude
/// from them only once they are safe there (OutputGate says when). Without a journal everything
/// goes out at once.
class JournalOutbox {
public:
  explicit JournalOutbox(WorkingMemoryActor::pointer self) : self_(self) {}

  /// Takes up an opened journal at a time since the system's begin, as the first thing. One that
  /// could not be opened is reported in the status.
  void open(const WorkingMemoryOptions& options, Timestamp now);

  /// Writes the changes of one write down, if there is a journal. Comes before whatever others are
  /// told of them.
  void write(const std::vector<CommittedChange>& changes) {
    if (writer_)
      append(changes);
  }

  /// Calls `f`, which sends something.
  template <class F>
  void emit(F&& f) {
    if (gate_.holds())
      gate_.push(std::forward<F>(f));
    else
      f();
  }

  /// The answer to the current message.
  template <class Reply>
  caf::result<Reply> reply(caf::result<Reply> reply) {
    if (!gate_.holds() || reply.flag != caf::rt_value)
      return reply;
    auto deferred = defer<Reply>(self_);
    gate_.push([deferred, message = std::move(reply.value)] {
      deferred->deliver(Reply{message.template get_as<Reply>(0)});
    });
    return deferred->promise();
  }

  /// An answer that has waited.
  template <class Reply>
  void reply(DeferredReplyPtr<Reply> deferred, Reply reply) {
    emit([deferred = std::move(deferred), reply = std::move(reply)]() mutable {
      deferred->deliver(std::move(reply));
    });
  }

  /// The journal says how it stands. If it has failed, the working memory goes on without it or
  /// ends, as its options say.
  void receive(const JournalNews& news);

  void inject_fault(const JournalFault& fault);

  JournalStatus status() const;

private:
  void append(const std::vector<CommittedChange>& changes);

  WorkingMemoryActor::pointer self_;
  std::string subarchitecture_;
  JournalOptions options_;
  /// Null without a journal.
  caf::actor writer_;
  OutputGate gate_;
  /// Without what the gate knows.
  JournalStatus status_;
  /// What event times count from.
  UnixTime began_{0};
};

} // namespace castor
