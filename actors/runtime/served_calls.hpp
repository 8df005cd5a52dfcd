#pragma once

#include "castor/wm/entries/address.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor {

/// The calls that one component serves, and which of them are over, so that their progress and
/// their replies are to be deleted.
///
/// A call is over once its entry is gone: deleted, or lost with the working memory that it was in,
/// without a change event.
class ServedCalls {
public:
  /// To be called before the call's entry is read: whatever ends it from then on is noticed. False
  /// if the component serves the call already.
  bool begin(const Address& call) { return calls_.try_emplace(call).second; }

  /// The component does not serve the call after all.
  void abandon(const Address& call) { calls_.erase(call); }

  /// The component has served the call.
  void finish(const Address& call);

  /// The call's entry was deleted.
  void deleted(const Address& call);

  /// The working memory of that subarchitecture is gone, with all calls that were in it.
  void memory_lost(const std::string& subarchitecture);

  bool is_over(const Address& call) const;

  /// The calls that are finished and over. They are no longer known afterwards.
  std::vector<Address> take_ended();

private:
  struct State {
    bool is_finished = false;
    bool is_over = false;
  };

  std::map<Address, State> calls_;
};

} // namespace castor
