#pragma once

#include "castor/binding/types.hpp"

#include <compare>

namespace castor::binding {

/// The score of NIL, a union of its own. Its `sticky` of 1 prevents binding to a union without
/// evidence for or against it.
inline BindingScore nil_score() {
  BindingScore result;
  result.comparable = true;
  result.sticky = 1;
  return result;
}

/// A better score is greater. Criteria in this order: comparable, no mismatch of features, no
/// mismatch of relations, more matches, more matches of relations, stickier. Salience is ignored:
/// it only orders equal scores.
std::strong_ordering compare(const BindingScore& a, const BindingScore& b);

inline bool beats(const BindingScore& a, const BindingScore& b) {
  return compare(a, b) > 0;
}

} // namespace castor::binding
