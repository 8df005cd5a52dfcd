#include "castor/tools/cli/foxglove.hpp"

#include "castor/tools/cli/foxglove_pictures.hpp"
#include "castor/wm/values/base64.hpp"
#include "castor/wm/values/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;
using Names = std::initializer_list<const char*>;

constexpr const char* world = "world";

/// How thick flat things are shown, metres.
constexpr double thin = 0.001;

/// Longer byte fields are none of those that are looked at as JSON.
constexpr std::size_t shown_bytes = 64;

// -- shapes of records, in a value as JSON

/// The field of one of these names; null if there is none.
const Json* field(const Json& x, Names names) {
  if (x.is_object())
    for (auto* name : names)
      if (auto i = x.find(name); i != x.end())
        return &*i;
  return nullptr;
}

bool has_numbers(const Json* x, Names names) {
  return x && x->is_object() && std::ranges::all_of(names, [&](auto* name) {
           auto i = x->find(name);
           return i != x->end() && i->is_number();
         });
}

Json vector_of(const Json& x) {
  return {{"x", x["x"]}, {"y", x["y"]}, {"z", x["z"]}};
}

/// As foxglove.Pose; nothing if the record has not the shape of a pose.
std::optional<Json> pose_of(const Json& x) {
  auto* position = field(x, {"position"});
  auto* rotation = field(x, {"rotation", "orientation"});
  if (!has_numbers(position, {"x", "y", "z"}) || !has_numbers(rotation, {"x", "y", "z", "w"}))
    return std::nullopt;
  auto orientation = vector_of(*rotation);
  orientation["w"] = (*rotation)["w"];
  return Json{{"position", vector_of(*position)}, {"orientation", std::move(orientation)}};
}

struct Box {
  Json center;
  Json size;
};

std::optional<Box> box_of(const Json& x) {
  auto* center = field(x, {"centroid", "center"});
  auto* size = field(x, {"size"});
  if (!has_numbers(center, {"x", "y", "z"}) || !has_numbers(size, {"x", "y", "z"}))
    return std::nullopt;
  Box result{vector_of(*center), vector_of(*size)};
  // What lies flat on a table is a thin box; what has no size at all, or is only long, is none.
  int extended = 0;
  for (auto& side : result.size)
    if (side.get<double>() > 0)
      ++extended;
    else
      side = thin;
  return extended >= 2 ? std::optional{result} : std::nullopt;
}

bool is_camera(const Json& x) {
  auto* pose = field(x, {"pose"});
  return pose && pose_of(*pose) && has_numbers(&x, {"width", "height", "fx", "fy", "cx", "cy"});
}

/// Calls `f` with every record inside the value, itself included, and its path; not with those in
/// lists. Records inside of one for which `f` returns true are left out.
void for_each_record(const Json& x, const std::string& path,
                     const std::function<bool(const Json&, const std::string&)>& f) {
  if (!x.is_object() || f(x, path))
    return;
  for (auto& [name, inner] : x.items())
    for_each_record(inner, path + '/' + name, f);
}

// -- messages

Json moment(std::chrono::microseconds x) {
  auto seconds = std::chrono::duration_cast<std::chrono::seconds>(x);
  return {{"sec", seconds.count()},
          {"nsec", std::chrono::duration_cast<std::chrono::nanoseconds>(x - seconds).count()}};
}

/// The frame of a camera: that of its number, where it has one.
std::string camera_frame(const Json& camera, const std::string& otherwise) {
  auto* number = field(camera, {"number"});
  return number && number->is_number_integer() ? "camera " + number->dump() : otherwise;
}

/// In which frame the pictures of a value are: that of the camera in it, or of which it names the
/// number.
std::string picture_frame(const Json& value, const std::string& topic) {
  std::string result;
  for_each_record(value, {}, [&](const Json& x, const std::string&) {
    if (result.empty() && is_camera(x))
      result = camera_frame(x, topic);
    return false;
  });
  auto* number = field(value, {"camera"});
  if (result.empty() && number && number->is_number_integer())
    result = "camera " + number->dump();
  return result.empty() ? topic : result;
}

