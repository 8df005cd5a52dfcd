#pragma once

#include "castor/wm/values/field_access.hpp"

#include <string_view>
#include <vector>

namespace castor {

/// The places of the two or three coordinates of a point: of the number fields x, y and perhaps z
/// of a record, or of the elements of an array of numbers. Throws FieldError if there is no such
/// field or it is no point.
std::vector<FieldPath> find_point(const TypeDescriptor& type, std::string_view path);

/// Whether numbers are of this kind.
bool is_number(WireKind kind);

/// A number as the nearest double; NaN for what is none.
double as_double(const FieldValue& x);

} // namespace castor
