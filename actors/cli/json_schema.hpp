#pragma once

#include "castor/wm/type_descriptor.hpp"

#include <nlohmann/json.hpp>

namespace castor::cli {

/// What values of the type look like as JSON (wm/json.hpp), in the language of JSON Schema.
nlohmann::ordered_json json_schema(const TypeDescriptor& type);

} // namespace castor::cli
