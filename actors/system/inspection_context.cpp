#include "castor/actors/system/inspection_context.hpp"

#include "castor/actors/node/types_protocol.hpp"
#include "castor/actors/runtime/bundled_plugins.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/actors/system/operator_client.hpp"

#include <caf/atom.hpp>

namespace castor {

namespace {

using LoadAtom = caf::atom_constant<caf::atom("load")>;

/// Loads libraries on a thread of its own, since that takes a while.
caf::behavior plugin_loader(caf::event_based_actor* self) {
  return {[self](LoadAtom) {
    load_bundled_plugins();
    self->quit();
    return true;
  }};
}

} // namespace

void InspectionContext::send(std::string text, bool last) {
  self->send(parts.endpoint, InspectionReply{parts.connection, std::move(text), last});
}

const WorkingMemoryActor& InspectionContext::working_memory(const std::string& name) const {
  auto& all = parts.roster->working_memories;
  if (auto i = all.find(name); i != all.end())
    return i->second;
  std::set<std::string> names;
  for (auto& [other, wm] : all)
    names.insert(other);
  throw InspectionError("there is no subarchitecture " + name + nearest_known(name, names));
}

void InspectionContext::with_types(std::function<void(TypeCatalogue)> f) {
  // An operator may mean types that no component here has needed so far.
  if (!lacks_bundled_plugins())
    return with_known_types(f);
  self->request(self->spawn<caf::detached>(plugin_loader), caf::infinite, LoadAtom::value)
    .then([context = shared_from_this(), f](bool) {
      context->guarded([&] { context->with_known_types(f); });
    });
}

void InspectionContext::with_known_types(std::function<void(TypeCatalogue)> f) {
  auto types = std::make_shared<TypeCatalogue>(known_types());
  std::shared_ptr<void> done{nullptr, [context = shared_from_this(), types, f](void*) {
                               context->guarded([&] { f(std::move(*types)); });
                             }};
  // This process is the first, and has been asked.
  for (std::size_t i = 1; i < parts.roster->agents.size(); ++i)
    if (auto& agent = parts.roster->agents[i])
      self->request(agent, inspection_patience, TypesQuery{})
        .then(
          [types, done](const TypesReport& x) {
            for (auto& type : x.types)
              types->emplace(type->name(), type);
          },
          [done](const caf::error&) {});
}

KnownNames InspectionContext::known_names(TypeCatalogue types) const {
  KnownNames result{
    std::move(types), {}, {expiry_source, owner_ended_source, last_will_source, operator_source()}};
  for (auto& [name, wm] : parts.roster->working_memories)
    result.subarchitectures.insert(name);
  for (auto& x : parts.roster->components)
    result.sources.insert(x.identity.name);
  for (auto& [name, process] : parts.roster->placement)
    result.sources.insert(name);
  // Who tells of the system's own health.
  result.sources.insert("supervisor");
  return result;
}

} // namespace castor
