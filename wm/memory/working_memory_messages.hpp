#pragma once

#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/events/change_notice.hpp"
#include "castor/wm/events/event_flow.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/journal/journal_mode.hpp"
#include "castor/wm/store/type_query.hpp"
#include "castor/wm/store/usage_log.hpp"
#include "castor/wm/store/write_request.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Messages between components and working memories, and among working memories. Plain structs
/// without actors: `working_memory_protocol.hpp` says which are sent and answered.
namespace castor {

/// Several writes, of different entries of one working memory: all of them or none.
struct BatchRequest {
  std::string subarchitecture;
  std::vector<WriteRequest> writes;
};

/// One of a client's operations that may have to wait for a lease to end; the number is the
/// client's own and never used twice.
struct Patience {
  ClientPtr client;
  WaitNumber number = 0;
  /// How long, at most.
  Timestamp at_most{0};
};

struct ReadRequest {
  Address address;
  Patience patience;
};

/// Reads the entries that a query finds, all as they stand at one moment.
struct QueryRequest {
  TypeQuery query;
  Patience patience;
};

/// Asks for a lease; with no patience at all it is refused rather than waited for.
struct LockRequest {
  Address address;
  LockLevel level = LockLevel::o;
  Patience patience;
  /// Whether the sender answers a LeaseOffer with ClaimLease. Within a process only: over a link
  /// that would be one more round trip.
  bool claims = false;
};

/// To a component that waits for a lease: the entry is free, and others may get the lease before.
struct LeaseOffer {
  Address address;
  WaitNumber number = 0;
};

/// The client is awake and takes the lease, now or when it ends next.
struct ClaimLease {
  Address address;
  ClientPtr client;
  WaitNumber number = 0;
};

/// Gives back what one lock request obtained.
struct UnlockRequest {
  Address address;
  ClientPtr client;
  LeaseToken token = 0;
};

/// The client waits no longer; if it was granted the lease meanwhile, it does not want it.
struct CancelWait {
  Address address;
  ClientPtr client;
  WaitNumber number = 0;
};

struct HeldToken {
  std::string id;
  LeaseToken token = 0;
};

/// On behalf of living clients: they still need these leases.
struct RenewRequest {
  ClientPtr client;
  std::vector<HeldToken> leases;
};

/// Which of the leases are not the client's any more.
struct RenewReply {
  std::vector<HeldToken> lost;
};

struct LockQuery {
  Address address;
};

/// Who holds a lease of an entry, if anybody does.
struct LockStatus {
  std::optional<LockLevel> level;
  ClientPtr holder;
  /// 0 for no lease.
  LeaseToken token = 0;
  /// How many wait for it.
  std::uint64_t waiting = 0;
};

/// A query without a client is permitted: it is the runtime's own.
struct ExistsQuery {
  Address address;
  ClientPtr client = {};
};

/// The same.
struct VersionQuery {
  Address address;
  ClientPtr client = {};
};

/// A component gets its events in two streams, each as fast as it takes them, so that those its
/// runtime itself has to hear of need not wait behind others.
enum class EventStream : std::uint8_t {
  /// For the component's own code, when that has time.
  component,
  /// For its runtime, at once.
  runtime,
};

/// The sender wants the events that match, from the moment it is answered.
struct Subscribe {
  FilterId id = 0;
  ChangeFilter filter;
  EventStream stream = EventStream::component;
  /// How many events of the stream may wait for the sender one by one; its first filter counts.
  std::uint32_t queue_limit = standard_queue_limit;
  /// The component that the sender is; empty for none, whose events are not logged as accesses.
  std::string component = {};
};

struct Unsubscribe {
  FilterId id = 0;
};

/// To a component, or from one working memory to another: the events of one write. The filters are
/// numbered by the receiver: as FilterId by a component, as InterestId by a working memory.
struct ChangeNotices {
  EventFlow::Batch notices;
};

/// The sender has delivered or dropped so many of the events that it was sent; without that it is
/// sent no more once its queue limit is reached.
struct EventsTaken {
  EventStream stream = EventStream::component;
  std::uint64_t count = 0;
};

/// A working memory's name for something that its components want of the others.
using InterestId = std::uint32_t;
using InterestIds = FilterIds;

/// From one working memory to another: somebody in `subarchitecture` wants such events, or nobody
/// does any more.
struct Interest {
  std::string subarchitecture;
  InterestId id = 0;
  ChangeFilter filter;
  bool wanted = true;
};

/// An event on a route: which interests of which subarchitectures' working memories it meets. That
/// is more than a ChangeNotice, which has one receiver: a process with several working memories is
/// sent one copy, and only it knows which actors these are. There each gets its ChangeNotices.
struct RoutedEvent {
  ChangeEventPtr event;
  std::vector<std::pair<std::string, InterestIds>> receivers;
};

/// From a working memory to those in another process that want them: the events of one write. The
/// way there acknowledges them with EventsTaken.
struct RoutedEvents {
  std::vector<RoutedEvent> events;
};

/// How many events may be on a route and not acknowledged.
inline constexpr std::uint32_t route_limit = 4096;

struct Acknowledged {};

struct StatusQuery {};

/// To a working memory from itself: something may be due.
struct WakeUp {};

/// To a working memory, on purpose: its clock goes forward, or back.
struct JumpClock {
  Timestamp by{0};
};

/// How a working memory's journal is doing.
struct JournalStatus {
  JournalMode mode = JournalMode::off;
  /// What its file takes.
  std::uint64_t bytes = 0;
  /// Changes that are not safe from a power cut yet, and what waits to be said until they are.
  std::uint64_t unsynced = 0;
  std::uint64_t held = 0;
  /// How often changes were synced; those of many writes at once.
  std::uint64_t syncs = 0;
  /// How often acknowledged changes may have been lost, which numbers are then not used again for.
  std::uint64_t incarnation = 0;
  /// Why there is none any more.
  std::string failure = {};
};

/// How a working memory is doing.
struct WorkingMemoryStatus {
  std::string subarchitecture;
  std::uint64_t entries = 0;
  std::map<std::string, std::uint64_t> entries_by_type;
  std::uint64_t filters = 0;
  /// Changes made here.
  std::uint64_t events = 0;
  /// When the last one was made.
  Timestamp last_event{0};
  /// Events that components of this subarchitecture want, one per component and event.
  std::uint64_t matched = 0;
  /// Events sent to components of this subarchitecture, one per component and event.
  std::uint64_t delivered = 0;
  /// Those of them that stand for several.
  std::uint64_t coalesced = 0;
  /// Events that others stand for, or that were undone before they could be sent.
  std::uint64_t suppressed = 0;
  /// Events that wait now until a component has taken others.
  std::uint64_t backlog = 0;
  /// Events sent to other working memories, one per working memory and event.
  std::uint64_t forwarded = 0;
  /// Events sent to other processes, one per process and event.
  std::uint64_t routed = 0;
  /// Operations refused.
  std::uint64_t refused = 0;
  /// Leases held now, and operations that wait for one to end.
  std::uint64_t leases = 0;
  std::uint64_t waiting = 0;
  JournalStatus journal;
};

/// Asks who uses what.
struct UsageQuery {};

struct UsageReport {
  std::vector<Usage> usages;
};

} // namespace castor
