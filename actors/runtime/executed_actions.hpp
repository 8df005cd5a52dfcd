#pragma once

#include "castor/wm/entries/address.hpp"

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace castor {

/// The actions that one component may execute, and those that it executes: which one is next, and
/// what others have done to those under way.
class ExecutedActions {
public:
  struct Candidate {
    Address action;
    /// Type of the specific entry.
    std::string type;
  };

  /// @param alongside whether actions of the type may begin while others are under way
  void offer(const std::string& type, bool alongside);
  bool is_offered(const std::string& type) const { return offers_.count(type) > 0; }

  /// An action was proposed. Ignored if it waits or is under way already.
  void propose(const Address& action, const std::string& type);

  /// A proposed action that has not begun goes before those that wait and are not preferred.
  void prefer(const Address& action);

  /// The action that is next, if one may begin now; of those that are preferred, or else of all,
  /// the oldest. It is under way until `finish`.
  std::optional<Candidate> begin_next();

  /// The specific entry of an action under way; what happens to it is noticed from then on.
  void set_specific_entry(const Address& action, Address what);

  void finish(const Address& action) { under_way_.erase(action); }
  bool is_under_way(const Address& action) const { return under_way_.count(action) > 0; }

  // -- news: each is true if it concerns an action under way

  /// Somebody else has written the action's entry.
  bool changed(const Address& action);

  /// An entry was deleted: that of an action, or a specific one, which means that the requester is
  /// gone.
  bool deleted(const Address& entry);

  /// The working memory of that subarchitecture is gone, with all entries and requesters there.
  bool memory_lost(const std::string& subarchitecture);

  // -- of an action under way

  /// Whether its entry was written by somebody else since the last call.
  bool take_changed(const Address& action);
  bool is_changed(const Address& action) const;
  bool is_requester_gone(const Address& action) const;

private:
  struct UnderWay {
    Address what;
    bool is_changed = false;
    bool is_requester_gone = false;
  };

  /// By type, whether it may run alongside others.
  std::map<std::string, bool> offers_;
  /// Those that are preferred first.
  std::deque<Candidate> waiting_;
  std::set<Address> preferred_;
  std::map<Address, UnderWay> under_way_;
};

} // namespace castor
