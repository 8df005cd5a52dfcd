#pragma once

#include "castor/wm/access_rules.hpp"
#include "castor/wm/change_event.hpp"
#include "castor/wm/entry.hpp"
#include "castor/wm/failure.hpp"

#include <cstddef>
#include <list>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

/// The component behind an operation.
struct Writer {
  std::string component;
  std::string subarchitecture;
};

/// A wish to change an entry.
struct WriteRequest {
  Operation operation = Operation::add;
  Address address;
  /// Not for a deletion.
  Value value;
  /// For an overwrite: the version that the component last read or wrote; nothing if it never did.
  std::optional<Version> last_seen;
  Writer writer;
};

/// Which entries a reader wants.
struct TypeQuery {
  std::string subarchitecture;
  /// Empty for every type.
  std::string type;
  /// At most so many, the most recently written ones; 0 for all.
  std::size_t count = 0;
  /// Whether entries of types that derive from `type` count too.
  bool with_derived = false;
};

struct EntryStoreOptions {
  /// How many deleted ids keep their version; beyond that the oldest are forgotten.
  std::size_t remembered_deletions = 100'000;
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
  };

  explicit EntryStore(std::string subarchitecture, EntryStoreOptions options = {});

  /// The tables point into one another, so a store moves but is never copied.
  EntryStore(EntryStore&&) = default;
  EntryStore& operator=(EntryStore&&) = default;

  const std::string& subarchitecture() const { return subarchitecture_; }
  AccessRules& access() { return access_; }

  Outcome<Effect> prepare(const WriteRequest& request) const;

  /// Applies an effect of `prepare`, with no other commit in between, and says what happened.
  ChangeEventPtr commit(Effect effect, Timestamp now);

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
  };

  struct TypeTable {
    TypeDescriptorPtr type;
    Recency recency;
  };

  struct Tombstone {
    Version version;
    std::list<std::string>::iterator burial;
  };

  /// Why there is no entry of that id.
  std::string absence(const std::string& id) const;
  Failure missing(const WriteRequest& request) const;
  std::optional<Failure> check_type(const WriteRequest& request) const;
  Version version_for_add(const std::string& id) const;
  void bury(const std::string& id, Version version);
  void exhume(const std::string& id);

  std::string subarchitecture_;
  EntryStoreOptions options_;
  AccessRules access_;
  std::unordered_map<std::string, Slot> entries_;
  std::unordered_map<std::string, TypeTable> types_;
  std::unordered_map<std::string, Tombstone> tombstones_;
  /// The ids of the tombstones, the longest deleted first.
  std::list<std::string> burials_;
  /// Above every version that was forgotten.
  Version floor_ = 0;
  std::uint64_t sequence_ = 0;
};

} // namespace castor
