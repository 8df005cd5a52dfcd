#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace castor::faults {

/// Random numbers determined by a seed and equal on every machine, which the distributions of the
/// standard library do not guarantee. The generator is SplitMix64 (Steele, Lea, Flood: "Fast
/// splittable pseudorandom number generators", 2014).
class SeededRandom {
public:
  explicit SeededRandom(std::uint64_t seed) : state_(seed) {}

  /// A generator for one purpose, independent of those for other purposes.
  SeededRandom(std::uint64_t seed, std::string_view purpose, std::uint64_t number = 0)
    : SeededRandom(mix(seed ^ hash(purpose)) + number) {}

  std::uint64_t operator()() { return mix(state_ += 0x9e3779b97f4a7c15U); }

  /// Uniform below `count`, which is not 0.
  std::uint64_t below(std::uint64_t count) {
    // Rejects the numbers at the upper end that would make the result biased.
    auto too_many = (UINT64_MAX % count + 1) % count;
    std::uint64_t x = 0;
    do
      x = (*this)();
    while (x > UINT64_MAX - too_many);
    return x % count;
  }

  /// From `first` to `last`, both included.
  std::int64_t between(std::int64_t first, std::int64_t last) {
    return first + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(last - first) + 1));
  }

  template <class Range>
  const auto& one_of(const Range& x) {
    return x[static_cast<std::size_t>(below(x.size()))];
  }

private:
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }

  /// FNV-1a.
  static constexpr std::uint64_t hash(std::string_view text) {
    std::uint64_t result = 0xcbf29ce484222325U;
    for (char c : text)
      result = (result ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return result;
  }

  std::uint64_t state_;
};

} // namespace castor::faults
