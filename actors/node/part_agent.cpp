#include "castor/actors/node/part_agent.hpp"

#include <utility>

namespace castor {

namespace {

using Self = caf::stateful_actor<PartAgentState>*;

constexpr std::chrono::seconds patience{10};

PartMade make(Self self, const PartPlan& plan) {
  auto& state = self->state;
  state.others = plan.processes.size() - 1;
  if (state.parts.connect)
    state.parts.connect(plan);
  state.part = std::make_unique<SystemPart>(self->system(), plan, state.parts.self);
  return {state.part->problems(), state.part->actors()};
}

void answer_if_joined(Self self) {
  auto& state = self->state;
  if (!state.joining || state.unanswered > 0 ||
      (state.parts.connect && state.connected.size() < state.others))
    return;
  std::exchange(state.joining, std::nullopt)->deliver(Acknowledged{});
}

caf::response_promise join(Self self, const JoinParts& others) {
  auto& state = self->state;
  auto promise = self->make_response_promise();
  if (!state.part || state.joining) {
    promise.deliver(caf::make_error(caf::sec::runtime_error));
    return promise;
  }
  state.joining = promise;
  state.part->join(others.actors);
  Peers peers;
  for (auto& [name, actor] : state.part->subarchitectures(others.actors))
    peers.working_memories[name] = actor;
  state.unanswered = state.part->working_memories().size();
  for (auto& [name, actor] : state.part->working_memories())
    self->request(actor, patience, peers).then([self](Acknowledged) {
      --self->state.unanswered;
      answer_if_joined(self);
    });
  answer_if_joined(self);
  return promise;
}

} // namespace

caf::behavior part_agent(Self self, PartAgentParts parts) {
  self->state.parts = std::move(parts);
  return {
    [self](const PartPlan& x) { return make(self, x); },
    [self](const JoinParts& x) { return join(self, x); },
    [self](PartStatusQuery) {
      PartStatus result;
      if (auto& part = self->state.part)
        result.components = part->components();
      return result;
    },
    [self](const LinkNews& x) {
      if (x.kind == LinkNews::Kind::up)
        self->state.connected.insert(x.peer);
      else
        self->state.connected.erase(x.peer);
      answer_if_joined(self);
    },
  };
}

} // namespace castor
