#include "castor/actors/cast/writer.hpp"

#include "castor/actors/cast/supervision_policy.hpp"
#include "castor/base/duration.hpp"

namespace castor::cast {

namespace {

std::string options_text(const ComponentDescription& component) {
  std::string text;
  for (const auto& option : component.options)
    text += " " + option.key + " \"" + option.value + "\"";
  return text + "\n";
}

/// What a line is for, up to the name of the class.
std::string kind_text(const ComponentDescription& component) {
  switch (component.kind) {
    case ComponentKind::working_memory:
      return "WM ";
    case ComponentKind::task_manager:
      return "TM ";
    case ComponentKind::managed:
      return "MG " + component.name + " ";
    case ComponentKind::unmanaged:
      return "UM " + component.name + " ";
    case ComponentKind::standalone:
      return component.name + " ";
  }
  return {};
}

std::string component_text(const ComponentDescription& component) {
  std::string begin = component.kind == ComponentKind::standalone ? "COMPONENT " : "";
  if (!component.host.empty())
    begin += component.host + " ";
  return begin + "CPP " + kind_text(component) + component.class_name + options_text(component);
}

} // namespace

std::string to_cast(const ArchitectureDescription& architecture) {
  std::string text;
  for (const auto& each : architecture.standalone)
    text += component_text(each);
  for (const auto& sa : architecture.subarchitectures) {
    text += "\nSUBARCHITECTURE " + sa.name + (sa.host.empty() ? "" : " " + sa.host) + "\n";
    text += component_text(sa.working_memory) + component_text(sa.task_manager);
    for (const auto& each : sa.components)
      text += component_text(each);
  }
  text += "\n";
  for (const auto& rule : architecture.access_rules)
    text += "ACCESS " + rule.writer + " WRITES " + rule.owner + "\n";
  for (const auto& rule : architecture.read_rules)
    text += "ACCESS " + rule.reader + " READS " + rule.owner + "\n";
  for (const auto& [who, policy, where] : architecture.supervision)
    text += "SUPERVISE " + who + " " + std::string(to_string(policy.strategy)) + " RESTARTS " +
            std::to_string(policy.restarts) + " IN " + to_string(policy.period) + " DELAY " +
            to_string(policy.first_delay) + " TO " + to_string(policy.longest_delay) + "\n";
  for (const auto& rule : architecture.failover) {
    text += "FAILOVER " + rule.who + " TO";
    for (const auto& host : rule.hosts)
      text += " " + host;
    text += "\n";
  }
  return text;
}

} // namespace castor::cast
