#include "castor/wm/filters/filter_index.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <string_view>
#include <utility>

namespace castor {

namespace {

enum Asks : unsigned { operation = 1, id = 2, source = 4, subarchitecture = 8, type = 16 };

unsigned shape_of(const ChangeFilter& x) {
  return (x.operation ? Asks::operation : 0u) | (x.id.empty() ? 0u : Asks::id) |
         (x.source.empty() ? 0u : Asks::source) |
         (!x.subarchitecture || x.subarchitecture->empty() ? 0u : Asks::subarchitecture) |
         (x.type.empty() ? 0u : Asks::type);
}

std::uint64_t mix(std::uint64_t seed, std::uint64_t x) {
  x *= 0x9e3779b97f4a7c15ull;
  x ^= x >> 32;
  return (seed ^ x) * 0xff51afd7ed558ccdull;
}

std::uint64_t hash(std::string_view x) {
  return std::hash<std::string_view>{}(x);
}

std::uint64_t key_of(unsigned shape, Operation op, std::uint64_t id_hash, std::uint64_t source_hash,
                     std::uint64_t subarchitecture_hash, std::uint64_t type_hash) {
  std::uint64_t key = shape;
  if (shape & Asks::operation)
    key = mix(key, static_cast<std::uint64_t>(op) + 1);
  if (shape & Asks::id)
    key = mix(key, id_hash);
  if (shape & Asks::source)
    key = mix(key, source_hash);
  if (shape & Asks::subarchitecture)
    key = mix(key, subarchitecture_hash);
  if (shape & Asks::type)
    key = mix(key, type_hash);
  return key;
}

std::uint64_t key_of(const ChangeFilter& x) {
  return key_of(shape_of(x), x.operation.value_or(Operation::add), hash(x.id), hash(x.source),
                hash(x.subarchitecture.value_or("")), hash(x.type));
}

/// The hashes of what filters may ask of an event, but for its super types.
struct EventHashes {
  explicit EventHashes(const ChangeEvent& event)
    : id(hash(event.address.id)), source(hash(event.source)),
      subarchitecture(hash(event.address.subarchitecture)), type(hash(event.type->name())) {}

  std::uint64_t id;
  std::uint64_t source;
  std::uint64_t subarchitecture;
  std::uint64_t type;
};

/// Of the pair as a whole.
std::uint64_t hash(FilterIndex::Key key, const ChangeFilter& x) {
  auto result = mix(mix(key, key_of(x)), hash(x.predicate.text()));
  for (auto& name : x.changing)
    result = mix(result, hash(name));
  return result;
}

/// Calls `f(key of a group)` for the groups of one table in which filters may want the event.
template <class F>
void for_each_group(unsigned shape, const ChangeEvent& event, const EventHashes& hashes, F&& f) {
  auto look_up = [&](std::uint64_t type) {
    f(key_of(shape, event.operation, hashes.id, hashes.source, hashes.subarchitecture, type));
  };
  look_up(hashes.type);
  if (shape & Asks::type)
    for (auto& super_type : event.type->super_types)
      look_up(hash(super_type));
}

/// Calls `f` with the shape of each table in the set.
template <class F>
void for_each_shape(std::uint32_t set, F&& f) {
  for (; set != 0; set &= set - 1)
    f(static_cast<unsigned>(std::countr_zero(set)));
}

} // namespace

void FilterIndex::insert(Key key, const ChangeFilter& filter) {
  auto i = filters_.emplace(hash(key, filter), RegisteredFilter{key, filter, {}, 0});
  auto shape = shape_of(filter);
  auto& table = tables_[shape];
  table.groups[key_of(filter)].insert(&i->second);
  table.asking_for_changes += filter.changing.empty() ? 0 : 1;
  note_use(shape);
}

void FilterIndex::note_use(unsigned shape) {
  auto note = [bit = std::uint32_t{1} << shape](std::uint32_t& set, bool is_in) {
    set = is_in ? set | bit : set & ~bit;
  };
  note(used_, !tables_[shape].groups.empty());
  note(asking_, tables_[shape].asking_for_changes > 0);
}

bool FilterIndex::erase(Key key, const ChangeFilter& filter) {
  auto [first, last] = filters_.equal_range(hash(key, filter));
  auto i = std::find_if(first, last,
                        [&](auto& x) { return x.second.key == key && x.second.filter == filter; });
  if (i == last)
    return false;
  auto shape = shape_of(filter);
  auto& table = tables_[shape];
  auto group = table.groups.find(key_of(filter));
  group->second.erase(&i->second);
  if (group->second.empty())
    table.groups.erase(group);
  table.asking_for_changes -= filter.changing.empty() ? 0 : 1;
  note_use(shape);
  filters_.erase(i);
  return true;
}

void FilterIndex::match(const ChangeEvent& event, const Value& content, std::vector<Key>& out) {
  if (used_ == 0)
    return;
  EventHashes hashes{event};
  ++searches_;
  for_each_shape(used_, [&](unsigned shape) {
    auto& groups = tables_[shape].groups;
    for_each_group(shape, event, hashes, [&](std::uint64_t key) {
      auto group = groups.find(key);
      if (group == groups.end())
        return;
      group->second.find(event, content, [&](RegisteredFilter& x) {
        if (std::exchange(x.seen, searches_) != searches_ && x.matches(event, content))
          out.push_back(x.key);
      });
    });
  });
}

bool FilterIndex::wants_changed_fields(const ChangeEvent& event) const {
  if (event.operation != Operation::overwrite || asking_ == 0)
    return false;
  EventHashes hashes{event};
  bool result = false;
  for_each_shape(asking_, [&](unsigned shape) {
    auto& groups = tables_[shape].groups;
    for_each_group(shape, event, hashes, [&](std::uint64_t key) {
      auto group = groups.find(key);
      result = result || (group != groups.end() && group->second.asks_for_changes());
    });
  });
  return result;
}

} // namespace castor
