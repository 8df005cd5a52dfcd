#include "castor/actors/node/messages.hpp"

#include "castor/actors/node/clock_protocol.hpp"
#include "castor/actors/node/part_wire.hpp"
#include "castor/actors/node/types_protocol.hpp"

namespace castor {

const WireTable& system_messages() {
  static const auto result = WireTable::of<
    // Operations on working memory
    WriteRequest, Outcome<Version>, BatchRequest, Outcome<std::vector<Version>>, ReadRequest,
    Outcome<EntryPtr>, QueryRequest, Outcome<std::vector<EntryPtr>>, ExistsQuery, Outcome<bool>,
    VersionQuery, LockRequest, Outcome<Lease>, UnlockRequest, Outcome<Acknowledged>, CancelWait,
    RenewRequest, RenewReply, LockQuery, Outcome<LockStatus>, DeadlockProbe, StatusQuery,
    WorkingMemoryStatus, UsageQuery, UsageReport,
    // Events
    Subscribe, Unsubscribe, ChangeNotice, ChangeNotices, EventsTaken, Interest, Acknowledged,
    RoutedEvents,
    // Components
    EnterPhase, PhaseDone, ProposeTask, RetractTask, CompleteTask, TaskDecided, PullRequest,
    Outcome<Value>, PushRequest, Pushed, PushesTaken, CommandTermsQuery, Outcome<CommandTermsReply>,
    CommandMessage, CommandDone, Outcome<CommandDone>,
    // Parts of a system
    PartPlan, PartMade, JoinParts, RestartComponent, ComponentEnded, ComponentHangs,
    InjectComponentFault, ComponentFault, InjectLinkFault, JumpClock, JournalFault, FaultHappened,
    PartStatusQuery, PartStatus, EndSystem, TaskEvent, TypesQuery, TypesReport, ClockAdvance,
    ClockReportFrom>();
  return result;
}

} // namespace castor
