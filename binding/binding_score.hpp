#pragma once

#include "castor/binding/types.hpp"

#include <compare>

namespace castor::binding {

/// The score of being a union of one's own. It is sticky by as much that what says nothing for or
/// against does not bind.
inline BindingScore nil_score() {
  BindingScore result;
  result.comparable = true;
  result.sticky = 1;
  return result;
}

/// A better score is greater: comparable before all, then without a mismatch of features, without
/// one of relations, with more matches, with more matches of relations, stickier. Salience does not
/// count: it only orders equals.
std::strong_ordering compare(const BindingScore& a, const BindingScore& b);

inline bool beats(const BindingScore& a, const BindingScore& b) {
  return compare(a, b) > 0;
}

} // namespace castor::binding
