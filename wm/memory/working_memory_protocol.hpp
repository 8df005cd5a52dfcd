#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/journal/journal_fault.hpp"
#include "castor/wm/journal/journal_news.hpp"
#include "castor/wm/leases/deadlock_probe.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

/// The typed interface of working memories: requests, replies and messages without a reply.
namespace castor {

/// The working memories of the other subarchitectures. May come again when some were added to the
/// system or removed from it; those that are not here any more are forgotten. Answered once the new
/// ones know what is wanted of them.
struct Peers {
  std::map<std::string, caf::strong_actor_ptr> working_memories;
  /// What takes RoutedEvents to them, for those in other processes: the same for all of a process.
  std::map<std::string, caf::strong_actor_ptr> routes = {};
  /// Subarchitectures whose components may write here from now on; "*" for all.
  std::set<std::string> writers = {};
  /// Subarchitectures of the system whose working memories are not there at the moment.
  std::set<std::string> absent = {};
};

/// Every operation names the address; the working memory of another subarchitecture is reached
/// through the own one.
using WorkingMemoryActor = caf::typed_actor<
  // Changes an entry; answers its new version (of a deleted one: the last).
  caf::replies_to<WriteRequest>::with<Outcome<Version>>,
  // Changes several entries at once; answers their new versions.
  caf::replies_to<BatchRequest>::with<Outcome<std::vector<Version>>>,
  // Answers the entry at an address, once it is not leased at level ODR.
  caf::replies_to<ReadRequest>::with<Outcome<EntryPtr>>,
  // Answers the entries of a type, the most recently written first, once none of them is leased at
  // level ODR.
  caf::replies_to<QueryRequest>::with<Outcome<std::vector<EntryPtr>>>,
  // Answers whether there is an entry at an address.
  caf::replies_to<ExistsQuery>::with<Outcome<bool>>,
  // Answers an entry's version, also after its deletion.
  caf::replies_to<VersionQuery>::with<Outcome<Version>>,
  // Answers the lease, once it is the sender's turn.
  caf::replies_to<LockRequest>::with<Outcome<Lease>>,
  // Gives a lease back.
  caf::replies_to<UnlockRequest>::with<Outcome<Acknowledged>>,
  // Takes the lease that the sender was offered.
  caf::reacts_to<ClaimLease>,
  // Ends a wait of the sender.
  caf::reacts_to<CancelWait>,
  // Extends leases; answers which are lost.
  caf::replies_to<RenewRequest>::with<RenewReply>,
  // Answers who holds the lease of an entry.
  caf::replies_to<LockQuery>::with<Outcome<LockStatus>>,
  // Looks for a cycle of waits.
  caf::reacts_to<DeadlockProbe>,
  // The working memory's own alarm clock.
  caf::reacts_to<WakeUp>,
  // A fault on purpose.
  caf::reacts_to<JumpClock>,
  // A fault to inject into its journal.
  caf::reacts_to<JournalFault>,
  // Registers a filter of the sender; answers once it is in force in every working memory
  // concerned.
  caf::replies_to<Subscribe>::with<Outcome<Acknowledged>>,
  // Withdraws a filter of the sender.
  caf::reacts_to<Unsubscribe>,
  // Lets the sender be sent as many events more.
  caf::reacts_to<EventsTaken>,
  // Another working memory says what its subarchitecture wants; refused if that may not read here.
  caf::replies_to<Interest>::with<Outcome<Acknowledged>>,
  // Changes in another subarchitecture that somebody here wants to hear of.
  caf::reacts_to<ChangeNotices>,
  // Introduces the other working memories.
  caf::replies_to<Peers>::with<Acknowledged>,
  // The journal says what is on disk.
  caf::reacts_to<JournalNews>,
  // Answers how it is doing.
  caf::replies_to<StatusQuery>::with<WorkingMemoryStatus>,
  // Answers what was done with the entries here, and which events of others were told here.
  caf::replies_to<UsageQuery>::with<UsageReport>>;

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::WriteRequest)
CASTOR_LOCAL_MESSAGE(castor::ReadRequest)
CASTOR_LOCAL_MESSAGE(castor::BatchRequest)
CASTOR_LOCAL_MESSAGE(castor::QueryRequest)
CASTOR_LOCAL_MESSAGE(castor::LockRequest)
CASTOR_LOCAL_MESSAGE(castor::UnlockRequest)
CASTOR_LOCAL_MESSAGE(castor::LeaseOffer)
CASTOR_LOCAL_MESSAGE(castor::ClaimLease)
CASTOR_LOCAL_MESSAGE(castor::CancelWait)
CASTOR_LOCAL_MESSAGE(castor::RenewRequest)
CASTOR_LOCAL_MESSAGE(castor::RenewReply)
CASTOR_LOCAL_MESSAGE(castor::LockQuery)
CASTOR_LOCAL_MESSAGE(castor::DeadlockProbe)
CASTOR_LOCAL_MESSAGE(castor::WakeUp)
CASTOR_LOCAL_MESSAGE(castor::JumpClock)
CASTOR_LOCAL_MESSAGE(castor::ExistsQuery)
CASTOR_LOCAL_MESSAGE(castor::VersionQuery)
CASTOR_LOCAL_MESSAGE(castor::Subscribe)
CASTOR_LOCAL_MESSAGE(castor::Unsubscribe)
CASTOR_LOCAL_MESSAGE(castor::ChangeNotice)
CASTOR_LOCAL_MESSAGE(castor::ChangeNotices)
CASTOR_LOCAL_MESSAGE(castor::EventsTaken)
CASTOR_LOCAL_MESSAGE(castor::Interest)
CASTOR_LOCAL_MESSAGE(castor::RoutedEvents)
CASTOR_LOCAL_MESSAGE(castor::Peers)
CASTOR_LOCAL_MESSAGE(castor::Acknowledged)
CASTOR_LOCAL_MESSAGE(castor::StatusQuery)
CASTOR_LOCAL_MESSAGE(castor::WorkingMemoryStatus)
CASTOR_LOCAL_MESSAGE(castor::UsageQuery)
CASTOR_LOCAL_MESSAGE(castor::UsageReport)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Version>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::EntryPtr>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<std::vector<castor::EntryPtr>>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<std::vector<castor::Version>>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Lease>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::LockStatus>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<bool>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Acknowledged>)
