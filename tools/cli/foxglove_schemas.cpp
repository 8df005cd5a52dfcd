#include "castor/tools/cli/foxglove_schemas.hpp"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <utility>

// The fields are those of the npm package @foxglove/schemas 2.1, with which a test compares what is
// written.
namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

Json object(const std::string& title, std::initializer_list<std::pair<const char*, Json>> fields) {
  Json properties = Json::object();
  Json required = Json::array();
  for (auto& [name, type] : fields) {
    properties[name] = type;
    required.push_back(name);
  }
  return {{"title", title},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)}};
}

Json list(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json numbers(int count) {
  Json result = list({{"type", "number"}});
  result["minItems"] = result["maxItems"] = count;
  return result;
}

const Json text{{"type", "string"}};
const Json number{{"type", "number"}};
const Json integer{{"type", "integer"}};
const Json truth{{"type", "boolean"}};
const Json base64_bytes{{"type", "string"}, {"contentEncoding", "base64"}};
const Json anything{{"type", "object"}};

Json moment(const char* title) {
  return object(title, {{"sec", integer}, {"nsec", integer}});
}

Json vector() {
  return object("foxglove.Vector3", {{"x", number}, {"y", number}, {"z", number}});
}

Json quaternion() {
  return object("foxglove.Quaternion",
                {{"x", number}, {"y", number}, {"z", number}, {"w", number}});
}

Json pose() {
  return object("foxglove.Pose", {{"position", vector()}, {"orientation", quaternion()}});
}

Json colour() {
  return object("foxglove.Color", {{"r", number}, {"g", number}, {"b", number}, {"a", number}});
}

Json entity() {
  auto cube =
    object("foxglove.CubePrimitive", {{"pose", pose()}, {"size", vector()}, {"color", colour()}});
  auto arrow = object("foxglove.ArrowPrimitive", {{"pose", pose()},
                                                  {"shaft_length", number},
                                                  {"shaft_diameter", number},
                                                  {"head_length", number},
                                                  {"head_diameter", number},
                                                  {"color", colour()}});
  auto label = object("foxglove.TextPrimitive", {{"pose", pose()},
                                                 {"billboard", truth},
                                                 {"font_size", number},
                                                 {"scale_invariant", truth},
                                                 {"color", colour()},
                                                 {"text", text}});
  auto pair = object("foxglove.KeyValuePair", {{"key", text}, {"value", text}});
  return object("foxglove.SceneEntity", {{"timestamp", moment("time")},
                                         {"frame_id", text},
                                         {"id", text},
                                         {"lifetime", moment("duration")},
                                         {"frame_locked", truth},
                                         {"metadata", list(pair)},
                                         {"arrows", list(arrow)},
                                         {"cubes", list(cube)},
                                         {"spheres", list(anything)},
                                         {"cylinders", list(anything)},
                                         {"lines", list(anything)},
                                         {"triangles", list(anything)},
                                         {"texts", list(label)},
                                         {"models", list(anything)}});
}

Json schema(FoxgloveSchema x) {
  auto name = name_of(x);
  auto time = moment("time");
  switch (x) {
    case FoxgloveSchema::compressed_image:
      return object(
        name, {{"timestamp", time}, {"frame_id", text}, {"data", base64_bytes}, {"format", text}});
    case FoxgloveSchema::camera_calibration:
      return object(name, {{"timestamp", time},
                           {"frame_id", text},
                           {"width", integer},
                           {"height", integer},
                           {"distortion_model", text},
                           {"D", list(number)},
                           {"K", numbers(9)},
                           {"R", numbers(9)},
                           {"P", numbers(12)}});
    case FoxgloveSchema::frame_transform:
      return object(name, {{"timestamp", time},
                           {"parent_frame_id", text},
                           {"child_frame_id", text},
                           {"translation", vector()},
                           {"rotation", quaternion()}});
    case FoxgloveSchema::poses_in_frame:
      return object(name, {{"timestamp", time}, {"frame_id", text}, {"poses", list(pose())}});
    case FoxgloveSchema::scene_update: {
      auto deletion = object("foxglove.SceneEntityDeletion",
                             {{"timestamp", time}, {"type", integer}, {"id", text}});
      return object(name, {{"deletions", list(deletion)}, {"entities", list(entity())}});
    }
  }
  return {};
}

} // namespace

std::string name_of(FoxgloveSchema x) {
  switch (x) {
    case FoxgloveSchema::compressed_image:
      return "foxglove.CompressedImage";
    case FoxgloveSchema::camera_calibration:
      return "foxglove.CameraCalibration";
    case FoxgloveSchema::frame_transform:
      return "foxglove.FrameTransform";
    case FoxgloveSchema::poses_in_frame:
      return "foxglove.PosesInFrame";
    case FoxgloveSchema::scene_update:
      return "foxglove.SceneUpdate";
  }
  return {};
}

std::string text_of(FoxgloveSchema x) {
  return schema(x).dump();
}

} // namespace castor::cli
