#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/runtime/action_parts.hpp"
#include "castor/actors/runtime/executed_actions.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace castor {

class ActionExecution;
class SubarchitectureComponent;
struct ChangeEvent;

/// Executes the actions that one component offers: accepts those that are proposed, calls the
/// component's handlers, and writes the results.
class ActionExecutor {
public:
  ActionExecutor(SubarchitectureComponent& component, const ActionParts& parts)
    : component_(component), parts_(parts) {}

  void offer(const TypeDescriptor& type, ActionOffer offer, Actions::Handler handler);

private:
  struct Offered {
    ActionOffer offer;
    Actions::Handler handler;
    /// Whether its actions have a field `priority`.
    bool has_priorities = false;
  };

  void listen();
  void note_change(const ChangeEvent& event);
  void note_deletion(const Address& entry);
  /// Wakes a handler that waits, so that it looks at its action.
  void wake_handler();
  void work_later();

  /// Proposes the actions of these types that wait in all working memories, and ends those that
  /// this component, or the one it replaces, had accepted and does not execute.
  void scan(const std::set<std::string>& types);
  void scan(const std::string& subarchitecture, const std::set<std::string>& types);
  /// An action as it is found: it is proposed, or ended if it is accepted here and not executed.
  void take_up(const Address& address, const Action& action);
  void resolve_doubtful();
  void write_pending_results();
  void write_result(const Address& address, const Action& result);

  void propose(const Address& address, const std::string& type);
  /// Prefers those of the new actions whose specific entries have a field `priority` that is
  /// `high`.
  void prefer_high_priorities();
  bool has_high_priority(const Address& address);

  void execute_next();
  void execute(const ExecutedActions::Candidate& candidate);
  /// The action, accepted; nothing if it is gone, or another component's.
  std::optional<Action> accept(const ExecutedActions::Candidate& candidate);
  ActionResult handle(const Offered& offered, ActionExecution& execution);
  /// Lets the specific entry of an action that continues be deleted some time after it.
  void expire_specific_entry(const Action& action, const Value& what);

  const std::string& name() const;
  const std::string& subarchitecture() const;

  SubarchitectureComponent& component_;
  ActionParts parts_;
  ExecutedActions actions_;
  std::map<std::string, Offered> offered_;
  /// Actions whose types have priorities, which have not been looked at.
  std::vector<Address> unranked_;
  bool listens_ = false;
  /// Results that could not be written, since the working memory of the requester was lost.
  std::map<Address, Action> pending_results_;
  /// Actions of which it is not known whether they were accepted: no answer came.
  std::set<Address> doubtful_;
};

} // namespace castor
