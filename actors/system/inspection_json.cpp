#include "castor/actors/system/inspection_json.hpp"

#include "castor/actors/link/dial.hpp"
#include "castor/actors/system/value_from_json.hpp"
#include "castor/base/duration.hpp"
#include "castor/wm/values/json.hpp"

#include <unistd.h>

#include <filesystem>

namespace castor {

namespace {

const char* name_of(LinkState x) {
  switch (x) {
    case LinkState::up:
      return "up";
    case LinkState::down:
      return "down";
    case LinkState::lost:
      return "lost";
  }
  return "";
}

/// As all else that names a process does.
std::string name_of(const SystemRoster& roster, ProcessNumber x) {
  if (x == 0)
    return "localhost";
  return x < roster.processes.size() ? roster.processes[x].name : std::string{};
}

Json to_json(const LinkStatus& x, const SystemRoster& roster) {
  return {{"to", name_of(roster, x.news.peer)},
          {"state", name_of(x.news.state)},
          {"reason", x.news.reason},
          {"messages_out", x.messages_out},
          {"messages_in", x.messages_in},
          {"bytes_out", x.bytes_out},
          {"bytes_in", x.bytes_in},
          {"events_out", x.events_out},
          {"events_in", x.events_in},
          {"connections", x.connections},
          {"unacknowledged", x.unacknowledged}};
}

Json node_as_json(const SystemReport& report, const SystemRoster& roster, std::size_t number) {
  auto& x = roster.processes[number];
  auto* link = find_link(report.parts, 0, static_cast<ProcessNumber>(number));
  Json result{{"name", name_of(roster, static_cast<ProcessNumber>(number))},
              {"address", number == 0 ? "" : to_string(Endpoint{x.host, x.port})},
              {"state", link ? name_of(link->news.state) : "up"},
              {"reason", link ? link->news.reason : ""}};
  auto& part = report.parts[number];
  if (!part)
    return result;
  result["components"] = part->components.size();
  result["cpu"] = in_seconds(part->usage.cpu);
  result["age"] = in_seconds(part->usage.age);
  result["memory"] = part->usage.memory_bytes;
  result["links"] = Json::array();
  for (auto& y : part->links)
    result["links"].push_back(to_json(y, roster));
  return result;
}

Json to_json(const ComponentStatus& x, const std::string& node) {
  return {{"name", x.identity.name},
          {"subarchitecture", x.identity.subarchitecture},
          {"class", x.identity.class_name},
          {"node", node},
          {"state", state_of(x)},
          {"failure", x.failure},
          {"incarnation", x.identity.incarnation},
          {"restarts", x.restarts},
          {"busy", in_seconds(x.busy)},
          {"cpu", in_seconds(x.cpu)},
          {"events", x.events_received},
          {"rejected", x.events_rejected},
          {"callbacks", x.callbacks},
          {"writes", x.writes},
          {"reads", x.reads},
          {"pushes_dropped", x.pushes_dropped},
          {"obeys", x.obeys}};
}

Json to_json(const JournalStatus& x) {
  Json result{{"mode", to_string(x.mode)}};
  if (x.mode == JournalMode::off)
    return result;
  for (auto& [name, number] :
       {std::pair{"bytes", x.bytes}, std::pair{"unsynced", x.unsynced}, std::pair{"held", x.held},
        std::pair{"syncs", x.syncs}, std::pair{"incarnation", x.incarnation}})
    result[name] = number;
  if (!x.failure.empty())
    result["failure"] = x.failure;
  return result;
}

Json to_json(const WorkingMemoryStatus& x, const std::string& node) {
  return {{"subarchitecture", x.subarchitecture},
          {"node", node},
          {"entries", x.entries},
          {"entries_by_type", x.entries_by_type},
          {"filters", x.filters},
          {"leases", x.leases},
          {"waiting", x.waiting},
          {"events", x.events},
          {"matched", x.matched},
          {"delivered", x.delivered},
          {"coalesced", x.coalesced},
          {"suppressed", x.suppressed},
          {"backlog", x.backlog},
          {"forwarded", x.forwarded},
          {"routed", x.routed},
          {"refused", x.refused},
          {"journal", to_json(x.journal)}};
}

/// The object with one member more, which is JSON already.
std::string with_value(const Json& object, const std::string& value) {
  auto result = to_text(object);
  result.pop_back();
  return result + ",\"value\":" + value + "}";
}

} // namespace

Json to_json(const SystemReport& report, const SystemRoster& roster) {
  Json result{{"system", std::filesystem::path{roster.file}.stem().string()},
              {"file", roster.file},
              {"process", getpid()},
              {"age", in_seconds(std::chrono::steady_clock::now() - roster.epoch)}};
  auto node_of = [&](const std::string& component) {
    return name_of(roster, process_of(roster.placement, component));
  };
  auto& nodes = result["nodes"] = Json::array();
  for (std::size_t i = 0; i < roster.processes.size(); ++i)
    // Some were only tried.
    if (i == 0 || !roster.processes[i].host.empty())
      nodes.push_back(node_as_json(report, roster, i));
  auto& components = result["components"] = Json::array();
  for (auto& x : component_statuses(roster, report.parts))
    components.push_back(to_json(x, node_of(x.identity.name)));
  auto& working_memories = result["working_memories"] = Json::array();
  for (auto& x : report.working_memories)
    working_memories.push_back(to_json(x, node_of(working_memory_of(x.subarchitecture))));
  return result;
}

Json to_json(const SystemSummary& summary, const SystemRoster& roster) {
  auto node_of = [&](const std::string& component) {
    return name_of(roster, process_of(roster.placement, component));
  };
  Json result{{"components", Json::array()},
              {"working_memories", Json::array()},
              {"processes", Json::array()}};
  for (auto& x : summary.components)
    result["components"].push_back(to_json(x, node_of(x.identity.name)));
  for (auto& x : summary.working_memories)
    result["working_memories"].push_back(to_json(x, node_of(working_memory_of(x.subarchitecture))));
  for (auto& x : summary.processes) {
    auto& name = x.description.name;
    auto links = Json::array();
    for (auto& link : x.links)
      links.push_back(to_json(link, roster));
    result["processes"].push_back({{"name", name.empty() ? "localhost" : name},
                                   {"cpu", in_seconds(x.usage.cpu)},
                                   {"memory", x.usage.memory_bytes},
                                   {"links", std::move(links)}});
  }
  return result;
}

Json to_json(const Usage& x) {
  return {{"component", x.component},
          {"subarchitecture", x.subarchitecture},
          {"type", x.type},
          {"adds", x.adds},
          {"overwrites", x.overwrites},
          {"deletes", x.deletes},
          {"reads", x.reads},
          {"events", x.events}};
}

Json to_json(const ChangeEvent& x) {
  return {{"time", in_seconds(x.time)},
          {"subarchitecture", x.address.subarchitecture},
          {"operation", to_string(x.operation)},
          {"type", x.type_name()},
          {"id", x.address.id},
          {"version", x.version},
          {"component", x.source},
          {"changed", x.changed_fields()},
          {"coalesced", x.coalesced}};
}

Json to_json(const TaskEvent& x) {
  return {{"time", in_seconds(x.time)},
          {"subarchitecture", x.subarchitecture},
          {"task", to_string(x.step)},
          {"name", x.task.name},
          {"id", x.task.id},
          {"component", x.task.component},
          {"detail", x.detail}};
}

Json to_json(const TypeDescriptor& x) {
  auto fields = Json::object();
  for (auto& field : x.records.front().fields)
    fields[field.name] = type_text(x, field.type);
  return {{"type", x.name()},
          {"super_types", x.super_types},
          {"fields", fields},
          {"example", example_of(x)}};
}

Json members_of(const ArchitectureDescription& added) {
  Json result{{"subarchitectures", Json::array()}, {"components", Json::array()}};
  for (auto& x : added.subarchitectures)
    if (!x.working_memory.name.empty())
      result["subarchitectures"].push_back(x.name);
  for_each_component(added, [&](auto& x) {
    if (!x.name.empty() && x.kind != ComponentKind::working_memory)
      result["components"].push_back({{"name", x.name},
                                      {"subarchitecture", x.subarchitecture},
                                      {"class", x.class_name},
                                      {"node", x.host}});
  });
  return result;
}

Json members_of(const SystemRoster& roster, const std::string& name) {
  Json result{{"subarchitectures", Json::array()}, {"components", Json::array()}};
  if (roster.working_memories.count(name) > 0)
    result["subarchitectures"].push_back(name);
  for (auto& x : roster.components) {
    auto& who = x.identity;
    if (who.name == name || who.subarchitecture == name)
      result["components"].push_back(
        {{"name", who.name},
         {"subarchitecture", who.subarchitecture},
         {"class", who.class_name},
         {"node", name_of(roster, process_of(roster.placement, who.name))}});
  }
  return result;
}

std::string entry_as_json(const Entry& x, bool wanted, std::size_t max_bytes) {
  Json result{{"subarchitecture", x.address.subarchitecture},
              {"id", x.address.id},
              {"type", x.type_name()},
              {"version", x.version},
              {"writer", x.writer},
              {"bytes", x.value.bytes().size()}};
  if (!wanted)
    return to_text(result);
  JsonOptions options;
  options.max_bytes = max_bytes;
  return with_value(result, castor::to_json(x.value, options));
}

std::string change_as_json(const ChangeEvent& x, const Value& value, std::size_t max_bytes) {
  if (!value.has_value())
    return to_text(to_json(x));
  JsonOptions options;
  options.max_bytes = max_bytes;
  return with_value(to_json(x), castor::to_json(value, options));
}

Json to_json(const ReplayOutcome& x) {
  Json result{{"writes", x.writes}, {"skipped", x.skipped}, {"refused", x.refused}};
  if (x.values > 0)
    result["values"] = x.values;
  if (!x.problem.empty())
    result["problem"] = x.problem;
  return result;
}

Json to_json(const ReplayProgress& x) {
  return {{"at", x.at.count()},
          {"writes", x.outcome.writes},
          {"values", x.outcome.values},
          {"paused", x.paused},
          {"round", x.round}};
}

std::string to_text(const Json& x) {
  return x.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string as_line(const Json& x) {
  return to_text(x) + '\n';
}

} // namespace castor
