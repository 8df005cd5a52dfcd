#include "castor/tools/cli/mcap_export.hpp"

#include "castor/actors/system/inspection_json.hpp"
#include "castor/base/duration.hpp"
#include "castor/tools/cli/json_schema.hpp"
#include "castor/tools/cli/recorded_change.hpp"
#include "castor/wm/values/json.hpp"

#include <nlohmann/json.hpp>

#include <limits>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr auto of_subarchitecture = "subarchitecture";
constexpr auto of_component = "component";

/// Of values that are handed out, byte fields up to this length are told; pictures have topics of
/// their own.
constexpr std::size_t told_bytes = 64;

/// Of the messages about changes.
Json change_schema(const TypeDescriptor& type) {
  Json text{{"type", "string"}};
  return {{"type", "object"},
          {"title", type.name()},
          {"properties",
           {{"time", {{"type", "number"}}},
            {"subarchitecture", text},
            {"operation", text},
            {"type", text},
            {"id", text},
            {"version", {{"type", "integer"}}},
            {"component", text},
            {"changed", {{"type", "array"}, {"items", text}}},
            {"coalesced", {{"type", "boolean"}}},
            {"value", json_schema(type)}}}};
}

/// Of the messages about values that were handed out.
Json value_schema(const TypeDescriptor& type) {
  Json text{{"type", "string"}};
  return {{"type", "object"},
          {"title", type.name()},
          {"properties",
           {{"time", {{"type", "number"}}},
            {"component", text},
            {"pushed", {{"type", "boolean"}}},
            {"type", text},
            {"value", json_schema(type)}}}};
}

/// Byte fields that are shown as {"bytes": how many} become empty texts, as the schema wants it.
void empty_long_bytes(Json& x) {
  if (x.is_object() && x.size() == 1 && x.contains("bytes") && x["bytes"].is_number()) {
    x = "";
    return;
  }
  for (auto& inner : x)
    if (inner.is_structured())
      empty_long_bytes(inner);
}

} // namespace

std::string message_of(const std::string& subarchitecture, const JournalRecord& x) {
  auto event = event_of(x, subarchitecture, {});
  return change_as_json(event, x.value, std::numeric_limits<std::size_t>::max());
}

McapExport::Channel& McapExport::channel(const std::string& topic, const std::string& schema_name,
                                         const std::function<std::string()>& schema,
                                         const std::string& metadata_key, const std::string& from) {
  auto [known, is_new_schema] = schemas_.try_emplace(schema_name);
  if (is_new_schema)
    // What distinguishes schemas of one name is not for people.
    known->second = writer_.add_schema(schema_name.substr(0, schema_name.find(' ')), schema());
  auto [result, is_new] = channels_.try_emplace({topic, known->second});
  if (is_new)
    result->second.id = writer_.add_channel(known->second, topic, {{metadata_key, from}});
  return result->second;
}

void McapExport::add(const std::string& subarchitecture, const JournalRecord& x) {
  auto& type = *x.type;
  auto topic = '/' + subarchitecture + '/' + type.name();
  auto& to = channel(
    topic, type.name() + ' ' + std::to_string(type.hash),
    [&] { return change_schema(type).dump(); }, of_subarchitecture, subarchitecture);
  writer_.add_message(to.id, static_cast<std::uint32_t>(x.sequence), x.time,
                      message_of(subarchitecture, x));
  add_views(view_.change(topic, x.id, x.time, x.value), x.time, of_subarchitecture,
            subarchitecture);
}

void McapExport::add(const std::string& provider, const RecordedPush& x) {
  auto& type = x.value.type();
  auto topic = '/' + provider + '/' + type.name();
  auto& to = channel(
    topic, type.name() + " handed out " + std::to_string(type.hash),
    [&] { return value_schema(type).dump(); }, of_component, provider);
  JsonOptions options;
  options.max_bytes = told_bytes;
  auto value = Json::parse(to_json(x.value, options));
  empty_long_bytes(value);
  Json message{{"time", in_seconds(x.time)},
               {"component", provider},
               {"pushed", x.pushed},
               {"type", type.name()},
               {"value", std::move(value)}};
  writer_.add_message(to.id, ++to.messages, x.time,
                      message.dump(-1, ' ', false, Json::error_handler_t::replace));
  add_views(view_.handed_out(topic, x.time, x.value), x.time, of_component, provider);
}

void McapExport::add_views(const std::vector<FoxgloveMessage>& messages, UnixTime time,
                           const std::string& metadata_key, const std::string& from) {
  for (auto& x : messages) {
    auto& to = channel(
      x.topic, name_of(x.schema), [&] { return text_of(x.schema); }, metadata_key, from);
    writer_.add_message(to.id, ++to.messages, time,
                        x.content.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

} // namespace castor::cli
