#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/entry.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// The version of an entry that a component last read or wrote.
struct SeenVersion {
  Version version = 0;
  /// Whether it is the version after writes that were sent and not answered yet, if they succeed.
  bool expected = false;
};

/// Versions of entries in 24 bytes each: a hash table with open addressing and linear probing, that
/// has fingerprints of 127 bits for the addresses. Two of a billion addresses have the same one
/// with a probability of 10^-20.
class VersionTable {
public:
  /// Hashes of an address; never 0.
  struct Fingerprint {
    std::uint64_t first = 0;
    std::uint64_t second = 0;

    explicit operator bool() const { return second != 0; }
    friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
  };

  static Fingerprint fingerprint(const Address& x) {
    auto second = fnv1a(x.id, fnv1a(x.subarchitecture, 0xcbf29ce484222325));
    return {std::hash<Address>{}(x), second | 1};
  }

  std::size_t size() const { return size_; }

  void set(const Fingerprint& key, SeenVersion x) {
    if ((size_ + 1) * 8 > slots_.size() * 7)
      grow();
    auto& slot = slots_[place_of(key)];
    if (!slot.key)
      ++size_;
    slot = {key, x.version, x.expected};
  }

  std::optional<SeenVersion> find(const Fingerprint& key) const {
    if (size_ == 0)
      return std::nullopt;
    auto& slot = slots_[place_of(key)];
    return slot.key ? std::optional{SeenVersion{slot.version, slot.expected}} : std::nullopt;
  }

  void erase(const Fingerprint& key) {
    if (size_ == 0)
      return;
    auto hole = place_of(key);
    if (!slots_[hole].key)
      return;
    --size_;
    // Those behind it are found from their first place on, up to the next empty one.
    for (auto i = next(hole); slots_[i].key; i = next(i))
      if (distance(home_of(slots_[i].key), i) >= distance(hole, i)) {
        slots_[hole] = slots_[i];
        hole = i;
      }
    slots_[hole] = {};
  }

  void clear() { *this = {}; }

private:
  struct Slot {
    Fingerprint key;
    std::uint64_t version : 63 = 0;
    bool expected : 1 = false;

    Slot() = default;
    Slot(const Fingerprint& k, Version v, bool e)
      : key(k), version(v & (~std::uint64_t{0} >> 1)), expected(e) {}
  };

  static std::uint64_t fnv1a(std::string_view text, std::uint64_t hash) {
    for (unsigned char x : text)
      hash = (hash ^ x) * 0x100000001b3;
    // An end of the text, so that "ab" and "c" differ from "a" and "bc".
    return (hash ^ 0xff) * 0x100000001b3;
  }

  std::size_t home_of(const Fingerprint& key) const {
    // The high bits of the product depend on all of the key's.
    auto mixed = (key.first ^ key.second) * 0x9e3779b97f4a7c15;
    return (mixed >> 32) & (slots_.size() - 1);
  }
  std::size_t next(std::size_t i) const { return (i + 1) & (slots_.size() - 1); }
  std::size_t distance(std::size_t from, std::size_t to) const {
    return (to - from) & (slots_.size() - 1);
  }

  /// The slot of the key, or the empty one where it would be.
  std::size_t place_of(const Fingerprint& key) const {
    auto i = home_of(key);
    while (slots_[i].key && slots_[i].key != key)
      i = next(i);
    return i;
  }

  void grow() {
    auto old = std::exchange(slots_, {});
    slots_.resize(old.empty() ? 16 : 2 * old.size());
    for (auto& x : old)
      if (x.key)
        slots_[place_of(x.key)] = x;
  }

  /// A power of two of them, or none.
  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

} // namespace castor
