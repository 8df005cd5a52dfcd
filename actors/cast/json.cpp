#include "castor/actors/cast/json.hpp"

#include <nlohmann/json.hpp>

#include <string_view>
#include <utility>

namespace castor {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SourceLocation& where) {
  Json result;
  result["file"] = where.file();
  result["line"] = where.line();
  for (const auto& site : where.include_chain())
    result["included_from"].push_back({{"file", site.file}, {"line", site.line}});
  return result;
}

Json json_of(const ComponentDescription& component) {
  Json options = Json::array();
  for (const auto& option : component.options)
    options.push_back({{"key", option.key}, {"value", option.value}});
  Json result;
  result["name"] = component.name;
  result["kind"] = to_string(component.kind);
  result["class"] = component.class_name;
  result["language"] = to_string(component.language);
  result["host"] = component.host;
  result["number"] = component.number;
  result["options"] = std::move(options);
  result["where"] = json_of(component.where);
  return result;
}

Json json_of(const std::vector<ComponentDescription>& components) {
  Json result = Json::array();
  for (const auto& component : components)
    result.push_back(json_of(component));
  return result;
}

Json json_of(const SubarchitectureDescription& subarchitecture) {
  Json result;
  result["name"] = subarchitecture.name;
  result["host"] = subarchitecture.host;
  result["working_memory"] = json_of(subarchitecture.working_memory);
  result["task_manager"] = json_of(subarchitecture.task_manager);
  result["components"] = json_of(subarchitecture.components);
  result["where"] = json_of(subarchitecture.where);
  return result;
}

Json json_of(const ArchitectureDescription& architecture) {
  Json subarchitectures = Json::array();
  for (const auto& subarchitecture : architecture.subarchitectures)
    subarchitectures.push_back(json_of(subarchitecture));
  Json rules = Json::array();
  for (const auto& rule : architecture.access_rules)
    rules.push_back(
      {{"writer", rule.writer}, {"owner", rule.owner}, {"where", json_of(rule.where)}});
  Json read_rules = Json::array();
  for (const auto& rule : architecture.read_rules)
    read_rules.push_back(
      {{"reader", rule.reader}, {"owner", rule.owner}, {"where", json_of(rule.where)}});
  Json result;
  result["file"] = architecture.file;
  result["config_dir"] = architecture.config_dir;
  result["host_names"] = Json::object();
  for (const auto& [name, host] : architecture.host_names)
    result["host_names"][name] = host;
  result["subarchitectures"] = std::move(subarchitectures);
  result["standalone"] = json_of(architecture.standalone);
  result["access_rules"] = std::move(rules);
  result["read_rules"] = std::move(read_rules);
  result["supervision"] = Json::array();
  for (const auto& rule : architecture.supervision)
    result["supervision"].push_back({{"who", rule.who},
                                     {"strategy", to_string(rule.policy.strategy)},
                                     {"restarts", rule.policy.restarts},
                                     {"period_ms", rule.policy.period.count()},
                                     {"first_delay_ms", rule.policy.first_delay.count()},
                                     {"longest_delay_ms", rule.policy.longest_delay.count()},
                                     {"where", json_of(rule.where)}});
  result["failover"] = Json::array();
  for (const auto& rule : architecture.failover)
    result["failover"].push_back(
      {{"who", rule.who}, {"hosts", rule.hosts}, {"where", json_of(rule.where)}});
  return result;
}

Json json_of(const Diagnostic& diagnostic) {
  Json result;
  result["severity"] = to_string(diagnostic.severity);
  result["where"] = json_of(diagnostic.where);
  result["line"] = diagnostic.line;
  result["expanded"] = diagnostic.expanded;
  result["message"] = diagnostic.message;
  result["remedy"] = diagnostic.remedy;
  return result;
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string to_json(const ArchitectureDescription& architecture) {
  return dump(json_of(architecture));
}

std::string cast::to_json(const ParseResult& result) {
  Json json;
  json["ok"] = result.ok();
  json["diagnostics"] = Json::array();
  for (const auto& diagnostic : result.diagnostics)
    json["diagnostics"].push_back(json_of(diagnostic));
  json["expansions"] = result.expansions;
  json["architecture"] = result.architecture ? json_of(*result.architecture) : Json();
  return dump(json);
}

} // namespace castor
