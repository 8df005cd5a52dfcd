#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// What values of the type look like as JSON (wm/values/json.hpp), in the language of JSON Schema.
nlohmann::ordered_json json_schema(const TypeDescriptor& type);

} // namespace castor::cli
