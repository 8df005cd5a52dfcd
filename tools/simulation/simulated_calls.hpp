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

/// Request and reply of a simulated call.
struct Question {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Question, number)

struct Reply {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Reply, number)

/// To the component itself: the timeout of a call is over.
struct CallTimeout {
  std::string id;
};

/// State shared by all simulated calls of a system.
struct CallLedger {
  /// Calls that components may still make.
  std::size_t calls_left = 0;
  std::int64_t last_question = 0;
  /// Calls that were accepted by a server, with the number of the working memory's incarnation:
  /// each may be accepted once in each incarnation.
  std::set<std::pair<std::string, std::uint64_t>> taken;
  Happenings happened;
  /// Adds a finding.
  std::function<void(std::string)> find;
  /// Adds an occurrence to the digest, which is the same for the same seed.
  std::function<void(const std::string&)> note;
};

/// The calls over working memory of one simulated component: writes and deletes the same entries as
/// castor::Calls, without blocking.
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

  /// Registers its filters; calls `done` when all are registered or one has failed.
  void begin(const std::function<void(bool)>& done);

  /// The set of neighbours has changed.
  void meet(NeighboursPtr neighbours);

  /// Makes a call to a subarchitecture; `answered` gets whether there was a reply.
  void call(const std::string& subarchitecture, Answered answered);

  /// Handles an event that matches one of its filters.
  void take(const ChangeNotice& x);

  /// Handles the timeout of a call.
  void time_out(const std::string& id);

private:
  struct Open {
    std::string subarchitecture;
    std::int64_t question = 0;
    /// The server has finished it.
    bool is_done = false;
    Answered answered;
  };

  Address here(const std::string& id) const { return {parts_.client->subarchitecture, id}; }
  WriteRequest write(Operation operation, Address address, Value value = {}) const;
  /// Sends a request to its own working memory; `then` gets the outcome, or null if none came in
  /// time.
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
