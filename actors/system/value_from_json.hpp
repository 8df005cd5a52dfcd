#pragma once

#include "castor/wm/values/value.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>

namespace castor {

/// The JSON is not a value of the type.
class ValueError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// The value that `to_json` (wm/values/json.hpp) would print as this: records are objects, lists
/// and arrays are arrays, byte fields base64 text, enumerations the names of their enumerators, and
/// null is an empty optional, or a number that JSON lacks (NaN). Every field has to be given but
/// for optionals; where there is a `base`, fields that are left out are as in it. Throws
/// ValueError, which names the path of the field, what is wrong with it and the nearest known name.
Value value_from_json(const TypeDescriptorPtr& type, const nlohmann::ordered_json& json,
                      const Value* base = nullptr);

/// An object that `value_from_json` takes, with every field: zeros, empty texts and lists, first
/// enumerators.
nlohmann::ordered_json example_of(const TypeDescriptor& type);

/// "list of Pose", "optional text", for messages and for people.
std::string type_text(const TypeDescriptor& descriptor, const WireType& type);

} // namespace castor
