#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/filter_group.hpp"
#include "castor/wm/filters/registered_filter.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace castor {

/// Finds the filters that want an event without looking at the others.
///
/// A filter asks for equality in some of five fields of the event. Filters that ask for the same
/// fields share one hash table, keyed by what they ask for; an event is looked up once per table in
/// use (at most 32) and once per type it has. What it finds there is a group, in which filters are
/// found by what they ask of the content (FilterGroup). So the cost grows with the filters that
/// match, not with those registered.
///
/// For one thread at a time: searches remember the types they met.
class FilterIndex {
public:
  /// Chosen by the owner; one key may stand for several filters and then is found once for each.
  using Key = std::uint64_t;

  /// The filter's subarchitecture must have been resolved (set, or empty for any).
  void insert(Key key, const ChangeFilter& filter);

  /// False if there was no such pair.
  bool erase(Key key, const ChangeFilter& filter);

  std::size_t size() const { return filters_.size(); }

  /// Appends the keys of all filters that want the event of an entry with that content (as
  /// `matches` says), in no particular order.
  void match(const ChangeEvent& event, const Value& content, std::vector<Key>& out);

  /// Whether the event's `changed` makes a difference to `match`: where it does not, nobody need
  /// compare the contents.
  bool wants_changed_fields(const ChangeEvent& event) const;

private:
  static constexpr std::size_t shapes = 32;

  struct Table {
    /// By a hash of what is asked; so what is found there is only likely to match.
    std::unordered_map<std::uint64_t, FilterGroup> groups;
    /// How many filters ask for changed fields.
    std::size_t asking_for_changes = 0;
  };

  /// By a hash of key and filter; groups point into it.
  std::unordered_multimap<std::uint64_t, RegisteredFilter> filters_;
  /// One for each set of fields asked for.
  std::array<Table, shapes> tables_;
  std::uint64_t searches_ = 0;
};

} // namespace castor
