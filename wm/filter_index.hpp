#pragma once

#include "castor/wm/change_filter.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace castor {

/// Finds the filters that want an event without looking at the others.
///
/// A filter asks for equality in some of five fields. Filters that ask for the same fields share
/// one hash table, keyed by what they ask for; an event is looked up once per table in use (at most
/// 32) and once per type it has. So the cost grows with the filters that match, not with those
/// registered.
class FilterIndex {
public:
  /// Chosen by the owner; one key may stand for several filters and then is found once for each.
  using Key = std::uint64_t;

  /// The filter's subarchitecture must have been resolved (set, or empty for any).
  void insert(Key key, const ChangeFilter& filter);

  /// False if there was no such pair.
  bool erase(Key key, const ChangeFilter& filter);

  std::size_t size() const { return size_; }

  /// Appends the keys of all filters that want the event, in no particular order.
  void match(const ChangeEvent& event, std::vector<Key>& out) const;

private:
  struct Slot {
    ChangeFilter filter;
    Key key;
  };

  static constexpr std::size_t shapes = 32;

  /// One table per set of fields asked for; the key is a hash of what is asked, checked on a hit.
  std::array<std::unordered_multimap<std::uint64_t, Slot>, shapes> tables_;
  std::size_t size_ = 0;
};

} // namespace castor
