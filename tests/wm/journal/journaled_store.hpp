#pragma once

#include "castor/wm/journal/journal.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

struct Note {
  std::int64_t number = 0;
  std::string text;
};
CASTOR_REFLECT(Note, number, text)

struct SignedNote : Note {
  std::string author;
};
CASTOR_REFLECT_DERIVED(SignedNote, Note, author)

/// What a store holds, so that it can be compared and printed.
struct Picture {
  /// "id v3 type by writer: bytes", the most recently written first.
  std::vector<std::string> entries;
  /// What ids that were used have as their last version, and what the others would begin with.
  std::vector<std::string> versions;
  std::uint64_t sequence = 0;

  bool operator==(const Picture&) const = default;

  friend std::ostream& operator<<(std::ostream& out, const Picture& x) {
    out << "after change " << x.sequence;
    for (auto& line : x.entries)
      out << "\n  " << line;
    for (auto& line : x.versions)
      out << "\n  " << line;
    return out;
  }
};

/// A store whose changes go to a journal, as those of a working memory do.
class JournaledStore {
public:
  static constexpr std::size_t ids = 8;

  explicit JournaledStore(JournalOptions options, const std::string& subarchitecture = "a")
    : JournaledStore(open_journal(options, subarchitecture), options, subarchitecture) {}

  EntryStore& store() { return store_; }
  JournalFile& file() { return *opened_.file; }
  const OpenedJournal& opened() const { return opened_; }

  static std::string id(std::size_t number) { return "e" + std::to_string(number % ids); }

  /// One write; false if it is refused.
  bool write(std::vector<WriteRequest> requests) {
    for (auto& x : requests)
      x.client = client_;
    if (store_.check_atomic(requests))
      return false;
    std::vector<EntryStore::Effect> effects;
    for (auto& x : requests) {
      auto effect = store_.prepare(x);
      if (!effect)
        return false;
      effects.push_back(*std::move(effect));
    }
    auto group = std::make_shared<JournalGroup>();
    for (auto& effect : effects) {
      auto entry = effect.entry;
      auto before = effect.before;
      auto event = store_.commit(std::move(effect), Timestamp{++clock_});
      group->push_back(record_of(*event, *entry, before, opened_.time));
      group->back().write = group->front().sequence;
    }
    unsynced_.push_back(std::move(group));
    return true;
  }

  WriteRequest change(std::size_t entry, std::int64_t number, bool derived = false) const {
    Address address{store_.subarchitecture(), id(entry)};
    auto value =
      derived ? Value::of(SignedNote{{number, "text"}, "me"}) : Value::of(Note{number, "text"});
    auto old = store_.read(address.id);
    if (!old)
      return {Operation::add, address, value, {}, {}};
    if (number % 4 == 0 || (*old)->type_name() != value.type_name())
      return {Operation::remove, address, {}, {}, {}};
    return {Operation::overwrite, address, value, (*old)->version, {}};
  }

  bool set(std::size_t entry, std::int64_t number) { return write({change(entry, number)}); }

  /// Writes down what was not yet.
  void sync() {
    if (!unsynced_.empty())
      file().append(std::exchange(unsynced_, {}));
  }

  void tidy() {
    while (file().tidy()) {
      // Until there is nothing more to do.
    }
  }

  Picture picture() const { return picture_of(store_); }

  static Picture picture_of(const EntryStore& store) {
    Picture result;
    for (auto& x : store.read_by_type({}))
      result.entries.push_back(x->address.id + " v" + std::to_string(x->version) + ' ' +
                               x->type_name() + " by " + x->writer + ": " +
                               std::string(x->value.bytes().begin(), x->value.bytes().end()));
    for (std::size_t i = 0; i <= ids; ++i) {
      auto name = i == ids ? "never used" : id(i);
      auto version = store.version(name);
      WriteRequest request{
        Operation::add, {store.subarchitecture(), name}, Value::of(Note{}), {}, {}};
      request.client = std::make_shared<const Client>(Client{"c", store.subarchitecture()});
      auto begins = store.prepare(request);
      result.versions.push_back(name + ": " + (version ? std::to_string(*version) : "none") +
                                ", next " +
                                (begins ? std::to_string(begins->entry->version) : "taken"));
    }
    result.sequence = store.sequence();
    return result;
  }

private:
  JournaledStore(OpenedJournal opened, const JournalOptions& options,
                 const std::string& subarchitecture)
    : opened_(std::move(opened)),
      store_(subarchitecture, {options.remembered_deletions, std::size_t{256} << 20}),
      client_(std::make_shared<const Client>(Client{"tester", subarchitecture})) {
    store_.restore(opened_.image, Timestamp{0}, opened_.time);
  }

  OpenedJournal opened_;
  EntryStore store_;
  ClientPtr client_;
  std::int64_t clock_ = 0;
  std::vector<JournalGroupPtr> unsynced_;
};

} // namespace castor::test
