#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/filter_group.hpp"
#include "castor/wm/filters/registered_filter.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace castor {

/// Finds the filters that match an event without testing the others.
///
/// A filter requires equality in some of five fields of the event. Filters on the same fields share
/// one hash table, keyed by the required values; an event is looked up once per table in use (at
/// most 32) and once per type it has. The result is a group, which indexes its filters by their
/// conditions on the content (FilterGroup). So the cost grows with the number of matching filters,
/// not of registered ones.
///
/// Not thread-safe: searches cache types.
class FilterIndex {
public:
  /// Chosen by the owner; a key of several filters is found once for each of them.
  using Key = std::uint64_t;

  /// The filter's subarchitecture must have been resolved (set, or empty for any).
  void insert(Key key, const ChangeFilter& filter);

  /// False if there was no such pair.
  bool erase(Key key, const ChangeFilter& filter);

  std::size_t size() const { return filters_.size(); }

  /// Appends the keys of all filters that match the event of an entry with that content (see
  /// `matches`), in no particular order.
  void match(const ChangeEvent& event, const Value& content, std::vector<Key>& out);

  /// Whether the result of `match` depends on the event's `changed`; if not, contents need not be
  /// compared.
  bool wants_changed_fields(const ChangeEvent& event) const;

private:
  static constexpr std::size_t shapes = 32;

  /// The table has changed.
  void note_use(unsigned shape);

  struct Table {
    /// By a hash of the required values, so the filters found are only likely to match.
    std::unordered_map<std::uint64_t, FilterGroup> groups;
    /// Number of filters with a condition on changed fields.
    std::size_t asking_for_changes = 0;
  };

  /// By a hash of key and filter; groups have pointers into it.
  std::unordered_multimap<std::uint64_t, RegisteredFilter> filters_;
  /// One for each set of required fields.
  std::array<Table, shapes> tables_;
  /// Of these, as sets of bits, those with filters, and those with a condition on changed fields.
  std::uint32_t used_ = 0;
  std::uint32_t asking_ = 0;
  std::uint64_t searches_ = 0;
};

} // namespace castor
