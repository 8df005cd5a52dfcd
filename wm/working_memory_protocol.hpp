#pragma once

#include "castor/wm/caf.hpp"
#include "castor/wm/change_event.hpp"
#include "castor/wm/change_filter.hpp"
#include "castor/wm/entry.hpp"
#include "castor/wm/entry_store.hpp"
#include "castor/wm/failure.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// What is said between components and working memories, and among working memories.
namespace castor {

/// A component's name for one of its filters.
using FilterId = std::uint32_t;

struct ReadRequest {
  Address address;
};

struct ExistsQuery {
  Address address;
};

struct VersionQuery {
  Address address;
};

/// The sender wants the events that match, from the moment it is answered.
struct Subscribe {
  FilterId id = 0;
  ChangeFilter filter;
};

struct Unsubscribe {
  FilterId id = 0;
};

/// To a component: an event, and which of its filters want it.
struct ChangeNotice {
  ChangeEventPtr event;
  std::vector<FilterId> filters;
};

/// From one working memory to another: somebody in `subarchitecture` wants such events, or nobody
/// does any more.
struct Interest {
  std::string subarchitecture;
  ChangeFilter filter;
  bool wanted = true;
};

/// From one working memory to another that wants the event.
struct ForwardedEvent {
  ChangeEventPtr event;
  /// What the filters there are matched against.
  Value content;
};

/// The working memories of the other subarchitectures.
struct Peers {
  std::map<std::string, caf::strong_actor_ptr> working_memories;
};

struct Acknowledged {};

struct StatusQuery {};

/// How a working memory is doing.
struct WorkingMemoryStatus {
  std::string subarchitecture;
  std::uint64_t entries = 0;
  std::map<std::string, std::uint64_t> entries_by_type;
  std::uint64_t filters = 0;
  /// Changes made here.
  std::uint64_t events = 0;
  /// Events sent to components of this subarchitecture, one per component and event.
  std::uint64_t delivered = 0;
  /// Events sent to other working memories, one per working memory and event.
  std::uint64_t forwarded = 0;
  /// Operations refused.
  std::uint64_t refused = 0;
};

/// Every operation names the address; the working memory of another subarchitecture is reached
/// through the own one.
using WorkingMemoryActor = caf::typed_actor<
  // Changes an entry; answers its new version (of a deleted one: the last).
  caf::replies_to<WriteRequest>::with<Outcome<Version>>,
  // Answers the entry at an address.
  caf::replies_to<ReadRequest>::with<Outcome<EntryPtr>>,
  // Answers the entries of a type, the most recently written first.
  caf::replies_to<TypeQuery>::with<Outcome<std::vector<EntryPtr>>>,
  // Answers whether there is an entry at an address.
  caf::replies_to<ExistsQuery>::with<Outcome<bool>>,
  // Answers an entry's version, also after its deletion.
  caf::replies_to<VersionQuery>::with<Outcome<Version>>,
  // Registers a filter of the sender; answers once it is in force in every working memory
  // concerned.
  caf::replies_to<Subscribe>::with<Outcome<Acknowledged>>,
  // Withdraws a filter of the sender.
  caf::reacts_to<Unsubscribe>,
  // Another working memory says what its subarchitecture wants.
  caf::replies_to<Interest>::with<Acknowledged>,
  // A change in another subarchitecture that somebody here wants to hear of.
  caf::reacts_to<ForwardedEvent>,
  // Introduces the other working memories.
  caf::replies_to<Peers>::with<Acknowledged>,
  // Answers how it is doing.
  caf::replies_to<StatusQuery>::with<WorkingMemoryStatus>>;

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::WriteRequest)
CASTOR_LOCAL_MESSAGE(castor::ReadRequest)
CASTOR_LOCAL_MESSAGE(castor::TypeQuery)
CASTOR_LOCAL_MESSAGE(castor::ExistsQuery)
CASTOR_LOCAL_MESSAGE(castor::VersionQuery)
CASTOR_LOCAL_MESSAGE(castor::Subscribe)
CASTOR_LOCAL_MESSAGE(castor::Unsubscribe)
CASTOR_LOCAL_MESSAGE(castor::ChangeNotice)
CASTOR_LOCAL_MESSAGE(castor::Interest)
CASTOR_LOCAL_MESSAGE(castor::ForwardedEvent)
CASTOR_LOCAL_MESSAGE(castor::Peers)
CASTOR_LOCAL_MESSAGE(castor::Acknowledged)
CASTOR_LOCAL_MESSAGE(castor::StatusQuery)
CASTOR_LOCAL_MESSAGE(castor::WorkingMemoryStatus)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Version>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::EntryPtr>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<std::vector<castor::EntryPtr>>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<bool>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Acknowledged>)
