#pragma once

#include "castor/tools/simulation/entry_view.hpp"
#include "castor/tools/simulation/operation_choice.hpp"
#include "castor/tools/simulation/outstanding_operations.hpp"
#include "castor/tools/simulation/seen.hpp"
#include "castor/tools/simulation/simulated_world.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/event_based_actor.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::linearizability {

struct SimulatedClientParts {
  SimulatedWorld* world = nullptr;
  std::string component;
  std::uint64_t incarnation = 1;
  /// Index of its working memory.
  std::size_t home = 0;
  ClientTraits traits;
  /// Its views of entries from its former incarnation.
  std::vector<EntryView> views;
};

/// A client of working memories: sends operations, several at a time, and keeps the versions it has
/// seen and its current tokens. Its next operation is drawn from the world's random numbers.
class SimulatedClient : public caf::event_based_actor {
public:
  SimulatedClient(caf::actor_config& config, SimulatedClientParts parts);

  const char* name() const override { return "simulated client"; }

  static void spawn(caf::actor_system& system, SimulatedClientParts parts);

  /// No more answers will come: settles the client's unanswered operations.
  static void let_rest(const caf::actor& client);

protected:
  caf::behavior make_behavior() override;

  /// Actor of a working memory, by index; null if it cannot be reached now.
  virtual WorkingMemoryActor way_to(std::size_t working_memory) const {
    return world_.working_memories[working_memory].actor;
  }
  /// Time limit for an answer. Infinite means that an answer must come.
  virtual caf::duration deadline() const { return caf::infinite; }
  /// Pause before its next operations.
  virtual Timestamp pause() { return Timestamp{0}; }

  SimulatedWorld& world() { return world_; }
  const SimulatedClientParts& parts() const { return parts_; }
  Client number() const { return number_; }

  /// Begins or continues to operate.
  void go_on();
  /// Records nothing that it does from now on.
  void end_of_life();

private:
  using Index = Recorder::Index;

  // -- what to do
  void step();
  void act();
  void rest();
  void die();

  // -- operations
  void begin(std::uint32_t entry, OperationKind kind);
  void write(std::uint32_t entry, OperationKind kind);
  void read(std::uint32_t entry);
  /// Without a message. False if the working memory has to be asked.
  bool read_here(std::uint32_t entry);
  void write_several();
  void read_all();
  OperationRecord planned_write(std::uint32_t entry, OperationKind kind);
  WriteRequest request_for(const OperationRecord& x) const;
  Patience patience(WaitNumber number);
  Route route_to(std::uint32_t entry);

  /// Sends an operation; `answered` gets the outstanding operation and its answer.
  template <class Reply, class Request, class F>
  void ask(Route route, const Request& request, std::vector<Index> records, WaitNumber wait,
           F answered);
  void not_answered(std::uint64_t number, const caf::error& e);

  // -- leases
  void lock(OperationRecord x);
  void unlock(const OperationRecord& x);
  void obtained(const Outstanding& x, Token token);
  void claim(const LeaseOffer& offer);
  void renew();
  void renewal_answered(const std::vector<std::pair<std::uint32_t, Token>>& renewed, Timestamp sent,
                        const RenewReply& answer);
  /// Whether it may hold a lease of the entry without knowing.
  bool may_hold_unawares(std::uint32_t entry) const;
  void give_up_something();

  // -- what came of it
  void wrote(Index record, Version version);
  void was_read(Index record, const Entry& entry);
  void failed(Index record, const Failure& failure);

  SimulatedWorld& world_;
  SimulatedClientParts parts_;
  Client number_;
  ClientPtr identity_;
  std::vector<EntryView> views_;
  OperationChoice choice_;
  OutstandingOperations outstanding_;
  WaitNumber last_wait_ = 0;
  /// Whether its next step is already scheduled.
  bool stepping_ = false;
};

template <class Reply, class Request, class F>
void SimulatedClient::ask(Route route, const Request& message, std::vector<Index> records,
                          WaitNumber wait, F answered) {
  auto number = outstanding_.add(route, std::move(records), wait);
  request(way_to(route.via), deadline(), message)
    .then(
      [this, number, answered](const Outcome<Reply>& x) {
        auto arrived = x || x.failure().kind != FailureKind::working_memory_lost;
        answered(outstanding_.take(number, arrived), x);
        if (!outstanding_.is_awaited())
          go_on();
      },
      [this, number](const caf::error& e) { not_answered(number, e); });
}

} // namespace castor::linearizability