Json calibration(const Json& x, const std::string& frame, UnixTime time) {
  auto number = [&](const char* name) {
    auto* found = field(x, {name});
    return found && found->is_number() ? found->get<double>() : 0.0;
  };
  auto fx = number("fx");
  auto fy = number("fy");
  auto cx = number("cx");
  auto cy = number("cy");
  return {{"timestamp", moment(time)},
          {"frame_id", frame},
          {"width", x["width"]},
          {"height", x["height"]},
          {"distortion_model", "plumb_bob"},
          {"D", {number("k1"), number("k2"), number("t1"), number("t2"), number("k3")}},
          {"K", {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}},
          {"R", {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}},
          {"P", {fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}}};
}

Json transform(const Json& camera, const std::string& frame, UnixTime time) {
  auto pose = *pose_of(camera["pose"]);
  return {{"timestamp", moment(time)},
          {"parent_frame_id", world},
          {"child_frame_id", frame},
          {"translation", pose["position"]},
          {"rotation", pose["orientation"]}};
}

Json rgba(double r, double g, double b, double a) {
  return {{"r", r}, {"g", g}, {"b", b}, {"a", a}};
}

/// A word of the value, such as `{"label": "ball"}` or `{"label": {"value": "ball"}}`.
std::string word(const Json& value, Names names) {
  auto* x = field(value, names);
  if (x && x->is_object())
    x = field(*x, {"value"});
  return x && x->is_string() && *x != "unknown" ? x->get<std::string>() : std::string{};
}

Json colour_of(const Json& value) {
  static const std::map<std::string, std::array<double, 3>> known{
    {"red", {0.8, 0.1, 0.1}},    {"green", {0.1, 0.6, 0.2}},   {"blue", {0.1, 0.3, 0.8}},
    {"yellow", {0.9, 0.8, 0.1}}, {"orange", {0.9, 0.5, 0.1}},  {"purple", {0.5, 0.2, 0.6}},
    {"brown", {0.5, 0.3, 0.1}},  {"cyan", {0.1, 0.7, 0.8}},    {"pink", {0.9, 0.6, 0.7}},
    {"black", {0.1, 0.1, 0.1}},  {"white", {0.95, 0.95, 0.95}}};
  auto i = known.find(word(value, {"color", "colour"}));
  return i == known.end() ? rgba(0.6, 0.6, 0.6, 0.7)
                          : rgba(i->second[0], i->second[1], i->second[2], 0.7);
}

/// What can be seen of an entry in three dimensions.
struct Solid {
  std::optional<Json> pose;
  std::optional<Box> box;
};

/// The first pose and the first box of the value; cameras are shown otherwise.
Solid solid_of(const Json& value) {
  Solid result;
  for_each_record(value, {}, [&](const Json& x, const std::string&) {
    if (is_camera(x))
      return true;
    if (auto pose = pose_of(x)) {
      if (!result.pose)
        result.pose = pose;
      return true;
    }
    if (auto box = box_of(x); box && !result.box)
      result.box = box;
    return false;
  });
  return result;
}

