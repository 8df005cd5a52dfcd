#include "castor/binding/binding_score.hpp"

#include <tuple>

namespace castor::binding {

std::strong_ordering compare(const BindingScore& a, const BindingScore& b) {
  const auto key = [](const BindingScore& x) {
    return std::tuple(x.comparable, !x.mismatch, !x.relation_mismatch, x.matches,
                      x.relation_matches, x.sticky);
  };
  return key(a) <=> key(b);
}

} // namespace castor::binding
