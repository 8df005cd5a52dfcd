#include "castor/actors/system/change_requests.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/actors/node/check.hpp"

#include <map>
#include <string>
#include <utility>
#include <variant>

namespace castor {

namespace {

/// What the lines that are added may name.
SystemNames running_names(const SystemRoster& roster) {
  SystemNames result;
  for (auto& [name, wm] : roster.working_memories)
    result.subarchitectures.insert(name);
  for (auto& x : roster.components)
    (x.identity.subarchitecture.empty() ? result.standalone : result.in_subarchitectures)
      .insert(x.identity.name);
  return result;
}

/// @param news what is said of a change that was made
std::string outcome_as_json(const OrderOutcome& x, const Json& news = Json::object()) {
  Json result;
  if (!x.findings.empty())
    result["findings"] = render(x.findings);
  else if (!x.problem.empty())
    result["error"] = x.problem;
  else {
    result["done"] = true;
    result.update(news);
  }
  return as_line(result);
}

void give_order(const InspectionContext& context,
                std::variant<ArchitectureDescription, std::string> what, Json news) {
  auto done = [to = context.parts.endpoint, connection = context.parts.connection,
               news = std::move(news)](const OrderOutcome& x) {
    caf::anon_send(to, InspectionReply{connection, outcome_as_json(x, news), true});
  };
  context.parts.give_order({std::move(what), std::move(done)});
}

} // namespace

void add_components(const InspectionContextPtr& context, const Json& request) {
  auto& roster = *context->parts.roster;
  cast::ParseOptions options;
  for (auto& [name, wm] : roster.working_memories)
    if (name != health_subarchitecture)
      options.running_subarchitectures.insert(name);
  options.variables = request.value("variables", std::map<std::string, std::string>{});
  options.working_directory = request.value("directory", "");
  auto result = cast::parse_file(request.at("file").get<std::string>(), options);
  if (!result.ok()) {
    auto findings = all_findings(result, Classes::on_this_machine, running_names(roster));
    context->send(outcome_as_json({{}, std::move(findings)}), true);
    return;
  }
  if (!result.diagnostics.empty())
    context->send(as_line(Json{{"remarks", render(result.diagnostics)}}));
  auto news = members_of(*result.architecture);
  give_order(*context, *std::move(result.architecture), std::move(news));
}

void remove_component(const InspectionContextPtr& context, const Json& request) {
  auto name = request.at("name").get<std::string>();
  give_order(*context, name, members_of(*context->parts.roster, name));
}

} // namespace castor
