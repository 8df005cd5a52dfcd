#include "castor/wm/values/field_mask.hpp"

namespace castor {

FieldMask field_bit(const TypeDescriptor& type, std::string_view name) {
  auto& fields = type.records.front().fields;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == name)
      return field_bit(i);
  return 0;
}

FieldMask all_fields(const TypeDescriptor& type) {
  auto count = type.records.front().fields.size();
  return count < 64 ? (FieldMask{1} << count) - 1 : ~FieldMask{0};
}

std::vector<std::string> field_names(const TypeDescriptor& type, FieldMask fields) {
  std::vector<std::string> result;
  auto& all = type.records.front().fields;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (fields & field_bit(i))
      result.push_back(all[i].name);
  return result;
}

} // namespace castor
