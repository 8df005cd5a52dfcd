#include "castor/planning/symbolic/tuple_table.hpp"

#include <algorithm>

namespace castor::planning {

namespace {

std::size_t hash_of(TupleTable::Tuple tuple) {
  std::uint64_t result = 0x9e3779b97f4a7c15U;
  for (const int x : tuple) {
    result ^= static_cast<std::uint64_t>(x) + 0x9e3779b97f4a7c15U + (result << 6) + (result >> 2);
    result *= 0xff51afd7ed558ccdU;
    result ^= result >> 32;
  }
  return result;
}

} // namespace

std::size_t TupleTable::slot_of(Tuple tuple) const {
  const auto mask = slots_.size() - 1;
  auto slot = hash_of(tuple) & mask;
  while (slots_[slot] >= 0 &&
         !std::ranges::equal((*this)[static_cast<std::size_t>(slots_[slot])], tuple))
    slot = (slot + 1) & mask;
  return slot;
}

int TupleTable::find(Tuple tuple) const {
  return slots_[slot_of(tuple)];
}

std::pair<int, bool> TupleTable::add(Tuple tuple) {
  auto slot = slot_of(tuple);
  if (slots_[slot] >= 0)
    return {slots_[slot], false};
  if ((size() + 1) * 2 > slots_.size()) {
    grow();
    slot = slot_of(tuple);
  }
  const auto number = static_cast<int>(size());
  slots_[slot] = number;
  values_.insert(values_.end(), tuple.begin(), tuple.end());
  ends_.push_back(values_.size());
  return {number, true};
}

void TupleTable::grow() {
  std::vector<int> larger(slots_.size() * 2, -1);
  const auto mask = larger.size() - 1;
  for (std::size_t i = 0; i < size(); ++i) {
    auto slot = hash_of((*this)[i]) & mask;
    while (larger[slot] >= 0)
      slot = (slot + 1) & mask;
    larger[slot] = static_cast<int>(i);
  }
  slots_ = std::move(larger);
}

} // namespace castor::planning
