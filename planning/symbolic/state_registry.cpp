#include "castor/planning/symbolic/state_registry.hpp"

#include <algorithm>
#include <bit>

namespace castor::planning {

namespace {

constexpr std::size_t initial_slots = 1024;

} // namespace

StateRegistry::StateRegistry(const Task& task) : slots_(initial_slots, 0) {
  std::uint32_t word = 0;
  std::uint32_t used = 0;
  for (const int size : task.domain_sizes) {
    const auto bits =
      std::max(1U, static_cast<std::uint32_t>(std::bit_width(static_cast<unsigned>(size - 1))));
    if (used + bits > 64) {
      ++word;
      used = 0;
    }
    fields_.push_back({word, used, (std::uint64_t{1} << bits) - 1});
    used += bits;
  }
  words_per_state_ = word + 1;
  packed_.resize(words_per_state_);
}

std::uint64_t StateRegistry::hash(const std::uint64_t* words) const {
  std::uint64_t result = 0x9e3779b97f4a7c15U;
  for (std::size_t i = 0; i < words_per_state_; ++i) {
    result = (result ^ words[i]) * 0xff51afd7ed558ccdU;
    result ^= result >> 29;
  }
  return result;
}

void StateRegistry::grow() {
  std::vector<std::uint32_t> slots(slots_.size() * 2, 0);
  const auto mask = slots.size() - 1;
  for (std::size_t i = 0; i < count_; ++i) {
    auto slot = hash(&words_[i * words_per_state_]) & mask;
    while (slots[slot] != 0)
      slot = (slot + 1) & mask;
    slots[slot] = static_cast<std::uint32_t>(i + 1);
  }
  slots_ = std::move(slots);
}

std::pair<std::uint32_t, bool> StateRegistry::add(const State& state) {
  std::ranges::fill(packed_, 0);
  for (std::size_t i = 0; i < fields_.size(); ++i)
    packed_[fields_[i].word] |= static_cast<std::uint64_t>(state[i]) << fields_[i].shift;
  const auto mask = slots_.size() - 1;
  auto slot = hash(packed_.data()) & mask;
  for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
    const auto number = slots_[slot] - 1;
    if (std::equal(packed_.begin(), packed_.end(),
                   words_.begin() + static_cast<std::ptrdiff_t>(number * words_per_state_)))
      return {number, false};
  }
  const auto number = static_cast<std::uint32_t>(count_++);
  slots_[slot] = number + 1;
  words_.insert(words_.end(), packed_.begin(), packed_.end());
  if (count_ * 2 > slots_.size())
    grow();
  return {number, true};
}

void StateRegistry::get(std::uint32_t number, State& state) const {
  state.resize(fields_.size());
  const auto* words = &words_[number * words_per_state_];
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto& field = fields_[i];
    state[i] = static_cast<int>(words[field.word] >> field.shift & field.mask);
  }
}

} // namespace castor::planning
