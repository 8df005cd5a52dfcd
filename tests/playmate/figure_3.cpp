#include "castor/tests/playmate/figure_3.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;

/// "vision/object/1:3" is what stands for the one object there is, whatever its number.
std::string without_numbers(const std::string& id) {
  for (std::string_view stem : {"vision/object", "vision/location", "vision/position",
                                "spatial/location", "spatial/desired", "communication"})
    if (id.starts_with(stem))
      return std::string{stem};
  return id;
}

std::string list(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  std::string result;
  for (auto& x : words)
    result += (result.empty() ? "" : ", ") + x;
  return '{' + result + '}';
}

std::string feature(const json& x) {
  auto kind = x["kind"].get<std::string>();
  if (kind == "location")
    return x["numbers"].size() == 3 ? kind : kind + " that is none";
  if (kind == "source_data")
    return "tether to " + x["data"]["address"]["subarchitecture"].get<std::string>() + ' ' +
           x["data"]["type"].get<std::string>();
  return (x["negated"].get<bool>() ? "not " : "") + kind + ' ' +
         without_numbers(x["text"].get<std::string>());
}

std::string features(const json& all) {
  std::vector<std::string> result;
  for (auto& x : all)
    result.push_back(feature(x));
  return list(std::move(result));
}

std::string ports(const json& all) {
  std::vector<std::string> result;
  for (auto& x : all)
    result.push_back(x["label"].get<std::string>() + ' ' + without_numbers(x["proxy"]));
  return list(std::move(result));
}

std::string proxies(const json& all) {
  std::vector<std::string> result;
  for (auto& x : all)
    result.push_back(without_numbers(x));
  return list(std::move(result));
}

std::string nominals(const json& all) {
  std::vector<std::string> result;
  for (auto& x : all)
    result.push_back(x["name"].get<std::string>() + ':' + x["sort"].get<std::string>() + ' ' +
                     x["proposition"].get<std::string>());
  return list(std::move(result));
}

std::string values(const json& all, const char* name) {
  std::vector<std::string> result;
  for (auto& x : all)
    result.push_back(x[name]);
  return list(std::move(result));
}

std::size_t relations(const json& scene) {
  std::size_t result = 0;
  for (auto* name : {"near", "front", "back", "left", "right"})
    result += scene[name].size();
  return result;
}

std::string content_of(const std::string& type, const json& x) {
  auto text = [&x](const char* name) { return x[name].get<std::string>(); };
  auto number = [](std::size_t n) { return std::to_string(n); };
  if (type == "SceneChanged")
    return json{
      {"changing", x["changing"]}, {"changed", x["changed"]}, {"processed", x["processed"]}}
      .dump();
  if (type == "Camera")
    return "number " + x["number"].dump();
  if (type == "SceneObject")
    return "colour " + x["colour"]["value"].get<std::string>() + ", shape " +
           x["shape"]["value"].get<std::string>() + ", " + number(x["roi_ids"].size()) + " ROI";
  if (type == "ROI")
    return std::string{x["has_features"].get<bool>() ? "with" : "without"} + " features";
  if (type == "LearnedWords")
    return values(x["words"], "word");
  if (type == "SpatialLocation")
    return "of " + x["object"]["address"]["subarchitecture"].get<std::string>();
  if (type == "SpatialScene")
    return number(x["locations"].size()) + " locations, " + number(relations(x)) + " relations, " +
           number(x["active_components"].size()) + " active";
  if (type == "RelationFinder")
    return text("relation");
  if (type == "BindingProxy")
    return text("state") + ' ' + text("type") + " from " + text("source") + ", " +
           features(x["features"]) + ", out " + ports(x["out_ports"]) + ", in union with " +
           proxies(x["proxy_ids"]);
  if (type == "BindingUnion")
    return text("type") + ' ' + proxies(x["proxy_ids"]) + ", out " + ports(x["out_ports"]) +
           ", in " + ports(x["in_ports"]);
  if (type == "BinderStatus")
    return std::string{x["stable"].get<bool>() ? "stable" : "unstable"} + ", " +
           x["proxies"].dump() + " proxies, " + x["unions"].dump() + " unions";
  if (type == "PhonString")
    return '"' + text("word_sequence") + "\", length " + x["length"].dump();
  if (type == "PackedLogicalForm")
    return text("state") + " at " + x["string_position"].dump() + ", " +
           number(x["readings"].size()) + " reading";
  if (type == "DialogueMove")
    return text("type") + ' ' + nominals(x["content"]["nominals"]);
  if (type == "DialogueStructure")
    return values(x["turns"], "speaker");
  if (type == "MoveReferents")
    return values(x["referents"], "proposition");
  if (type == "SpokenOutputItem")
    return '"' + text("text") + '"';
  return {};
}

} // namespace

