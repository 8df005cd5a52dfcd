#include "castor/actors/runtime/operations_client.hpp"

#include "castor/actors/component/component.hpp"
#include "castor/base/at_exit.hpp"
#include "castor/base/plain_words.hpp"

#include <algorithm>
#include <stdexcept>

namespace castor {

OperationsClient::OperationsClient(const Parts& parts)
  : parts_(parts), reader_(parts.context.services().readable_memories, parts.context.client()) {
  if (auto& log = parts_.context.services().operations)
    recorder_.emplace(*log, parts_.context.client());
}

bool OperationsClient::is_running() {
  parts_.actor.file_arrived();
  return !parts_.life.is_stopping();
}

Patience OperationsClient::patience(std::chrono::nanoseconds at_most) {
  return {parts_.context.client(), ++last_wait_, std::chrono::duration_cast<Timestamp>(at_most)};
}

void OperationsClient::check_may_operate() const {
  auto& identity = parts_.context.identity();
  if (!working_memory()) {
    if (parts_.life.is_working_memory_lost())
      throw WorkingMemoryLostException{
        {FailureKind::working_memory_lost,
         "the working memory of " + identity.subarchitecture + " is not there",
         {identity.subarchitecture, {}}}};
    throw std::logic_error(identity.full_name() + " is outside the subarchitectures and has no " +
                           "working memory");
  }
  if (!parts_.life.has_started())
    throw std::logic_error(
      "working memory is not there yet in configure(): use it from start() on");
  // Operations on an idle working memory never wait, so this is where a stop ends a loop of them.
  if (parts_.life.refuses_operations())
    throw ComponentStopped{};
}

bool OperationsClient::is_one_at_a_time() const {
  return parts_.actor.simulated_clock()->activity().is_one_at_a_time();
}

std::optional<Failure>
OperationsClient::wait_until(const std::function<bool()>& done, Clock::time_point until,
                             const std::function<std::optional<WaitEdge>()>& wait) {
  // Long enough for most waits to end of themselves, short enough for a deadlock to be found within
  // a second.
  constexpr std::chrono::milliseconds between_probes{200};
  check_may_wait("something of others");
  auto& identity = parts_.context.identity();
  UserCode::Pause pause{parts_.code};
  AtExit no_wait_any_more{[this] {
    waiting_.reset();
    deadlock_.clear();
  }};
  auto next_probe = Clock::now() + between_probes;
  int quiets = 0;
  parts_.actor.file_arrived();
  while (!done()) {
    if (parts_.life.refuses_operations())
      throw ComponentStopped{};
    parts_.faults.at_runtime();
    if (parts_.life.is_working_memory_lost())
      return Failure{FailureKind::working_memory_lost,
                     "the working memory of " + identity.subarchitecture +
                       " ended before it answered",
                     {identity.subarchitecture, {}}};
    if (!deadlock_.empty())
      return Failure{FailureKind::deadlock,
                     identity.full_name() + " gives up waiting; wait cycle: " + deadlock_,
                     waiting_->address};
    bool probes_by_time = parts_.actor.simulated_clock() == nullptr || !is_one_at_a_time();
    bool is_quiet = false;
    if (wait && parts_.actor.simulated_clock() && quiets < 2)
      is_quiet = parts_.actor.pump_until_quiet(until);
    else
      parts_.actor.pump(wait && probes_by_time ? std::min(until, next_probe) : until,
                        wait ? PumpedActor::Expected::in_turn : PumpedActor::Expected::soon);
    // A stream of events wakes us again and again; the deadline holds all the same.
    auto time = Clock::now();
    if (!done() && time >= until)
      return Failure{FailureKind::no_answer, {}, {}};
    bool is_due = wait && probes_by_time && time >= next_probe;
    if (!is_due && !is_quiet)
      continue;
    next_probe = time + between_probes;
    waiting_ = wait();
    // Finding that out may have been an operation of its own.
    pause.renew();
    // Those who wait find a cycle before time goes on: first all know for what, then they ask.
    if (is_quiet && ++quiets == 1)
      continue;
    if (waiting_)
      send(DeadlockProbe{{*waiting_}, 0});
  }
  return std::nullopt;
}

Outcome<caf::mailbox_element_ptr> OperationsClient::wait_for(std::uint64_t id,
                                                             const Address& address,
                                                             std::chrono::nanoseconds patience,
                                                             const WaitEdge* wait) {
  auto& actor = parts_.actor;
  check_settled(id, address);
  bool answered = false;
  AtExit leave{[&] {
    actor.close_slot(id);
    if (answered)
      unanswered_.answered(id, address.subarchitecture);
    else
      unanswered_.abandoned(id, address.subarchitecture);
    if (wait && !answered && !parts_.life.is_working_memory_lost())
      send(CancelWait{wait->address, wait->waiter, wait->number});
  }};
  std::function<std::optional<WaitEdge>()> edge;
  if (wait)
    edge = [wait] { return std::optional{*wait}; };
  std::optional<Failure> failure;
  if (actor.shares_threads())
    failure = Failure{FailureKind::no_answer, {}, {}};
  else
    failure = wait_until([&] { return actor.slot(id) != nullptr; }, Clock::now() + patience, edge);
  answered = actor.slot(id) != nullptr;
  if (answered)
    return std::move(actor.slot(id));
  if (failure->kind == FailureKind::no_answer)
    failure->message = parts_.context.identity().full_name() + " got no answer about " +
                       to_string(address) + " within " +
                       detail::print_option(parts_.context.deadline()) +
                       ". Its --deadline can be raised";
  failure->address = address;
  return *failure;
}

EntryPtr OperationsClient::read_here(const Address& address) {
  // Seldom enough to cost little, and often enough for a stop to be seen within microseconds.
  constexpr std::uint64_t reads_between = 64;
  if (++read_here_ % reads_between == 0)
    show_progress();
  check_may_operate();
  if (parts_.life.is_working_memory_lost() || !unanswered_.are_handled(address.subarchitecture))
    return nullptr;
  if (!recorder_)
    return reader_.read(address);
  auto since = Clock::now();
  auto entry = reader_.read(address);
  if (entry)
    recorder_->read_here(entry, since);
  return entry;
}

void OperationsClient::check_may_wait(const std::string& what) const {
  if (parts_.actor.shares_threads())
    throw std::logic_error(parts_.context.identity().full_name() + " must not wait for " + what +
                           ": as a CallbackComponent, it would keep the thread that it shares from "
                           "others. Use then(), or derive from UnmanagedComponent");
}

void OperationsClient::show_progress() {
  UserCode::Pause pause{parts_.code};
  parts_.actor.file_arrived();
  parts_.faults.at_runtime();
}

void OperationsClient::claim(const LeaseOffer& offer) {
  if (parts_.life.is_working_memory_lost())
    return;
  parts_.unit.run([&] { send(ClaimLease{offer.address, parts_.context.client(), offer.number}); });
}

void OperationsClient::receive_probe(DeadlockProbe probe) {
  if (!waiting_)
    return;
  switch (castor::receive_probe(probe, *waiting_)) {
    case ProbeVerdict::drop:
      break;
    case ProbeVerdict::pass_on:
      send(std::move(probe));
      break;
    case ProbeVerdict::deadlock:
      deadlock_ = cycle_of(probe);
      break;
  }
}

Outcome<Acknowledged> OperationsClient::try_unlock(const Address& address, LeaseToken token) {
  UnlockRequest request{address, parts_.context.client(), token};
  if (!is_running()) {
    parts_.unit.run([&] { send(request); });
    return Acknowledged{};
  }
  try {
    return finish<Acknowledged>(begin(request), address);
  } catch (const ComponentStopped&) {
    // The request is on its way.
    return Acknowledged{};
  }
}

Failure OperationsClient::unexpected_reply(const caf::type_erased_tuple& content,
                                           const Address& address) {
  std::string what = "it sent " + content.stringify();
  if (content.match_elements<caf::error>()) {
    auto& e = content.get_as<caf::error>(0);
    auto has_ended = e == caf::sec::request_receiver_down;
    what = has_ended ? "it has ended" : plain_words(e, parts_.actor.system());
    // The news of that may still be on its way.
    if (has_ended && address.subarchitecture == parts_.context.identity().subarchitecture)
      parts_.life.set_working_memory_lost(true);
  }
  return {FailureKind::working_memory_lost, "no result from " + to_string(address) + ": " + what,
          address};
}

} // namespace castor
