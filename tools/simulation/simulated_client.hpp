#pragma once

#include "castor/tools/simulation/recorder.hpp"
#include "castor/tools/simulation/seen.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/event_based_actor.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace castor::linearizability {

/// What everybody in one simulation shares. All of it runs on one thread.
struct SimulatedWorld {
  struct WorkingMemory {
    std::string subarchitecture;
    WorkingMemoryActor actor;
  };
  struct SimulatedEntry {
    Address address;
    /// Whose it is.
    std::size_t owner = 0;
    /// The last that anybody was told.
    Token last_token = 0;
  };

  SimulatedWorld(std::uint64_t seed, Timestamp lease_duration)
    : random(seed), recorder(lease_duration) {}

  std::size_t pick(std::size_t count) { return random() % count; }
  bool chance(unsigned percent) { return pick(100) < percent; }
  void find(std::string what) { findings.push_back(std::move(what)); }

  std::mt19937_64 random;
  Recorder recorder;
  std::vector<WorkingMemory> working_memories;
  std::vector<SimulatedEntry> entries;
  /// Operations that the clients may still begin.
  std::size_t operations_left = 0;
  std::int64_t stamps = 0;
  Client last_client = 0;
  /// Components by number.
  std::vector<ClientPtr> identities{nullptr};
  std::vector<caf::actor> alive;
  /// Those of whom not every working memory need have heard that they died.
  std::vector<ClientPtr> dead;
  /// Writes that were made in one.
  std::vector<std::vector<Recorder::Index>> batches;
  /// What is wrong, other than what the checker finds.
  std::vector<std::string> findings;
};

/// How a client behaves, other than well.
struct Temper {
  /// Goes through any working memory, not only its own.
  bool roams = false;
  /// Never renews its leases.
  bool negligent = false;
  /// Gives up waiting.
  bool impatient = false;
  /// Shows old tokens and guessed versions.
  bool forges = false;
  /// Dies in the middle.
  bool mortal = false;
};

/// What a client believes of an entry.
struct EntryView {
  std::optional<Version> seen;
  bool present = false;
  /// In hand, and obtained so often.
  Token token = 0;
  std::size_t times = 0;
  /// A lock was never answered: it may have obtained the lease once more than it knows.
  bool unsure = false;
  /// Of leases it had.
  std::vector<Token> old_tokens;
  /// Of these, those that were given back.
  std::vector<Token> returned_tokens;
};

struct SimulatedClientParts {
  SimulatedWorld* world = nullptr;
  std::string component;
  std::uint64_t incarnation = 1;
  /// Index of its working memory.
  std::size_t home = 0;
  Temper temper;
  /// What it remembers of its former life.
  std::vector<EntryView> views;
};

/// A component, as working memories see it: sends operations, several at a time, keeps the versions
/// it has seen and the tokens in hand. What it does next follows from the world's random numbers.
class SimulatedClient : public caf::event_based_actor {
public:
  SimulatedClient(caf::actor_config& config, SimulatedClientParts parts);

  const char* name() const override { return "simulated client"; }

  static void spawn(caf::actor_system& system, SimulatedClientParts parts);

  /// Nothing more will come: it settles what it has not been answered.
  static void let_rest(const caf::actor& client);

protected:
  caf::behavior make_behavior() override;

  /// The way to a working memory, by index; null if there is none now.
  virtual WorkingMemoryActor way_to(std::size_t working_memory) const {
    return world_.working_memories[working_memory].actor;
  }
  /// How long it waits for an answer. For ever means that there has to be one.
  virtual caf::duration deadline() const { return caf::infinite; }
  /// Before its next operations.
  virtual Timestamp pause() { return Timestamp{0}; }

  SimulatedWorld& world() { return world_; }
  const SimulatedClientParts& parts() const { return parts_; }
  Client number() const { return number_; }

  /// Begins to operate, or goes on.
  void go_on();
  /// Whatever it sends from now on does not count.
  void end_of_life();

private:
  using Index = Recorder::Index;

  /// From one client, through one working memory, to one working memory: first come, first served.
  struct Route {
    std::size_t via = 0;
    std::size_t owner = 0;
    bool operator==(const Route&) const = default;
  };

  /// An operation that was not answered yet.
  struct Outstanding {
    /// Rises with every message of the client.
    std::uint64_t number = 0;
    Route route;
    std::vector<Index> records;
    WaitNumber wait = 0;
    /// The message by which it was given up; 0 if it was not.
    std::uint64_t given_up_by = 0;
    Tick given_up_at = never;
  };

  /// A lease that was given up before its grant was known.
  struct Unwanted {
    std::uint32_t entry = 0;
    Token token = 0;
    Route route;
    std::uint64_t given_up_by = 0;
  };

  // -- what to do
  void step();
  void act();
  bool is_waiting() const;
  void rest();
  void die();
  OperationKind pick_kind(const EntryView& view);
  std::optional<Version> version_to_show(const EntryView& view);
  Token token_to_show(std::uint32_t entry);

  // -- operations
  void begin(std::uint32_t entry, OperationKind kind);
  void write(std::uint32_t entry, OperationKind kind);
  void write_several();
  void read_all();
  void lock(OperationRecord x);
  void unlock(const OperationRecord& x);
  void renew();
  /// Whether it may hold a lease of the entry of which it does not know.
  bool may_hold_unawares(std::uint32_t entry) const;
  void give_up_something();
  OperationRecord planned_write(std::uint32_t entry, OperationKind kind);
  WriteRequest request_for(const OperationRecord& x) const;
  Patience patience(WaitNumber number);
  Route route_to(std::uint32_t entry);

  /// Sends an operation; `answered` gets the answer and the operation as it was outstanding.
  template <class Reply, class Request, class F>
  void ask(Route route, const Request& request, std::vector<Index> records, WaitNumber wait,
           F answered);
  Outstanding take_outstanding(std::uint64_t number, bool arrived);
  void not_answered(std::uint64_t number, const caf::error& e);

  // -- what came of it
  void wrote(Index record, Version version);
  void obtained(const Outstanding& x, Token token);
  void lost(EntryView& view);
  void failed(Index record, const Failure& failure);

  SimulatedWorld& world_;
  SimulatedClientParts parts_;
  Client number_;
  ClientPtr identity_;
  std::vector<EntryView> views_;
  std::deque<Outstanding> outstanding_;
  std::vector<Unwanted> unwanted_;
  std::uint64_t sent_ = 0;
  WaitNumber last_wait_ = 0;
  /// Whether it will go on without an answer.
  bool stepping_ = false;
};

} // namespace castor::linearizability
