#include "castor/actors/node/part_agent.hpp"

#include "castor/actors/link/remote_actor.hpp"
#include "castor/actors/node/counting_config.hpp"
#include "castor/actors/node/types_protocol.hpp"
#include "castor/actors/node/usage.hpp"
#include "castor/actors/node/well_known_actors.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/wm/values/known_types.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

using Self = caf::stateful_actor<PartAgentState>*;

constexpr std::chrono::seconds peers_patience{10};

/// Learns of the ends of all that is here.
void watch(Self self) {
  auto& state = self->state;
  for (auto& x : state.part->residents()) {
    auto [i, is_new] =
      state.watched.try_emplace(caf::actor_cast<caf::actor_addr>(x.actor),
                                PartAgentState::Watched{x.name, x.incarnation, x.record});
    if (is_new)
      self->monitor(x.actor);
  }
}

/// Makes a clock, if the plan wants a simulated one.
std::shared_ptr<SimulatedClock> take_up_clock(Self self, const PartPlan& plan) {
  auto& state = self->state;
  auto& mesh = state.parts.mesh;
  auto activity = activity_of(self->system());
  if (!plan.simulated_clock || state.parts.clock || !mesh || !activity)
    return state.parts.clock;
  auto result = std::make_shared<SimulatedClock>(std::move(activity), plan.clock);
  state.clock_reporter = std::make_unique<ClockReporter>(result, mesh);
  return result;
}

PartMade make(Self self, const PartPlan& plan) {
  auto& state = self->state;
  const auto arrived = self->clock().now();
  if (state.parts.connect)
    state.parts.connect(plan);
  if (!state.part)
    state.part = std::make_unique<SystemPart>(self->system(), state.parts.self, state.parts.spawn,
                                              take_up_clock(self, plan));
  state.supervisor = plan.supervisor;
  auto problems = state.part->apply(plan, arrived);
  watch(self);
  return {std::move(problems), state.part->actors()};
}

PartMade restart(Self self, const RestartComponent& x) {
  auto& state = self->state;
  if (!state.part)
    return {};
  state.part->restart(x.name, x.incarnation);
  watch(self);
  return {{}, state.part->actors()};
}

void inject(Self self, const InjectComponentFault& x) {
  if (!self->state.part)
    return;
  for (auto& resident : self->state.part->residents()) {
    if (resident.name != x.name)
      continue;
    if (resident.record)
      caf::anon_send(caf::actor_cast<caf::actor>(resident.actor), x.fault);
    else
      resident.actor->enqueue(
        nullptr, caf::make_message_id(),
        caf::make_message(caf::exit_msg{
          self->address(), caf::make_error(caf::sec::runtime_error, "injected crash")}),
        self->context());
  }
}

void answer_if_joined(Self self) {
  auto& state = self->state;
  if (!state.joining || !state.unanswered.empty() ||
      (state.parts.connect && !std::includes(state.connected.begin(), state.connected.end(),
                                             state.others.begin(), state.others.end())))
    return;
  std::exchange(state.joining, std::nullopt)->deliver(Acknowledged{});
}

/// Something that was here has ended.
void report_end(Self self, const caf::down_msg& x) {
  auto& state = self->state;
  auto watched = state.watched.extract(x.source);
  if (!watched)
    return;
  // It knows the others when it is back.
  if (state.unanswered.erase(x.source) > 0)
    answer_if_joined(self);
  auto& [name, incarnation, record] = watched.mapped();
  ComponentEnded ended{name, incarnation, ComponentEnded::How::stopped, {}, {}};
  if (record) {
    ended.failure = record->failure();
    ended.waited_for = record->waited_for();
    if (record->state() == ComponentState::failed)
      ended.how =
        record->is_orphaned() ? ComponentEnded::How::orphaned : ComponentEnded::How::failed;
  } else if (x.reason && x.reason != caf::exit_reason::user_shutdown) {
    ended.how = ComponentEnded::How::failed;
    ended.failure = plain_words(x.reason, self->system());
  }
  caf::anon_send(state.supervisor, std::move(ended));
}

/// Hands the events that come from other processes to the working memories of this one.
void deliver_events(const std::map<std::string, WorkingMemoryActor>& working_memories,
                    const caf::message& message, caf::execution_unit* context) {
  if (!message.match_elements<RoutedEvents>())
    return;
  std::map<std::string, ChangeNotices> found;
  for (auto& [event, receivers] : message.get_as<RoutedEvents>(0).events)
    for (auto& [subarchitecture, interests] : receivers)
      found[subarchitecture].notices.push_back({event, interests});
  for (auto& [subarchitecture, events] : found)
    if (auto i = working_memories.find(subarchitecture); i != working_memories.end())
      caf::actor_cast<caf::abstract_actor*>(i->second)->enqueue(
        nullptr, caf::make_message_id(), caf::make_message(std::move(events)), context);
}

