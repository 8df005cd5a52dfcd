#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/store/access_rules.hpp"
#include "castor/wm/store/lifetimes.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/store/tombstones.hpp"
#include "castor/wm/store/type_query.hpp"
#include "castor/wm/store/write_request.hpp"

#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

struct EntryStoreOptions {
  /// How many deleted ids keep their version; beyond that the oldest are forgotten.
  std::size_t remembered_deletions = 100'000;
  /// The largest value that is taken, in bytes of its wire form.
  std::size_t largest_value = std::size_t{256} << 20;
  /// That of the first entry of any id.
  Version first_version = 0;
};

/// What a working memory holds, and every rule for changing it.
///
/// A change has two steps: `prepare` makes all checks and touches nothing, `commit` applies what
/// was prepared and cannot fail. Whatever must happen before a change may be seen stands between
/// the two.
class EntryStore {
public:
  /// A prepared change.
  struct Effect {
    Operation operation;
    /// As it will be; for a deletion, as it was.
    EntryPtr entry;
    /// The component that makes the change.
    std::string source;
    /// As it was; for an overwrite.
    EntryPtr before = {};
    /// Whose end ends the entry; for the addition of an ephemeral one.
    ClientPtr owner = {};
  };

  explicit EntryStore(std::string subarchitecture, EntryStoreOptions options = {});

  /// The tables point into one another, so a store moves but is never copied.
  EntryStore(EntryStore&&) = default;
  EntryStore& operator=(EntryStore&&) = default;

  /// Takes up, as the first thing, what another store has left behind. The owners of ephemeral
  /// entries are not known any more: these are due. `time` is what `now` is since 1970.
  void restore(const StoreImage& image, Timestamp now, UnixTime time);

  const std::string& subarchitecture() const { return subarchitecture_; }
  AccessRules& access() { return access_; }

  /// Why these writes cannot be one: they have to be of different entries, all of them here.
  std::optional<Failure> check_atomic(std::span<const WriteRequest> requests) const;

  Outcome<Effect> prepare(const WriteRequest& request) const;

  /// Applies an effect of `prepare`, and says what happened; which fields changed is left out.
  /// Since it was prepared, only others of the same atomic write may have been committed.
  std::shared_ptr<ChangeEvent> commit(Effect effect, Timestamp now);

  // -- entries that end of themselves

  /// Those of the entries that are there.
  Lifetimes& lifetimes() { return lifetimes_; }
  const Lifetimes& lifetimes() const { return lifetimes_; }

  /// The deletion of an entry that is due.
  Effect prepare_forgetting(const std::string& id) const;

  // -- reading

  Outcome<EntryPtr> read(const std::string& id) const;

  /// The most recently written entries first.
  std::vector<EntryPtr> read_by_type(const TypeQuery& query) const;

  bool exists(const std::string& id) const { return entries_.count(id) > 0; }

  /// The entry's version, or the last it had if it was deleted. Fails if it never existed (or was
  /// deleted too long ago to be remembered).
  Outcome<Version> version(const std::string& id) const;

  std::size_t size() const { return entries_.size(); }

  /// How many events were made so far.
  std::uint64_t sequence() const { return sequence_; }

private:
  /// Most recently written first.
  using Recency = std::list<EntryPtr>;

  struct Slot {
    EntryPtr entry;
    /// When it was last written, as a count of writes.
    std::uint64_t written = 0;
    Recency::iterator position;
    /// Whether `lifetimes_` knows it.
    bool may_end = false;
  };

  struct TypeTable {
    TypeDescriptorPtr type;
    Recency recency;
  };

  /// Why there is no entry of that id.
  std::string absence(const std::string& id) const;
  Failure missing(const WriteRequest& request) const;
  std::optional<Failure> check_address(const WriteRequest& request) const;
  std::optional<Failure> check_value(const WriteRequest& request) const;
  std::optional<Failure> check_type(const WriteRequest& request) const;

  std::string subarchitecture_;
  EntryStoreOptions options_;
  AccessRules access_;
  std::unordered_map<std::string, Slot> entries_;
  std::unordered_map<std::string, TypeTable> types_;
  Tombstones tombstones_;
  Lifetimes lifetimes_;
  std::uint64_t sequence_ = 0;
};

} // namespace castor
