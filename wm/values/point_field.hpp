#pragma once

#include "castor/wm/values/field_access.hpp"

#include <string_view>
#include <vector>

namespace castor {

/// Places of the two or three coordinates of a point: the number fields x, y and perhaps z of a
/// record, or the elements of an array of numbers. Throws FieldError if there is no such field or
/// it is not a point.
std::vector<FieldPath> find_point(const TypeDescriptor& type, std::string_view path);

/// Whether a kind is a number.
bool is_number(WireKind kind);

/// A number as the nearest double; NaN for other values.
double as_double(const FieldValue& x);

} // namespace castor
