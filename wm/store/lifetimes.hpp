#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// When entries end of themselves: so long after they were last written, or with the client that
/// owns them. Time is passed in. Entries that do neither are not known here.
class Lifetimes {
public:
  /// The entry ends so long after `now`, if `time_to_live` is not 0, and with its owner, if it has
  /// one.
  void add(const std::string& id, Timestamp time_to_live, ClientPtr owner, Timestamp now);

  /// The entry was written again; its owner stays. One whose owner has ended is due all the same.
  void restart(const std::string& id, Timestamp time_to_live, Timestamp now);

  /// The entry was deleted.
  void erase(const std::string& id);

  /// The client with which the entry ends; null if it has none, or is not known here.
  ClientPtr owner(const std::string& id) const;

  /// The entries of this client are due from now on.
  void end_owner(const Client& owner, Timestamp now);

  /// The owner is not known any more, and has ended.
  void orphan(const std::string& id, Timestamp now);

  /// An entry that is due is kept until then.
  void postpone(const std::string& id, Timestamp until);

  /// When the next entry is due.
  std::optional<Timestamp> next_due() const;

  /// The ids of the entries that are due, the longest due first.
  std::vector<std::string> due(Timestamp now) const;

  /// Source of the deletion of an entry that is due.
  const char* source(const std::string& id) const { return lifetimes_.at(id).source; }

private:
  struct Lifetime {
    std::optional<Timestamp> due;
    const char* source = expiry_source;
    ClientPtr owner;
  };

  void set_due(const std::string& id, Lifetime& lifetime, std::optional<Timestamp> due,
               const char* source);

  std::unordered_map<std::string, Lifetime> lifetimes_;
  /// By the time at which they are due.
  std::set<std::pair<Timestamp, std::string>> due_;
  /// The ids of entries with an owner.
  std::set<std::string> owned_;
};

} // namespace castor
