#include "castor/wm/values/point_field.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

namespace castor {

namespace {

FieldPath extended(FieldPath path, std::size_t step) {
  path.push_back(static_cast<std::uint32_t>(step));
  return path;
}

std::optional<FieldPath> coordinate(const RecordDescriptor& record, std::string_view name,
                                    const FieldPath& path) {
  auto& fields = record.fields;
  auto i = std::find_if(fields.begin(), fields.end(), [&](const FieldDescriptor& x) {
    return x.name == name && is_number(x.type.kind);
  });
  if (i == fields.end())
    return std::nullopt;
  return extended(path, static_cast<std::size_t>(i - fields.begin()));
}

std::vector<FieldPath> coordinates(const TypeDescriptor& type, const FieldPlace& place) {
  std::vector<FieldPath> result;
  if (place.type->kind == WireKind::record) {
    auto& record = type.records.at(place.type->index);
    auto x = coordinate(record, "x", place.path);
    auto y = coordinate(record, "y", place.path);
    if (!x || !y)
      return result;
    result = {*x, *y};
    if (auto z = coordinate(record, "z", place.path))
      result.push_back(*z);
  } else if (place.type->kind == WireKind::array) {
    auto extent = place.type->extent;
    if (is_number(place.type->element.front().kind) && (extent == 2 || extent == 3))
      for (std::size_t i = 0; i < extent; ++i)
        result.push_back(extended(place.path, i));
  }
  return result;
}

} // namespace

std::vector<FieldPath> find_point(const TypeDescriptor& type, std::string_view path) {
  auto result = coordinates(type, find_field(type, path));
  if (result.empty())
    throw FieldError(std::string{path} + " of " + type.name() +
                     " is no point: that is a record with the numbers x, y and perhaps z, or an "
                     "array of two or three numbers");
  return result;
}

bool is_number(WireKind kind) {
  return kind >= WireKind::int8 && kind <= WireKind::float64;
}

double as_double(const FieldValue& x) {
  return std::visit(
    [](const auto& v) {
      using T = std::decay_t<decltype(v)>;
      if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
        return static_cast<double>(v);
      else
        return std::numeric_limits<double>::quiet_NaN();
    },
    x);
}

} // namespace castor