Json entity(const Json& value, const Solid& solid, const std::string& id, UnixTime time) {
  Json result{
    {"timestamp", moment(time)},       {"frame_id", world},     {"id", id},
    {"lifetime", moment(UnixTime{0})}, {"frame_locked", false}, {"metadata", Json::array()}};
  for (auto* name :
       {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
    result[name] = Json::array();
  Json upright{{"x", 0.0}, {"y", 0.0}, {"z", 0.0}, {"w", 1.0}};
  auto colour = colour_of(value);
  Json above;
  if (solid.box) {
    result["cubes"].push_back(
      {{"pose",
        {{"position", solid.box->center},
         {"orientation", solid.pose ? (*solid.pose)["orientation"] : upright}}},
       {"size", solid.box->size},
       {"color", colour}});
    above = solid.box->center;
    above["z"] = above["z"].get<double>() + solid.box->size["z"].get<double>();
  } else {
    result["arrows"].push_back({{"pose", *solid.pose},
                                {"shaft_length", 0.08},
                                {"shaft_diameter", 0.01},
                                {"head_length", 0.02},
                                {"head_diameter", 0.02},
                                {"color", colour}});
    above = (*solid.pose)["position"];
  }
  auto text = word(value, {"label", "name"});
  if (auto x = word(value, {"color", "colour"}); text.find(x) == text.npos)
    text = text.empty() ? x : x + ' ' + text;
  result["texts"].push_back({{"pose", {{"position", above}, {"orientation", upright}}},
                             {"billboard", true},
                             {"font_size", 0.02},
                             {"scale_invariant", false},
                             {"color", rgba(0.1, 0.1, 0.1, 1)},
                             {"text", text.empty() ? id : text}});
  return result;
}

Json as_json(const Value& x) {
  JsonOptions options;
  options.max_bytes = shown_bytes;
  return Json::parse(to_json(x, options));
}

} // namespace

void FoxgloveView::add_views(std::vector<FoxgloveMessage>& to, const std::string& topic,
                             UnixTime time, const Value& value, bool repeat_pictures) {
  auto json = as_json(value);
  for_each_record(json, {}, [&](const Json& x, const std::string& path) {
    if (!is_camera(x))
      return false;
    auto frame = camera_frame(x, topic);
    to.push_back(
      {topic + path + "/transform", FoxgloveSchema::frame_transform, transform(x, frame, time)});
    to.push_back({topic + path + "/calibration", FoxgloveSchema::camera_calibration,
                  calibration(x, frame, time)});
    return true;
  });
  for (auto& x : pictures_in(value)) {
    auto picture_topic = topic + (x.path.empty() ? "/picture" : x.path);
    auto [last, is_new] = last_picture_.try_emplace(picture_topic, x.checksum);
    if (!is_new && std::exchange(last->second, x.checksum) == x.checksum && !repeat_pictures)
      continue;
    to.push_back(
      {picture_topic,
       FoxgloveSchema::compressed_image,
       {{"timestamp", moment(time)},
        {"frame_id", picture_frame(json, topic)},
        {"data", base64({reinterpret_cast<const std::uint8_t*>(x.bytes.data()), x.bytes.size()})},
        {"format", x.format}}});
  }
}

FoxgloveView::Json FoxgloveView::all_poses(const std::string& topic, UnixTime time) const {
  auto poses = Json::array();
  for (auto& [id, pose] : poses_.at(topic))
    poses.push_back(pose);
  return {{"timestamp", moment(time)}, {"frame_id", world}, {"poses", std::move(poses)}};
}

std::vector<FoxgloveMessage> FoxgloveView::change(const std::string& topic, const std::string& id,
                                                  UnixTime time, const Value& value) {
  if (!value.has_value())
    return remove(topic, id, time);
  std::vector<FoxgloveMessage> result;
  add_views(result, topic, time, value, true);
  auto json = as_json(value);
  auto solid = solid_of(json);
  if (!solid.pose && !solid.box) {
    auto removed = remove(topic, id, time);
    result.insert(result.end(), removed.begin(), removed.end());
    return result;
  }
  if (solid.pose) {
    poses_[topic][id] = *solid.pose;
    result.push_back({topic + "/poses", FoxgloveSchema::poses_in_frame, all_poses(topic, time)});
  }
  entities_[topic].insert(id);
  result.push_back(
    {topic + "/scene",
     FoxgloveSchema::scene_update,
     {{"deletions", Json::array()}, {"entities", Json::array({entity(json, solid, id, time)})}}});
  return result;
}

std::vector<FoxgloveMessage> FoxgloveView::remove(const std::string& topic, const std::string& id,
                                                  UnixTime time) {
  std::vector<FoxgloveMessage> result;
  if (auto i = poses_.find(topic); i != poses_.end() && i->second.erase(id) > 0)
    result.push_back({topic + "/poses", FoxgloveSchema::poses_in_frame, all_poses(topic, time)});
  if (auto i = entities_.find(topic); i != entities_.end() && i->second.erase(id) > 0) {
    Json deletion{{"timestamp", moment(time)}, {"type", 0}, {"id", id}};
    result.push_back(
      {topic + "/scene",
       FoxgloveSchema::scene_update,
       {{"deletions", Json::array({std::move(deletion)})}, {"entities", Json::array()}}});
  }
  return result;
}

std::vector<FoxgloveMessage> FoxgloveView::handed_out(const std::string& topic, UnixTime time,
                                                      const Value& value) {
  std::vector<FoxgloveMessage> result;
  add_views(result, topic, time, value, false);
  return result;
}

} // namespace castor::cli
