#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// JSON Schema of the JSON form of a type's values (wm/values/json.hpp).
nlohmann::ordered_json json_schema(const TypeDescriptor& type);

} // namespace castor::cli
