#include "castor/actors/node/observer.hpp"

#include "castor/wm/change_filter.hpp"

namespace castor {

namespace {

using Self = caf::stateful_actor<ObserverState>*;

void observe(Self self, const SystemOptions& options, const ChangeEvent& event) {
  auto& state = self->state;
  if (options.on_change)
    options.on_change(event);
  auto& where = event.address.subarchitecture;
  if (auto i = state.system.logged.find(where); i != state.system.logged.end())
    log(i->second, where + '.' + working_memory_of(where), to_string(event));
  auto wm = state.system.working_memories.find(where);
  auto receipts = state.receipts.try_emplace(where, standard_queue_limit).first;
  if (auto count = receipts->second.take(); count > 0 && wm != state.system.working_memories.end())
    self->send(wm->second, EventsTaken{EventStream::component, count});
}

/// Begins with those that are new.
void look_at(Self self, const SystemOptions& options, const ObservedSystem& x) {
  auto known = std::exchange(self->state.system, x).working_memories;
  for (auto& [name, wm] : x.working_memories) {
    auto i = known.find(name);
    if ((i != known.end() && i->second == wm) || (!options.on_change && x.logged.count(name) == 0))
      continue;
    self->state.receipts.erase(name);
    self->send(wm, Subscribe{1, any_change()});
  }
}

} // namespace

caf::behavior observer(Self self, const SystemOptions& options) {
  return {
    [self, &options](const ObservedSystem& x) { look_at(self, options, x); },
    [self, &options](const ChangeNotice& x) { observe(self, options, *x.event); },
    [self, &options](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        observe(self, options, *notice.event);
    },
    [&options](const TaskEvent& x) { options.on_task(x); },
    [](const Outcome<Acknowledged>&) {},
    [](FlushObserver) { return true; },
  };
}

} // namespace castor