std::string figure_3_line(const std::string& subarchitecture, const std::string& type,
                          const json& content) {
  auto result = content_of(type, content);
  return result.empty() ? result : subarchitecture + ' ' + type + ' ' + result;
}

std::set<std::string> figure_3_entries() {
  return {
    // t = 0 and 1
    R"(vision SceneChanged {"changed":true,"changing":false,"processed":true})",
    "vision Camera number 0",
    "vision SceneObject colour unknown, shape unknown, 1 ROI",
    "vision ROI with features",
    // t = 2
    "spatial SpatialLocation of vision",
    "spatial SpatialScene 1 locations, 0 relations, 0 active",
    "spatial RelationFinder near",
    "spatial RelationFinder left",
    "spatial RelationFinder right",
    "spatial RelationFinder front",
    "spatial RelationFinder back",
    "binding BindingProxy bound basic from vision, {concept_name thing, not other_source_id "
    "vision, "
    "temporal_frame perceived, tether to vision SceneObject, this_proxy_id vision/object}, out {}, "
    "in union with {communication, vision/object}",
    "binding BindingProxy bound basic from vision, {location, not other_source_id vision, "
    "temporal_frame perceived, tether to vision SceneObject, this_proxy_id vision/location}, out "
    "{}, in union with {spatial/location, vision/location}",
    "binding BindingProxy bound relation from vision, {not other_source_id vision, relation_label "
    "pos, temporal_frame perceived}, out {from vision/location, to vision/object}, in union with "
    "{vision/position}",
    // t = 3
    "binding BindingProxy bound basic from spatial, {location, not other_source_id spatial, "
    "temporal_frame perceived, tether to spatial SpatialLocation, this_proxy_id spatial/location}, "
    "out {}, in union with {spatial/location, vision/location}",
    "binding BindingProxy bound basic from spatial, {location, not other_source_id spatial, "
    "temporal_frame desired, tether to spatial SpatialLocation, this_proxy_id spatial/desired}, "
    "out {}, in union with {spatial/desired}",
    R"(communication PhonString "This is a blue square.", length 5)",
    "communication PackedLogicalForm pruned at 5, 1 reading",
    "communication DialogueMove assertion {w1:thing this, w2:ascription be, w4:colour blue, "
    "w5:thing square}",
    "communication MoveReferents {this}",
    // t = 4
    "binding BindingProxy bound basic from communication, {colour blue, concept_name thing, shape "
    "square, tether to communication DialogueMove, this_proxy_id communication}, out {}, in union "
    "with {communication, vision/object}",
    "binding BindingUnion basic {communication, vision/object}, out {}, in {to vision/object}",
    "binding BindingUnion basic {spatial/location, vision/location}, out {}, in {from "
    "vision/location}",
    "binding BindingUnion relation {vision/position}, out {from vision/location, to "
    "vision/object}, in {}",
    "binding BindingUnion basic {spatial/desired}, out {}, in {}",
    "binding BinderStatus stable, 6 proxies, 4 unions",
    "communication DialogueStructure {human, robot}",
    R"(communication SpokenOutputItem "Ok.")",
    // and what vision makes of it
    "vision LearnedWords {blue, square}",
  };
}

} // namespace castor::test
