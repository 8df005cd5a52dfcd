#include "castor/wm/change_filter.hpp"

namespace castor {

bool matches(const ChangeFilter& filter, const ChangeEvent& event) {
  if (!filter.subarchitecture)
    return false;
  return (!filter.operation || *filter.operation == event.operation) &&
         (filter.id.empty() || filter.id == event.address.id) &&
         (filter.source.empty() || filter.source == event.source) &&
         (filter.subarchitecture->empty() ||
          *filter.subarchitecture == event.address.subarchitecture) &&
         (filter.type.empty() || event.type->is_a(filter.type));
}

std::string to_string(const ChangeFilter& x) {
  std::string result = x.operation ? std::string{to_string(*x.operation)} : "any change";
  result += " of " + (x.type.empty() ? "any type" : x.type);
  if (!x.id.empty())
    result += " with id " + x.id;
  if (!x.subarchitecture)
    result += " in the own subarchitecture";
  else
    result += x.subarchitecture->empty() ? " anywhere" : " in " + *x.subarchitecture;
  if (!x.source.empty())
    result += " by " + x.source;
  return result;
}

} // namespace castor
