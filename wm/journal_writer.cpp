#include "castor/wm/journal_writer.hpp"

#include <caf/atom.hpp>

#include <exception>
#include <memory>
#include <utility>
#include <vector>

namespace castor {

namespace {

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
    last_ = x.changes->back().sequence;
    changes_ += x.changes->size();
    bytes_ += x.bytes;
    gathered_.push_back(x.changes);
    if (parts_.mode == JournalMode::full || changes_ > parts_.most_changes ||
        bytes_ > parts_.most_bytes)
      sync_soon();
    else if (gathered_.size() == 1)
      self_->delayed_send(self_, parts_.delay, SyncAtom::value);
  }

  void sync() {
    sync_is_due_ = false;
    if (gathered_.empty() || !news_.failure.empty())
      return;
    attempt([&] {
      parts_.file->append(gathered_);
      news_.synced = last_;
      ++news_.syncs;
    });
    gathered_.clear();
    changes_ = bytes_ = 0;
    tell();
    tidy_soon();
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
    sync();
    if (news_.failure.empty())
      attempt([&] { parts_.file->close(); });
    parts_.file.reset();
    stay_ = nullptr;
  }

private:
  template <class F>
  void attempt(F&& f) {
    try {
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
  std::vector<JournalGroupPtr> gathered_;
  std::size_t changes_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t last_ = 0;
  bool sync_is_due_ = false;
  bool tidy_is_due_ = false;
  JournalNews news_;
};

} // namespace

caf::behavior journal_writer(caf::event_based_actor* self, JournalWriterParts parts) {
  self->monitor(parts.owner);
  auto writer = std::make_shared<JournalWriter>(self, std::move(parts));
  // The news of the end overtakes what was written before it.
  self->set_down_handler([self](const caf::down_msg&) { self->send(self, CloseAtom::value); });
  return {
    [writer](const JournalWrite& x) { writer->take(x); },
    [writer](SyncAtom) { writer->sync(); },
    [writer](TidyAtom) { writer->tidy(); },
    [self, writer](CloseAtom) {
      writer->close();
      self->quit();
    },
  };
}

} // namespace castor
