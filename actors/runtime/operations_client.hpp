#pragma once

#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/entry_reader.hpp"
#include "castor/actors/runtime/life_cycle.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/runtime/unanswered_requests.hpp"
#include "castor/actors/runtime/user_code.hpp"
#include "castor/wm/leases/deadlock_probe.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace castor {

/// Sends a component's operations to its working memory, and pumps the mailbox until their outcomes
/// arrive. A wait that is part of a cycle of waits is given up.
class OperationsClient {
public:
  using Clock = ComponentContext::Clock;

  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    LifeCycle& life;
    InjectedFaults& faults;
    UserCode& code;
    CallerRuns& unit;
  };

  explicit OperationsClient(const Parts& parts);

  /// False from the moment the component was told to stop.
  bool is_running();

  /// For an operation that may have to wait for a lease to end.
  Patience patience(std::chrono::nanoseconds at_most);

  /// Sends an operation to the own working memory; its outcome is taken with `finish`, once, or
  /// abandoned.
  template <class Request>
  std::uint64_t begin(const Request& request) {
    check_may_operate();
    std::optional<OperationRecorder::Open> open;
    if (recorder_)
      open = recorder_->begin(request);
    std::uint64_t id = 0;
    parts_.unit.run([&] {
      id = parts_.actor.request(working_memory(), caf::infinite, request).id().integer_value();
    });
    parts_.actor.open_slot(id);
    unanswered_.begun();
    if (open)
      recorder_->sent(id, *std::move(open));
    return id;
  }

  /// Calls `f` once the outcome is there, while messages are filed.
  void on_answer(std::uint64_t id, std::function<void()> f) {
    parts_.actor.on_filled(id, std::move(f));
  }

  /// Of a component that shares its threads: the outcome of this operation may be finished, as it
  /// is there, or as it has not come in time.
  void settle(std::uint64_t id) { settled_ = id; }
  /// Throws std::logic_error if the component shares its threads and would wait for the outcome.
  void check_settled(std::uint64_t id, const Address& address) const {
    if (id != settled_)
      check_may_wait("the outcome of an operation on " + to_string(address));
  }

  void abandon(std::uint64_t id, const Address& address) {
    parts_.actor.close_slot(id);
    unanswered_.abandoned(id, address.subarchitecture);
  }

  /// The entry, if it can be read without a message to its working memory, as all earlier requests
  /// there were handled and nobody keeps others from reading it; else null.
  EntryPtr read_here(const Address& address);

  template <class Reply>
  Outcome<Reply> finish(std::uint64_t id, const Address& address) {
    return finish<Reply>(id, address, parts_.context.deadline(), nullptr);
  }

  /// Of an operation that may have to wait for a lease to end; `wait` says what for.
  template <class Reply>
  Outcome<Reply> finish_wait(std::uint64_t id, WaitEdge wait, const Patience& patience) {
    // The working memory knows the reason of a timeout, so its reply is given time to arrive.
    constexpr std::chrono::seconds grace{1};
    wait.waiter = parts_.context.client();
    wait.number = patience.number;
    wait.since = parts_.context.now();
    return finish<Reply>(id, wait.address, patience.at_most + grace, &wait);
  }

  /// Calls `done` after every message that arrives until it returns true. Nothing on success.
  /// @param wait what the component waits for, if that could be part of a cycle; may be empty
  std::optional<Failure> wait_until(const std::function<bool()>& done, Clock::time_point until,
                                    const std::function<std::optional<WaitEdge>()>& wait);

  /// Releases a lease. While the component stops, without waiting for the answer.
  Outcome<Acknowledged> try_unlock(const Address& address, LeaseToken token);

  /// Logs that the component executes an action from now on.
  void note_execution(const std::string& type, const Address& action) {
    if (recorder_)
      recorder_->executes(type, action);
  }

  /// To the own working memory, without an answer.
  template <class Message>
  void send(Message&& x) {
    parts_.actor.send(working_memory(), std::forward<Message>(x));
  }

  /// The working memory offers the lease that the component waits for.
  void claim(const LeaseOffer& offer);

  /// Handles a search for a cycle of waits of which this component may be a part.
  void receive_probe(DeadlockProbe probe);

  /// Outcome in a reply, or a failure if there is none.
  template <class Result>
  Result take(caf::mailbox_element& x, const Address& address) {
    auto& content = x.content();
    if (content.match_elements<Result>())
      return content.get_as<Result>(0);
    return unexpected_reply(content, address);
  }

private:
  const WorkingMemoryActor& working_memory() const { return parts_.context.working_memory(); }

  /// Only with a simulated clock.
  bool is_one_at_a_time() const;

  /// Throws unless operations are possible now.
  void check_may_operate() const;

  template <class Reply>
  Outcome<Reply> finish(std::uint64_t id, const Address& address, std::chrono::nanoseconds patience,
                        const WaitEdge* wait) {
    auto content = wait_for(id, address, patience, wait);
    if (!content)
      return content.failure();
    auto result = take<Outcome<Reply>>(**content, address);
    if (recorder_)
      recorder_->end(id, result);
    return result;
  }

  Outcome<caf::mailbox_element_ptr> wait_for(std::uint64_t id, const Address& address,
                                             std::chrono::nanoseconds patience,
                                             const WaitEdge* wait);
  /// Throws std::logic_error if the component shares its threads.
  void check_may_wait(const std::string& what) const;
  Failure unexpected_reply(const caf::type_erased_tuple& content, const Address& address);

  /// Lets the runtime and those who watch the component see that it still does something.
  void show_progress();

  Parts parts_;
  EntryReader reader_;
  UnansweredRequests unanswered_;
  /// Number of entries read without a message.
  std::uint64_t read_here_ = 0;
  /// Set if operations are logged.
  std::optional<OperationRecorder> recorder_;
  WaitNumber last_wait_ = 0;
  /// See settle; 0 for none.
  std::uint64_t settled_ = 0;
  /// What the component waits for now, if that could be a cycle.
  std::optional<WaitEdge> waiting_;
  /// The wait cycle that was found; empty for none.
  std::string deadlock_;
};

} // namespace castor
