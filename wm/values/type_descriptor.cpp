#include "castor/wm/values/type_descriptor.hpp"

#include <algorithm>
#include <cstdio>
#include <unordered_map>
#include <unordered_set>

namespace castor {

namespace {

std::string to_string(const TypeDescriptor& descriptor, const WireType& type) {
  switch (type.kind) {
    case WireKind::record:
      return descriptor.records.at(type.index).name;
    case WireKind::enumeration:
      return descriptor.enums.at(type.index).name;
    case WireKind::list:
      return "list of " + to_string(descriptor, type.element.front());
    case WireKind::array:
      return std::to_string(type.extent) + " of " + to_string(descriptor, type.element.front());
    case WireKind::optional:
      return "optional " + to_string(descriptor, type.element.front());
    default:
      return std::string{
        reflection_of<WireKind>().enumerators[static_cast<std::size_t>(type.kind)].first};
  }
}

} // namespace

bool TypeDescriptor::is_a(std::string_view other) const {
  return name() == other ||
         std::find(super_types.begin(), super_types.end(), other) != super_types.end();
}

std::string to_string(const TypeDescriptor& x) {
  std::string result = x.name() + " {";
  const char* separator = "";
  for (auto& field : x.records.front().fields) {
    result += separator + field.name + ": " + to_string(x, field.type);
    separator = ", ";
  }
  char hash[24];
  std::snprintf(hash, sizeof(hash), "} #%016llx", static_cast<unsigned long long>(x.hash));
  return result + hash;
}

std::string ambiguity(const TypeDescriptor& descriptor) {
  std::unordered_map<std::string_view, const RecordDescriptor*> types;
  for (auto& record : descriptor.records) {
    // Those of a template may be the same for all its arguments, as those of EntryPointer are.
    auto [known, is_new] = types.try_emplace(record.name, &record);
    if (!is_new && !(*known->second == record))
      return "two different types named " + record.name + " inside " + descriptor.name();
    std::unordered_set<std::string_view> fields;
    for (auto& field : record.fields)
      if (!fields.insert(field.name).second)
        return "two fields named " + field.name + " in " + record.name + " or its bases";
  }
  for (auto& e : descriptor.enums)
    if (!types.try_emplace(e.name, nullptr).second)
      return "two different types named " + e.name + " inside " + descriptor.name();
  std::unordered_set<std::string_view> ancestry{descriptor.name()};
  for (auto& name : descriptor.super_types)
    if (!ancestry.insert(name).second)
      return "two types named " + name + " among " + descriptor.name() + " and its bases";
  return {};
}

} // namespace castor
