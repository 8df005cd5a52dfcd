#include "castor/wm/memory/journal_outbox.hpp"

#include "castor/wm/journal/journal_writer.hpp"

#include <memory>

namespace castor {

namespace {

/// Between synced and acknowledged lies nothing, or what a crash may cost.
OutputGate::Bounds bounds(const JournalOptions& options) {
  if (options.mode == JournalMode::batched)
    return {options.most_unsynced, options.most_unsynced_bytes};
  return {};
}

caf::actor start_writer(WorkingMemoryActor::pointer self, const JournalOptions& options,
                        const std::shared_ptr<JournalFile>& file) {
  auto parts = journal_writer_parts(options, file, caf::actor_cast<caf::strong_actor_ptr>(self));
  return options.own_thread ? self->system().spawn<caf::detached>(journal_writer, std::move(parts))
                            : self->system().spawn(journal_writer, std::move(parts));
}

} // namespace

void JournalOutbox::open(const WorkingMemoryOptions& options, Timestamp now) {
  auto& opened = *options.opened_journal;
  subarchitecture_ = options.subarchitecture;
  clock_ = options.clock;
  options_ = options.journal;
  status_.mode = options_.mode;
  if (!opened.failure.empty()) {
    status_.failure = opened.failure;
    return;
  }
  status_.incarnation = opened.incarnation;
  gate_ = OutputGate{bounds(options_)};
  began_ = opened.time - now;
  writer_ =
    options.journal_writer ? options.journal_writer : start_writer(self_, options_, opened.file);
}

void JournalOutbox::append(const std::vector<CommittedChange>& changes) {
  auto group = std::make_shared<JournalGroup>();
  group->reserve(changes.size());
  std::size_t bytes = 0;
  for (auto& [event, entry, before] : changes) {
    auto& x = group->emplace_back(record_of(*event, *entry, before, began_));
    x.write = changes.front().event->sequence;
    if (x.value.has_value())
      bytes += x.value.encoded_size();
  }
  gate_.written(group->back().sequence, group->size(), bytes);
  caf::anon_send(writer_, JournalWrite{std::move(group), bytes});
}

void JournalOutbox::receive(const JournalNews& news) {
  if (!writer_)
    return;
  status_.bytes = news.bytes;
  status_.syncs = news.syncs;
  if (news.failure.empty()) {
    gate_.synced(news.synced);
    release_time_if_empty();
    return;
  }
  status_.failure = news.failure;
  if (options_.go_on_without) {
    options_.report(news.failure + ". " + subarchitecture_ +
                    " goes on without a journal: changes from now on are lost when it ends");
    writer_ = nullptr;
    gate_.open();
    release_time_if_empty();
    return;
  }
  gate_.synced(news.synced);
  gate_.drop();
  release_time_if_empty();
  auto why = news.failure + ". The working memory of " + subarchitecture_ +
             (options_.mode == JournalMode::full
                ? " ends; everything that it has acknowledged is in its journal"
                : " ends; what it has acknowledged last may be lost");
  options_.report(why);
  self_->quit(caf::make_error(caf::sec::runtime_error, why));
}

void JournalOutbox::release_time_if_empty() {
  if (gate_.waiting() == 0)
    time_hold_.reset();
}

void JournalOutbox::inject_fault(const JournalFault& fault) {
  if (writer_)
    caf::anon_send(writer_, fault);
}

JournalStatus JournalOutbox::status() const {
  auto result = status_;
  result.unsynced = gate_.unsynced();
  result.held = gate_.waiting();
  return result;
}

} // namespace castor
