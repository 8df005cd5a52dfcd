#include "castor/tools/simulation/simulated_calls.hpp"

#include "castor/wm/events/change_notice.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;

constexpr const char* progress_suffix = ":progress";
constexpr const char* reply_suffix = ":reply";
constexpr EntryLife with_its_writer{.ephemeral = true};
constexpr EntryLife claim{.ephemeral = true, .only_once = true};

/// Of whatever the component itself registers, the first is 1.
constexpr FilterId made_filter = 11;
constexpr FilterId taken_back_filter = 12;
constexpr FilterId progress_filter = 13;

/// Longer than a call takes among processes that know each other.
constexpr std::chrono::milliseconds call_deadline{1000};
/// Longer than working memories wait for each other to take note of a filter.
constexpr std::chrono::seconds filter_deadline{10};

std::int64_t reply_to(std::int64_t question) {
  return 2 * question + 1;
}

} // namespace

WriteRequest SimulatedCalls::write(Operation operation, Address address, Value value) const {
  WriteRequest result;
  result.operation = operation;
  result.address = std::move(address);
  result.value = std::move(value);
  result.client = parts_.client;
  if (operation == Operation::add)
    result.life = with_its_writer;
  return result;
}

template <class T, class Request, class F>
void SimulatedCalls::ask(const Request& request, F then) {
  parts_.self->request(parts_.home, call_deadline, request)
    .then([then](const Outcome<T>& x) { then(&x); },
          [then](const caf::error&) { then(static_cast<const Outcome<T>*>(nullptr)); });
}

void SimulatedCalls::meet(NeighboursPtr neighbours) {
  auto before = std::exchange(neighbours_, std::move(neighbours));
  for (auto& subarchitecture : lost_working_memories(*before, *neighbours_))
    served_.memory_lost(subarchitecture);
  clean_up();
}

void SimulatedCalls::begin(const std::function<void(bool)>& done) {
  auto& mine = parts_.client->subarchitecture;
  auto& me = parts_.client->component;
  auto left = std::make_shared<int>(3);
  auto subscribe = [&](FilterId id, ChangeFilter filter) {
    Subscribe x{id, std::move(filter)};
    x.component = me;
    parts_.self->request(parts_.home, filter_deadline, x)
      .then(
        [left, done](const Outcome<Acknowledged>& registered) {
          if (--*left == 0 || !registered)
            done(bool{registered});
        },
        [done](const caf::error&) { done(false); });
  };
  subscribe(made_filter, added<Call>().anywhere().where(&Call::subarchitecture, mine));
  subscribe(taken_back_filter, deleted<Call>().anywhere().where(&Call::subarchitecture, mine));
  subscribe(progress_filter, changed<CallProgress>().anywhere().where(&CallProgress::caller, me));
}

void SimulatedCalls::take(const ChangeNotice& x) {
  auto wanted = [&](FilterId id) { return std::ranges::count(x.filters, id) > 0; };
  if (wanted(made_filter))
    serve(x.event->address);
  if (wanted(taken_back_filter)) {
    served_.deleted(x.event->address);
    clean_up();
  }
  if (wanted(progress_filter))
    note_progress(*x.event);
}

// -- the calling side

void SimulatedCalls::call(const std::string& subarchitecture, Answered answered) {
  auto& ledger = *parts_.ledger;
  auto& client = *parts_.client;
  auto id = client.component + ':' + std::to_string(client.incarnation) + ':' +
            std::to_string(++last_call_);
  auto question = ++ledger.last_question;
  open_[id] = Open{subarchitecture, question, false, std::move(answered)};
  ledger.happened.add("calls", "made");
  BatchRequest batch{client.subarchitecture, {}};
  batch.writes.push_back(
    write(Operation::add, here(id + ":request"), Value::of(Question{question})));
  batch.writes.push_back(
    write(Operation::add, here(id),
          Value::of(Call{subarchitecture, type_name<Question>(), type_name<Reply>(),
                         here(id + ":request"), client.component})));
  ask<std::vector<Version>>(batch, [this, id](const Outcome<std::vector<Version>>* x) {
    if (!x || !*x)
      settle(id, "not written");
  });
  parts_.self->delayed_send(parts_.self, call_deadline, CallTimeout{id});
}

void SimulatedCalls::time_out(const std::string& id) {
  settle(id, "not answered in time");
}

