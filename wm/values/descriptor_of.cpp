#include "castor/wm/values/descriptor_of.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace castor {

namespace detail {

std::pair<std::uint32_t, bool> DescriptorBuilder::begin_record(const void* key,
                                                               std::string_view name) {
  auto i = std::find(record_keys_.begin(), record_keys_.end(), key);
  auto index = static_cast<std::uint32_t>(i - record_keys_.begin());
  if (i != record_keys_.end())
    return {index, false};
  record_keys_.push_back(key);
  result_.records.push_back({std::string{name}, {}});
  return {index, true};
}

void DescriptorBuilder::set_fields(std::uint32_t record, std::vector<FieldDescriptor> fields) {
  result_.records[record].fields = std::move(fields);
}

std::uint32_t DescriptorBuilder::add_enum(const void* key, EnumDescriptor x) {
  auto i = std::find(enum_keys_.begin(), enum_keys_.end(), key);
  auto index = static_cast<std::uint32_t>(i - enum_keys_.begin());
  if (i == enum_keys_.end()) {
    enum_keys_.push_back(key);
    result_.enums.push_back(std::move(x));
  }
  return index;
}

TypeDescriptorPtr DescriptorBuilder::finish(std::vector<std::string> super_types) {
  result_.super_types = std::move(super_types);
  if (auto complaint = ambiguity(result_); !complaint.empty())
    throw std::logic_error(complaint);
  result_.hash = descriptor_hash(encode_descriptor(result_));
  // It is there as long as the process, so copies of the pointer need not be counted: every value,
  // entry and event has one, and threads would contend for the counter.
  TypeDescriptorPtr result{TypeDescriptorPtr{}, new TypeDescriptor(std::move(result_))};
  make_own_type_known(result);
  return result;
}

} // namespace detail

} // namespace castor
