#pragma once

#include "castor/wm/entries/entry.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace castor {

/// The last versions of deleted entries, so that no version is used twice for the same id. Beyond a
/// limit the oldest one is removed, and the floor rises above its version.
class Tombstones {
public:
  struct Tombstone {
    std::string id;
    /// Version at the deletion.
    Version version = 0;
    /// Sequence number of the deletion.
    std::uint64_t sequence = 0;
  };

  explicit Tombstones(std::size_t limit, Version floor = 0) : limit_(limit), floor_(floor) {}

  /// The tables have pointers into one another, so tombstones can be moved but not copied.
  Tombstones(Tombstones&&) = default;
  Tombstones& operator=(Tombstones&& x) noexcept {
    // Tables are freed in the memory that they were made in.
    std::destroy_at(this);
    return *std::construct_at(this, std::move(x));
  }

  /// The entry was deleted. Returns the tombstone that is removed to make room, if any.
  std::optional<Tombstone> add(const std::string& id, Version version, std::uint64_t sequence);

  /// The entry was added again; false if there is no tombstone.
  bool erase(const std::string& id);

  bool contains(const std::string& id) const { return by_id_.count(id) > 0; }

  /// Last version of the entry, in the present incarnation.
  std::optional<Version> version(const std::string& id) const;

  /// The version of an entry that is added under the id.
  Version version_for_add(const std::string& id) const;

  /// Begins a new incarnation with this number: it is the minimum of the floor, and of the versions
  /// of all earlier deletions.
  void begin_incarnation(std::uint64_t first_number);

  /// A version in an incarnation whose numbers begin with `first_number`: versions written before
  /// are raised to at least that number.
  static Version version_in_incarnation(Version version, std::uint64_t sequence,
                                        std::uint64_t first_number) {
    return sequence <= first_number ? std::max(version, first_number) : version;
  }

  /// Above the versions of all removed tombstones.
  Version floor() const { return floor_; }
  void raise_floor(Version floor);

  std::size_t size() const { return tombstones_.size(); }

  /// Calls `f` with id and version in the present incarnation, the oldest deletion first.
  template <class F>
  void for_each(F&& f) const {
    for (auto& x : tombstones_)
      f(x.id, current_version(x));
  }

private:
  using List = std::pmr::list<Tombstone>;

  Version current_version(const Tombstone& x) const {
    return version_in_incarnation(x.version, x.sequence, first_number_);
  }

  std::size_t limit_;
  Version floor_;
  /// First number of the present incarnation.
  std::uint64_t first_number_ = 0;
  /// What remains of deleted entries does not lie between them, so that their memory can be given
  /// back.
  std::unique_ptr<std::pmr::memory_resource> memory_ =
    std::make_unique<std::pmr::unsynchronized_pool_resource>();
  /// The oldest deletion first.
  List tombstones_{memory_.get()};
  std::pmr::unordered_map<std::string, List::iterator> by_id_{memory_.get()};
};

} // namespace castor
