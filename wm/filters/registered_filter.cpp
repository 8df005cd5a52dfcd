#include "castor/wm/filters/registered_filter.hpp"

namespace castor {

bool RegisteredFilter::matches(const ChangeEvent& event, const Value& content) {
  if (!castor::matches_envelope(filter, event) || !castor::matches_changes(filter, event))
    return false;
  if (filter.predicate.empty())
    return true;
  if (!content.has_value())
    return false;
  auto& predicate = bound.get(content.type_ptr(), [&] {
    return BoundPredicate::try_bind(filter.predicate.tree(), content.type());
  });
  return predicate && predicate->matches(content);
}

} // namespace castor
