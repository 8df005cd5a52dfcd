#include "castor/wm/values/object_access.hpp"

namespace castor {

namespace {

ObjectPart without_optional(ObjectPart x) {
  while (x.data && x.operations->is_optional)
    x = x.operations->part(x.data, 0);
  return x;
}

} // namespace

ObjectPart find_part(ObjectPart object, const FieldPath& path) {
  auto result = object;
  for (auto step : path) {
    result = without_optional(result);
    if (!result.data)
      return result;
    result = result.operations->part(result.data, step);
  }
  return without_optional(result);
}

} // namespace castor
