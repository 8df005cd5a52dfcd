#pragma once

#include "castor/wm/entries/entry.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <unordered_map>

namespace castor {

/// The last versions of deleted entries, so that no version comes twice for the same id. Beyond a
/// limit the longest deleted is forgotten, and the floor rises above its version.
class Tombstones {
public:
  struct Tombstone {
    std::string id;
    /// As it was when the entry was deleted.
    Version version = 0;
    /// The number of the deletion.
    std::uint64_t sequence = 0;
  };

  explicit Tombstones(std::size_t limit, Version floor = 0) : limit_(limit), floor_(floor) {}

  /// The tables point into one another, so tombstones move but are never copied.
  Tombstones(Tombstones&&) = default;
  Tombstones& operator=(Tombstones&&) = default;

  /// The entry was deleted. Returns the tombstone that is forgotten for it, if any.
  std::optional<Tombstone> add(const std::string& id, Version version, std::uint64_t sequence);

  /// The entry was added again; false if there is no tombstone.
  bool erase(const std::string& id);

  bool contains(const std::string& id) const { return by_id_.count(id) > 0; }

  /// The version that the entry had last, as it counts now.
  std::optional<Version> version(const std::string& id) const;

  /// The version of an entry that is added under the id.
  Version version_for_add(const std::string& id) const;

  /// A new incarnation begins with this number: all versions of deletions up to it, and the floor,
  /// count as no less.
  void begin_incarnation(std::uint64_t first_number);

  /// A version as it counts in an incarnation whose numbers begin with `first_number`: none that
  /// was written before is less.
  static Version version_in_incarnation(Version version, std::uint64_t sequence,
                                        std::uint64_t first_number) {
    return sequence <= first_number ? std::max(version, first_number) : version;
  }

  /// Above every version that was forgotten.
  Version floor() const { return floor_; }
  void raise_floor(Version floor);

  std::size_t size() const { return tombstones_.size(); }

  /// Calls `f` with id and version as it counts now, the longest deleted first.
  template <class F>
  void for_each(F&& f) const {
    for (auto& x : tombstones_)
      f(x.id, current_version(x));
  }

private:
  using List = std::list<Tombstone>;

  Version current_version(const Tombstone& x) const {
    return version_in_incarnation(x.version, x.sequence, first_number_);
  }

  std::size_t limit_;
  Version floor_;
  /// The first of the present incarnation's numbers.
  std::uint64_t first_number_ = 0;
  /// The longest deleted first.
  List tombstones_;
  std::unordered_map<std::string, List::iterator> by_id_;
};

} // namespace castor
