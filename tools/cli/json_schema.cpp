#include "castor/tools/cli/json_schema.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

class Schema {
public:
  explicit Schema(const TypeDescriptor& type) : type_(type) {}

  Json record(std::uint32_t index) {
    Json result{{"type", "object"}};
    // Viewers follow no references, so a type that contains itself is told of once.
    if (!within_.insert(index).second)
      return result;
    auto& record = type_.records.at(index);
    result["title"] = record.name;
    auto& properties = result["properties"] = Json::object();
    for (auto& field : record.fields)
      properties[field.name] = value(field.type);
    within_.erase(index);
    return result;
  }

private:
  Json value(const WireType& x) {
    switch (x.kind) {
      case WireKind::boolean:
        return {{"type", "boolean"}};
      case WireKind::float32:
      case WireKind::float64:
        return {{"type", "number"}};
      case WireKind::string:
      case WireKind::enumeration:
        return {{"type", "string"}};
      case WireKind::bytes:
        return {{"type", "string"}, {"contentEncoding", "base64"}};
      case WireKind::list:
      case WireKind::array:
        return {{"type", "array"}, {"items", value(x.element.front())}};
      case WireKind::optional:
        return value(x.element.front());
      case WireKind::record:
        return record(x.index);
      default:
        return {{"type", "integer"}};
    }
  }

  const TypeDescriptor& type_;
  std::set<std::uint32_t> within_;
};

} // namespace

Json json_schema(const TypeDescriptor& type) {
  return Schema{type}.record(0);
}

} // namespace castor::cli
