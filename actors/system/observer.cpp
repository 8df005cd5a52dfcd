#include "castor/actors/system/observer.hpp"

#include "castor/wm/entries/working_memory_name.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

using ObserverSelf = caf::stateful_actor<ObserverState>*;

/// Numbers of subscriptions: the first is for every change, then come those that are watched.
constexpr FilterId all_changes = 1;
constexpr FilterId first_watched = 2;

bool are_told(const ObserverState& state, std::uint64_t up_to) {
  return std::ranges::all_of(
    state.awaited, [&](auto& x) { return x.second.empty() || x.second.front()->number > up_to; });
}

/// Tells of the changes in a working memory whose entries have been read.
void tell_entries(ObserverSelf self, const SystemOptions& options, const std::string& where) {
  auto& state = self->state;
  auto& queue = state.awaited[where];
  for (; !queue.empty() && queue.front()->is_read; queue.pop_front())
    options.on_entry(*queue.front()->event, queue.front()->entry);
  std::erase_if(state.flushes, [&](AwaitedFlush& x) {
    if (!are_told(state, x.number))
      return false;
    x.promise.deliver(true);
    return true;
  });
}

void read_entry(ObserverSelf self, const SystemOptions& options, const ChangeEventPtr& event) {
  auto& address = event->address;
  auto wm = self->state.system.working_memories.find(address.subarchitecture);
  auto awaited = std::make_shared<AwaitedEntry>();
  awaited->number = ++self->state.last_awaited;
  awaited->event = event;
  self->state.awaited[address.subarchitecture].push_back(awaited);
  auto told = [self, &options, awaited](EntryPtr entry) {
    awaited->entry = std::move(entry);
    awaited->is_read = true;
    tell_entries(self, options, awaited->event->address.subarchitecture);
  };
  if (event->operation == Operation::remove || wm == self->state.system.working_memories.end())
    return told(nullptr);
  self->request(wm->second, options.answer_patience, ReadRequest{address, {}})
    .then([told](const Outcome<EntryPtr>& x) { told(x ? *x : nullptr); },
          [told](const caf::error&) { told(nullptr); });
}

void observe(ObserverSelf self, const SystemOptions& options, const ChangeNotice& notice) {
  auto& state = self->state;
  auto& event = *notice.event;
  if (options.on_change)
    options.on_change(event);
  if (options.on_entry)
    read_entry(self, options, notice.event);
  for (auto filter : notice.filters)
    if (filter >= first_watched)
      options.on_watched(filter - first_watched, event);
  auto& where = event.address.subarchitecture;
  if (auto i = state.system.logged.find(where); i != state.system.logged.end())
    log(i->second, where + '.' + working_memory_of(where), to_string(event));
  auto wm = state.system.working_memories.find(where);
  auto receipts = state.receipts.try_emplace(where, standard_queue_limit).first;
  if (auto count = receipts->second.take(); count > 0 && wm != state.system.working_memories.end())
    self->send(wm->second, EventsTaken{EventStream::component, count});
}

void subscribe(ObserverSelf self, const SystemOptions& options, const std::string& name,
               const WorkingMemoryActor& wm) {
  if (options.on_change || options.on_entry || self->state.system.logged.count(name) > 0)
    self->send(wm, Subscribe{all_changes, any_change()});
  for (std::size_t i = 0; i < options.watched.size(); ++i) {
    auto& where = options.watched[i].subarchitecture;
    if (where.value_or("").empty() || *where == name)
      self->send(wm,
                 Subscribe{first_watched + static_cast<FilterId>(i), options.watched[i].in(name)});
  }
}

/// Begins with those that are new.
void look_at(ObserverSelf self, const SystemOptions& options, const ObservedSystem& x) {
  auto known = std::exchange(self->state.system, x).working_memories;
  for (auto& [name, wm] : x.working_memories) {
    auto i = known.find(name);
    if (i != known.end() && i->second == wm)
      continue;
    self->state.receipts.erase(name);
    subscribe(self, options, name, wm);
  }
}

} // namespace

caf::behavior observer(ObserverSelf self, const SystemOptions& options) {
  return {
    [self, &options](const ObservedSystem& x) { look_at(self, options, x); },
    [self, &options](const ChangeNotice& x) { observe(self, options, x); },
    [self, &options](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        observe(self, options, notice);
    },
    [&options](const TaskEvent& x) { options.on_task(x); },
    [](const Outcome<Acknowledged>&) {},
    [self](FlushObserver) -> caf::result<bool> {
      auto last = self->state.last_awaited;
      if (are_told(self->state, last))
        return true;
      auto promise = self->make_response_promise<bool>();
      self->state.flushes.push_back({last, promise});
      return promise;
    },
  };
}

} // namespace castor