void SimulatedCalls::note_progress(const ChangeEvent& event) {
  auto& address = event.address.id;
  auto id = address.substr(0, address.rfind(progress_suffix));
  auto i = open_.find(id);
  if (i == open_.end() || i->second.is_done)
    return;
  if (event.operation == Operation::remove)
    settle(id, "given up by its server");
  else if (event.operation == Operation::overwrite || event.coalesced)
    read_reply(id);
}

void SimulatedCalls::read_reply(const std::string& id) {
  auto& open = open_.at(id);
  open.is_done = true;
  ReadRequest request{{open.subarchitecture, id + reply_suffix}, {}};
  ask<EntryPtr>(request, [this, id, question = open.question](const Outcome<EntryPtr>* x) {
    if (!x || !*x)
      return settle(id, "given up by its server");
    auto reply = (**x)->value.as<Reply>();
    if (!reply || reply->number != reply_to(question))
      parts_.ledger->find("the reply to call " + id + " is not that to its request");
    settle(id, nullptr);
  });
}

/// Takes the call back; `failure` is null if it was replied to.
void SimulatedCalls::settle(const std::string& id, const char* failure) {
  auto node = open_.extract(id);
  if (!node)
    return;
  auto& ledger = *parts_.ledger;
  ledger.happened.add("calls", failure ? failure : "replied to");
  ledger.note(id + (failure ? failure : ""));
  BatchRequest batch{parts_.client->subarchitecture, {}};
  batch.writes.push_back(write(Operation::remove, here(id)));
  batch.writes.push_back(write(Operation::remove, here(id + ":request")));
  ask<std::vector<Version>>(batch, [](const Outcome<std::vector<Version>>*) {});
  node.mapped().answered(failure == nullptr);
}

// -- the serving side

void SimulatedCalls::serve(const Address& call_at) {
  if (!served_.begin(call_at))
    return;
  ask<EntryPtr>(ReadRequest{call_at, {}}, [this, call_at](const Outcome<EntryPtr>* x) {
    auto call = x && *x ? (**x)->value.as<Call>() : nullptr;
    if (!call)
      return served_.abandon(call_at); // taken back before it was taken
    CallProgress progress{call_at,          call->caller, parts_.client->component,
                          CallState::taken, {},           {}};
    auto request = write(Operation::add, here(call_at.id + progress_suffix), Value::of(progress));
    request.life = claim;
    ask<Version>(request, [this, call_at, call](const Outcome<Version>* taken) {
      if (!taken)
        return finish(call_at); // it may have been taken
      if (!*taken)
        return served_.abandon(call_at); // another server was faster
      auto& ledger = *parts_.ledger;
      ledger.happened.add("calls", "taken");
      if (!ledger.taken.emplace(call_at.id, **taken / numbers_per_life).second)
        ledger.find("call " + call_at.id + " was taken twice");
      answer(call_at, *call, **taken);
    });
  });
}

void SimulatedCalls::answer(const Address& call_at, const Call& call, Version version) {
  ReadRequest read{call.request, {}};
  ask<EntryPtr>(read, [this, call_at, call, version](const Outcome<EntryPtr>* x) {
    auto question = x && *x ? (**x)->value.as<Question>() : nullptr;
    if (!question)
      return finish(call_at); // taken back, or its caller is gone
    auto reply_at = here(call_at.id + reply_suffix);
    CallProgress progress{call_at,         call.caller, parts_.client->component,
                          CallState::done, reply_at,    {}};
    BatchRequest batch{parts_.client->subarchitecture, {}};
    batch.writes.push_back(
      write(Operation::add, reply_at, Value::of(Reply{reply_to(question->number)})));
    batch.writes.push_back(
      write(Operation::overwrite, here(call_at.id + progress_suffix), Value::of(progress)));
    batch.writes.back().last_seen = version;
    ask<std::vector<Version>>(
      batch, [this, call_at](const Outcome<std::vector<Version>>*) { finish(call_at); });
  });
}

void SimulatedCalls::finish(const Address& call_at) {
  served_.finish(call_at);
  clean_up();
}

void SimulatedCalls::clean_up() {
  for (auto& call_at : served_.take_ended())
    for (auto* suffix : {progress_suffix, reply_suffix})
      ask<Version>(write(Operation::remove, here(call_at.id + suffix)),
                   [](const Outcome<Version>*) {});
}

} // namespace castor::simulation
