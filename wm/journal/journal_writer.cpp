#include "castor/wm/journal/journal_writer.hpp"

#include <caf/atom.hpp>

#include <exception>
#include <memory>
#include <utility>
#include <vector>

namespace castor {

namespace {

using AppendAtom = caf::atom_constant<caf::atom("append")>;
using SyncAtom = caf::atom_constant<caf::atom("sync")>;
using TidyAtom = caf::atom_constant<caf::atom("tidy")>;
using CloseAtom = caf::atom_constant<caf::atom("close")>;

class JournalWriter {
public:
  JournalWriter(caf::event_based_actor* self, JournalWriterParts parts)
    : self_(self), stay_(self), parts_(std::move(parts)) {}

  void take(const JournalWrite& x) {
    if (!news_.failure.empty())
      return;
    changes_ += x.changes->size();
    bytes_ += x.bytes;
    gathered_.push_back(x.changes);
    if (parts_.mode == JournalMode::full || changes_ > parts_.most_changes ||
        bytes_ > parts_.most_bytes)
      sync_soon();
    else if (gathered_.size() == 1)
      self_->delayed_send(self_, parts_.delay, SyncAtom::value);
  }

  void inject(const JournalFault& x) {
    auto until = self_->clock().now() + x.duration;
    switch (x.kind) {
      case JournalFault::Kind::failure:
        fails_until_ = until;
        failure_ticket_ = x.ticket;
        break;
      case JournalFault::Kind::slowness:
        slowness_ = x.by;
        slow_until_ = until;
        slowness_ticket_ = x.ticket;
        break;
    }
  }

  /// Begins to write what has gathered.
  void sync() {
    sync_is_due_ = false;
    if (gathered_.empty() || !under_way_.empty() || !news_.failure.empty())
      return;
    under_way_ = std::exchange(gathered_, {});
    changes_ = bytes_ = 0;
    if (self_->clock().now() < slow_until_) {
      report_effect(slowness_ticket_);
      self_->delayed_send(self_, slowness_, AppendAtom::value);
    } else {
      append();
    }
  }

  void append() {
    // When the end came first.
    if (under_way_.empty())
      return;
    attempt([&] {
      parts_.file->append(under_way_);
      news_.synced = under_way_.back()->back().sequence;
      ++news_.syncs;
    });
    under_way_.clear();
    tell();
    tidy_soon();
    if (!gathered_.empty())
      sync_soon();
  }

  void tidy() {
    tidy_is_due_ = false;
    if (!news_.failure.empty())
      return;
    bool more = false;
    attempt([&] { more = parts_.file->tidy(); });
    if (!news_.failure.empty())
      tell();
    else if (more)
      tidy_soon();
  }

  void close() {
    if (news_.failure.empty())
      write_the_rest();
    if (news_.failure.empty())
      attempt([&] { parts_.file->close(); });
    parts_.file.reset();
    stay_ = nullptr;
  }

private:
  void write_the_rest() {
    under_way_.insert(under_way_.end(), gathered_.begin(), gathered_.end());
    gathered_.clear();
    append();
    if (!news_.failure.empty() && parts_.mode == JournalMode::batched)
      parts_.report(news_.failure + ". What was acknowledged last may be lost");
  }

  template <class F>
  void attempt(F&& f) {
    try {
      if (self_->clock().now() < fails_until_) {
        report_effect(failure_ticket_);
        throw JournalError("the journal cannot be written: injected failure");
      }
      f();
    } catch (const std::exception& e) {
      news_.failure = e.what();
    }
  }

  void tell() {
    news_.bytes = parts_.file->bytes();
    caf::anon_send(caf::actor_cast<caf::actor>(parts_.owner), news_);
  }

  /// After all that waits by now.
  void sync_soon() {
    if (!std::exchange(sync_is_due_, true))
      self_->send(self_, SyncAtom::value);
  }

  void tidy_soon() {
    if (!std::exchange(tidy_is_due_, true))
      self_->send(self_, TidyAtom::value);
  }

  caf::event_based_actor* self_;
  /// It outlives its working memory, which alone knows it.
  caf::actor stay_;
  JournalWriterParts parts_;
  /// What is written next, and what of that is being written.
  std::vector<JournalGroupPtr> gathered_;
  std::size_t changes_ = 0;
  std::size_t bytes_ = 0;
  std::vector<JournalGroupPtr> under_way_;
  caf::actor_clock::time_point fails_until_;
  FaultTicket failure_ticket_;
  caf::actor_clock::time_point slow_until_;
  Timestamp slowness_{0};
  FaultTicket slowness_ticket_;
  bool sync_is_due_ = false;
  bool tidy_is_due_ = false;
  JournalNews news_;
};

} // namespace

JournalWriterParts journal_writer_parts(const JournalOptions& options,
                                        std::shared_ptr<JournalFile> file,
                                        caf::strong_actor_ptr owner) {
  // Before the working memory has to hold back anything.
  return {std::move(file),
          options.mode,
          options.delay,
          options.most_unsynced / 4,
          options.most_unsynced_bytes / 4,
          std::move(owner),
          options.report};
}

caf::behavior journal_writer(caf::event_based_actor* self, JournalWriterParts parts) {
  self->monitor(parts.owner);
  auto writer = std::make_shared<JournalWriter>(self, std::move(parts));
  // The news of the end overtakes what was written before it.
  self->set_down_handler([self](const caf::down_msg&) { self->send(self, CloseAtom::value); });
  return {
    [writer](const JournalWrite& x) { writer->take(x); },
    [writer](const JournalFault& x) { writer->inject(x); },
    [writer](SyncAtom) { writer->sync(); },
    [writer](AppendAtom) { writer->append(); },
    [writer](TidyAtom) { writer->tidy(); },
    [self, writer](CloseAtom) {
      writer->close();
      self->quit();
    },
  };
}

} // namespace castor
