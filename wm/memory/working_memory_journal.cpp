#include "castor/wm/journal/journal_writer.hpp"
#include "castor/wm/memory/working_memory_parts.hpp"

#include <memory>
#include <utility>

namespace castor::working_memory_parts {

namespace {

/// Between synced and acknowledged lies nothing, or what a crash may cost.
OutputGate::Bounds bounds(const JournalOptions& options) {
  if (options.mode == JournalMode::batched)
    return {options.most_unsynced, options.most_unsynced_bytes};
  return {};
}

caf::actor start_writer(Self self, const std::shared_ptr<JournalFile>& file) {
  auto& options = self->state.options.journal;
  auto parts = journal_writer_parts(options, file, caf::actor_cast<caf::strong_actor_ptr>(self));
  return options.own_thread ? self->system().spawn<caf::detached>(journal_writer, std::move(parts))
                            : self->system().spawn(journal_writer, std::move(parts));
}

} // namespace

void begin_journal(Self self) {
  auto& state = self->state;
  auto& opened = *state.options.opened_journal;
  state.journal_status.mode = state.options.journal.mode;
  if (!opened.failure.empty()) {
    state.journal_status.failure = std::move(opened.failure);
    state.options.opened_journal.reset();
    return;
  }
  state.journal_status.incarnation = opened.incarnation;
  state.gate = OutputGate{bounds(state.options.journal)};
  state.began = opened.time - now(self);
  state.store.restore(opened.image, now(self), opened.time);
  // Of whatever session: a lease's token is never that of another.
  auto leases = state.options.leases;
  leases.first_token = opened.session * numbers_per_incarnation + 1;
  state.leases = LeaseTable{leases};
  state.journal =
    state.options.journal_writer ? state.options.journal_writer : start_writer(self, opened.file);
  state.options.opened_journal.reset();
  set_alarm(self);
}

void write_down(Self self, const std::vector<Change>& changes) {
  auto& state = self->state;
  auto group = std::make_shared<JournalGroup>();
  group->reserve(changes.size());
  std::size_t bytes = 0;
  for (auto& [event, entry, before] : changes) {
    auto& x = group->emplace_back(record_of(*event, *entry, before, state.began));
    x.write = changes.front().event->sequence;
    if (x.value.has_value())
      bytes += x.value.encoded_size();
  }
  state.gate.written(group->back().sequence, group->size(), bytes);
  caf::anon_send(state.journal, JournalWrite{std::move(group), bytes});
}

void hear_of_journal(Self self, const JournalNews& news) {
  auto& state = self->state;
  if (!state.journal)
    return;
  state.journal_status.bytes = news.bytes;
  state.journal_status.syncs = news.syncs;
  if (news.failure.empty()) {
    state.gate.synced(news.synced);
    return;
  }
  auto& options = state.options.journal;
  state.journal_status.failure = news.failure;
  if (options.go_on_without) {
    options.report(news.failure + ". " + state.options.subarchitecture +
                   " goes on without a journal: what is written from now on does not outlive it");
    state.journal = nullptr;
    state.gate.open();
    return;
  }
  state.gate.synced(news.synced);
  state.gate.drop();
  auto why = news.failure + ". The working memory of " + state.options.subarchitecture +
             (options.mode == JournalMode::full
                ? " ends; everything that it has acknowledged is in its journal"
                : " ends; what it has acknowledged last may be lost");
  options.report(why);
  self->quit(caf::make_error(caf::sec::runtime_error, why));
}

} // namespace castor::working_memory_parts
