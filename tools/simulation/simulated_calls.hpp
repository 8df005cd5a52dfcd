#pragma once

#include "castor/actors/component/call_types.hpp"
#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/served_calls.hpp"
#include "castor/tools/simulation/happenings.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/event_based_actor.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::simulation {

/// What a simulated call asks, and what it gets.
struct Question {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Question, number)

struct Reply {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Reply, number)

/// To the component itself, when time is over for a call.
struct CallTimeout {
  std::string id;
};

/// What all simulated calls of a system share.
struct CallLedger {
  /// Calls that components may still make.
  std::size_t calls_left = 0;
  std::int64_t last_question = 0;
  /// Which calls were taken, by the number of the life of the working memory that says so: a call
  /// is taken once in each.
  std::set<std::pair<std::string, std::uint64_t>> taken;
  Happenings happened;
  /// What is wrong.
  std::function<void(std::string)> find;
  /// What happened, as a part of what the same seed gives again.
  std::function<void(const std::string&)> note;
};

/// The calls over working memory of one simulated component: writes the entries that
/// castor::Calls writes, and deletes those that it deletes, without waiting anywhere.
class SimulatedCalls {
public:
  struct Parts {
    caf::event_based_actor* self = nullptr;
    CallLedger* ledger = nullptr;
    WorkingMemoryActor home;
    ClientPtr client;
  };

  using Answered = std::function<void(bool)>;

  SimulatedCalls(Parts parts, NeighboursPtr neighbours)
    : parts_(std::move(parts)), neighbours_(std::move(neighbours)) {}

  /// Registers its filters; `done` once all are registered, or one could not be.
  void begin(const std::function<void(bool)>& done);

  /// Others have come or gone.
  void meet(NeighboursPtr neighbours);

  /// Calls whoever serves in a subarchitecture; `answered` says whether there was a reply.
  void call(const std::string& subarchitecture, Answered answered);

  /// An event that one of its filters wants.
  void take(const ChangeNotice& x);

  /// Time is over for a call.
  void time_out(const std::string& id);

private:
  struct Open {
    std::string subarchitecture;
    std::int64_t question = 0;
    /// The server is done with it.
    bool is_done = false;
    Answered answered;
  };

  Address here(const std::string& id) const { return {parts_.client->subarchitecture, id}; }
  WriteRequest write(Operation operation, Address address, Value value = {}) const;
  /// Sends to the own working memory; `then` gets the outcome, or null if none came in time.
  template <class T, class Request, class F>
  void ask(const Request& request, F then);

  // -- the calling side
  void note_progress(const ChangeEvent& event);
  void read_reply(const std::string& id);
  void settle(const std::string& id, const char* failure);

  // -- the serving side
  void serve(const Address& call);
  void answer(const Address& call_at, const Call& call, Version version);
  void finish(const Address& call);
  void clean_up();

  const Parts parts_;
  NeighboursPtr neighbours_;
  std::uint64_t last_call_ = 0;
  std::map<std::string, Open> open_;
  ServedCalls served_;
};

} // namespace castor::simulation

CASTOR_LOCAL_MESSAGE(castor::simulation::CallTimeout)
