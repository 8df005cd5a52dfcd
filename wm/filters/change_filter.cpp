#include "castor/wm/filters/change_filter.hpp"

#include <algorithm>

namespace castor {

ChangeFilter ChangeFilter::anywhere() const {
  auto result = *this;
  result.subarchitecture = "";
  return result;
}

ChangeFilter ChangeFilter::in(std::string name) const {
  auto result = *this;
  result.subarchitecture = std::move(name);
  return result;
}

ChangeFilter ChangeFilter::from(std::string component) const {
  auto result = *this;
  result.source = std::move(component);
  return result;
}

ChangeFilter ChangeFilter::at(const Address& address) const {
  auto result = *this;
  result.subarchitecture = address.subarchitecture;
  result.id = address.id;
  return result;
}

ChangeFilter ChangeFilter::where(const Predicate& condition) const {
  auto result = *this;
  result.predicate = predicate && condition;
  return result;
}

ChangeFilter ChangeFilter::changing_any(std::vector<std::string> names) const {
  auto result = *this;
  names.insert(names.end(), changing.begin(), changing.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  result.changing = std::move(names);
  return result;
}

ChangeFilter changes_by(Operation operation) {
  ChangeFilter result;
  result.operation = operation;
  return result;
}

bool matches_envelope(const ChangeFilter& filter, const ChangeEvent& event) {
  if (!filter.subarchitecture)
    return false;
  return (!filter.operation || *filter.operation == event.operation) &&
         (filter.id.empty() || filter.id == event.address.id) &&
         (filter.source.empty() || filter.source == event.source) &&
         (filter.subarchitecture->empty() ||
          *filter.subarchitecture == event.address.subarchitecture) &&
         (filter.type.empty() || event.type->is_a(filter.type));
}

bool matches_changes(const ChangeFilter& filter, const ChangeEvent& event) {
  if (filter.changing.empty())
    return true;
  return event.operation == Operation::overwrite &&
         std::any_of(filter.changing.begin(), filter.changing.end(), [&](const std::string& name) {
           return (event.changed & field_bit(*event.type, name)) != 0;
         });
}

bool matches(const ChangeFilter& filter, const ChangeEvent& event, const Value& content) {
  return matches_envelope(filter, event) && matches_changes(filter, event) &&
         (filter.predicate.empty() || (content.has_value() && filter.predicate.matches(content)));
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
  const char* separator = ", changing ";
  for (auto& name : x.changing) {
    result += separator + name;
    separator = " or ";
  }
  if (!x.predicate.empty())
    result += ", where " + x.predicate.text();
  return result;
}

} // namespace castor
