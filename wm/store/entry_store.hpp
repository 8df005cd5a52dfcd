#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/store/access_rules.hpp"
#include "castor/wm/store/entry_table.hpp"
#include "castor/wm/store/lifetimes.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/store/tombstones.hpp"
#include "castor/wm/store/type_query.hpp"
#include "castor/wm/store/write_request.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

struct EntryStoreOptions {
  /// Maximum number of deleted ids whose version is kept; the oldest are removed.
  std::size_t remembered_deletions = 100'000;
  /// Maximum size of a value, in bytes of its wire form.
  std::size_t largest_value = std::size_t{256} << 20;
  /// Version of the first entry of every id.
  Version first_version = 0;
  /// Table for the entries, from which other threads read; null for one that nobody else has.
  std::shared_ptr<EntryTable> entries = {};
};

/// Entries of a working memory, and the rules for changing them.
///
/// A change has two steps: `prepare` makes all checks and changes nothing, `commit` applies the
/// prepared change and cannot fail. Actions that must happen before a change is visible go between
/// the two.
class EntryStore {
public:
  /// A prepared change.
  struct Effect {
    Operation operation;
    /// The entry after the change; for a deletion, before it.
    EntryPtr entry;
    /// The component that makes the change.
    std::string source;
    /// The entry before an overwrite.
    EntryPtr before = {};
    /// Owner of an added ephemeral entry; else null.
    ClientPtr owner = {};
    /// The client whose will the entry has from now on, and the will; nothing to keep the former.
    ClientPtr testator = {};
    std::optional<LastWill> last_will = {};
  };

  explicit EntryStore(std::string subarchitecture, EntryStoreOptions options = {});

  /// The tables have pointers into one another, so a store can be moved but not copied.
  EntryStore(EntryStore&&) = default;
  EntryStore& operator=(EntryStore&&) = default;

  /// Restores the content of an earlier store; to be called first. The owners of ephemeral entries
  /// are not known any more, so these entries are due. `time` is `now` as a Unix time.
  void restore(const StoreImage& image, Timestamp now, UnixTime time);

  const std::string& subarchitecture() const { return subarchitecture_; }
  AccessRules& access() { return access_; }
  const AccessRules& access() const { return access_; }

  /// Failure if the client may not read here; null for the runtime itself, which may.
  std::optional<Failure> check_may_read(const ClientPtr& client, const Address& address) const;

  /// Failure if these writes cannot be one atomic write: they must be of different entries, all of
  /// this working memory.
  std::optional<Failure> check_atomic(std::span<const WriteRequest> requests) const;

  Outcome<Effect> prepare(const WriteRequest& request) const;

  /// Applies an effect of `prepare`, and returns its event, without the changed fields. Between the
  /// two calls, only other effects of the same atomic write may be committed.
  std::shared_ptr<ChangeEvent> commit(Effect effect, Timestamp now);

  // -- entries with a lifetime

  /// Lifetimes of the present entries.
  Lifetimes& lifetimes() { return lifetimes_; }
  const Lifetimes& lifetimes() const { return lifetimes_; }

  /// Prepares what is due for an entry: its deletion, or its overwrite by a last will.
  Effect prepare_due(const std::string& id) const;

  // -- reading

  /// The entries, as other threads read them.
  EntryTable& entries() const { return *entries_; }

  Outcome<EntryPtr> read(const std::string& id) const;

  /// The most recently written entries first.
  std::vector<EntryPtr> read_by_type(const TypeQuery& query) const;

  /// How many entries there are of each type of which there are any.
  std::map<std::string, std::uint64_t> counts_by_type() const;

  bool exists(const std::string& id) const { return entries_->find(id) != nullptr; }

  /// The entry's version, or the last one before its deletion. Fails if it never existed (or was
  /// deleted too long ago to be remembered).
  Outcome<Version> version(const std::string& id) const;

  std::size_t size() const { return entries_->size(); }

  /// Number of events so far.
  std::uint64_t sequence() const { return sequence_; }

private:
  struct TypeTable {
    TypeDescriptorPtr type;
    Recency recency;
  };

  /// Reason for messages why there is no entry of that id.
  std::string absence(const std::string& id) const;
  Failure missing(const WriteRequest& request) const;
  bool may_write(const WriteRequest& request) const;
  std::optional<Failure> check_address(const WriteRequest& request) const;
  std::optional<Failure> check_value(const WriteRequest& request) const;
  std::optional<Failure> check_will(const WriteRequest& request) const;
  std::optional<Failure> check_type(const WriteRequest& request) const;

  std::string subarchitecture_;
  EntryStoreOptions options_;
  AccessRules access_;
  std::shared_ptr<EntryTable> entries_;
  std::unordered_map<std::string, TypeTable> types_;
  Tombstones tombstones_;
  Lifetimes lifetimes_;
  std::uint64_t sequence_ = 0;
};

} // namespace castor
