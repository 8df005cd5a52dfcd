#pragma once

#include "castor/binding/types.hpp"

#include <cstddef>
#include <limits>

/// Kleene's logic of three values, and counting in it.
namespace castor::communication {

using binding::Truth;

constexpr Truth truth_of(bool x) {
  return x ? Truth::yes : Truth::no;
}

constexpr Truth negation(Truth x) {
  return x == Truth::unknown ? x : truth_of(x == Truth::no);
}

constexpr Truth both(Truth a, Truth b) {
  if (a == Truth::no || b == Truth::no)
    return Truth::no;
  return a == Truth::yes && b == Truth::yes ? Truth::yes : Truth::unknown;
}

constexpr Truth either(Truth a, Truth b) {
  return negation(both(negation(a), negation(b)));
}

/// How many things something is true of: `certain` at least, `possible` at most.
struct Count {
  std::size_t certain = 0;
  std::size_t possible = 0;

  void add(Truth x) {
    certain += x == Truth::yes ? 1 : 0;
    possible += x != Truth::no ? 1 : 0;
  }
};

/// Numbers from `least` to `most`, both included.
struct NumberRange {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();

  friend bool operator==(const NumberRange&, const NumberRange&) = default;
};

constexpr Truth is_within(const Count& x, const NumberRange& range) {
  if (x.certain >= range.least && x.possible <= range.most)
    return Truth::yes;
  return x.possible < range.least || x.certain > range.most ? Truth::no : Truth::unknown;
}

constexpr Truth is_greater(const Count& a, const Count& b) {
  if (a.certain > b.possible)
    return Truth::yes;
  return a.possible <= b.certain ? Truth::no : Truth::unknown;
}

} // namespace castor::communication
