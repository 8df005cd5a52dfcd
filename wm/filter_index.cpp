#include "castor/wm/filter_index.hpp"

#include <functional>
#include <string_view>

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

} // namespace

void FilterIndex::insert(Key key, const ChangeFilter& filter) {
  tables_[shape_of(filter)].emplace(key_of(filter), Slot{filter, key});
  ++size_;
}

bool FilterIndex::erase(Key key, const ChangeFilter& filter) {
  auto& table = tables_[shape_of(filter)];
  auto [first, last] = table.equal_range(key_of(filter));
  for (auto i = first; i != last; ++i) {
    if (i->second.key == key && i->second.filter == filter) {
      table.erase(i);
      --size_;
      return true;
    }
  }
  return false;
}

void FilterIndex::match(const ChangeEvent& event, std::vector<Key>& out) const {
  auto id_hash = hash(event.address.id);
  auto source_hash = hash(event.source);
  auto subarchitecture_hash = hash(event.address.subarchitecture);
  for (unsigned shape = 0; shape < shapes; ++shape) {
    auto& table = tables_[shape];
    if (table.empty())
      continue;
    auto look_up = [&](std::string_view type_name) {
      auto key =
        key_of(shape, event.operation, id_hash, source_hash, subarchitecture_hash, hash(type_name));
      auto [first, last] = table.equal_range(key);
      for (auto i = first; i != last; ++i)
        if (matches(i->second.filter, event) &&
            (i->second.filter.type.empty() || i->second.filter.type == type_name))
          out.push_back(i->second.key);
    };
    look_up(event.type->name());
    if (shape & Asks::type)
      for (auto& super_type : event.type->super_types)
        look_up(super_type);
  }
}

} // namespace castor