/// The ways for events to other processes.
using Routes = std::map<ProcessNumber, caf::strong_actor_ptr>;

/// Leaves out those of lost processes, of whom nothing is known here, or not any more.
Routes find_routes(Mesh& mesh, std::map<std::string, caf::strong_actor_ptr>& actors) {
  Routes result;
  std::erase_if(actors, [&](auto& x) {
    auto* remote = as_remote(x.second);
    if (!remote)
      return false;
    auto process = process_of(remote->actor());
    auto [route, is_new] = result.try_emplace(process);
    if (is_new)
      route->second = mesh.well_known(process, event_sink_number);
    return !route->second;
  });
  return result;
}

caf::response_promise join(Self self, JoinParts others) {
  auto& state = self->state;
  std::erase_if(others.actors, [](auto& x) { return !x.second; });
  Routes routes;
  if (state.parts.mesh)
    routes = find_routes(*state.parts.mesh, others.actors);
  auto promise = self->make_response_promise();
  if (!state.part) {
    promise.deliver(caf::make_error(caf::sec::runtime_error));
    return promise;
  }
  // What was to be known before is known better now.
  if (state.joining)
    state.joining->deliver(Acknowledged{});
  state.joining = promise;
  state.others = std::move(others.processes);
  state.others.erase(state.parts.self);
  state.part->join(others.actors);
  Peers peers;
  peers.working_memories = state.part->subarchitectures(others.actors);
  peers.absent = state.part->absent(peers.working_memories);
  if (auto& mesh = state.parts.mesh) {
    auto& largest = state.part->largest_values();
    for (auto& [name, actor] : peers.working_memories)
      if (auto* remote = as_remote(actor)) {
        peers.routes[name] = routes.at(process_of(remote->actor()));
        if (auto i = largest.find(name); i != largest.end())
          state.parts.messages->set_largest_value(remote->actor(), name, i->second);
      }
    mesh->set_sink(event_sink_number, [here = state.part->working_memories()](
                                        ProcessNumber, auto& message, auto* context) {
      deliver_events(here, message, context);
    });
  }
  auto working_memories = state.part->working_memories();
  state.unanswered.clear();
  for (auto& [name, actor] : working_memories)
    state.unanswered.insert(actor.address());
  auto answered = [self, number = ++state.joins](const caf::actor_addr& who) {
    if (number == self->state.joins && self->state.unanswered.erase(who) > 0)
      answer_if_joined(self);
  };
  for (auto& [name, actor] : working_memories) {
    peers.writers = state.part->writers(name);
    self->request(actor, peers_patience, peers)
      .then([answered, who = actor.address()](Acknowledged) { answered(who); },
            [answered, who = actor.address()](const caf::error&) { answered(who); });
  }
  answer_if_joined(self);
  return promise;
}

} // namespace

caf::behavior part_agent(Self self, PartAgentParts parts) {
  self->state.parts = std::move(parts);
  self->set_down_handler([self](const caf::down_msg& x) { report_end(self, x); });
  return {
    [self](const PartPlan& x) { return make(self, x); },
    [self](const RestartComponent& x) { return restart(self, x); },
    [self](const JoinParts& x) { return join(self, x); },
    [self](const InjectComponentFault& x) {
      inject(self, x);
      return Acknowledged{};
    },
    [self](const InjectLinkFault& x) {
      if (auto& mesh = self->state.parts.mesh)
        mesh->inject(x.peer, x.fault);
    },
    [self](PartStatusQuery) {
      PartStatus result;
      if (auto& part = self->state.part)
        result.components = part->components();
      if (auto& mesh = self->state.parts.mesh)
        result.links = mesh->links();
      result.usage = usage_of_process();
      return result;
    },
    [](TypesQuery) {
      TypesReport result;
      for (auto& [name, type] : known_types())
        result.types.push_back(type);
      return result;
    },
    [self](const LinkNews& x) {
      if (x.state == LinkState::up)
        self->state.connected.insert(x.peer);
      else
        self->state.connected.erase(x.peer);
      if (x.state == LinkState::lost)
        self->state.others.erase(x.peer);
      answer_if_joined(self);
    },
  };
}

} // namespace castor
