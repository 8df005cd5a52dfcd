#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Automatic deletion of entries: some time after their last write, or with the client that owns
/// them; and the wills of clients, which are fulfilled when they end. Time is passed in. Other
/// entries are not recorded here.
class Lifetimes {
public:
  /// Adds an entry, to be deleted at `now` + `time_to_live` (unless 0) and when its owner ends
  /// (unless null).
  void add(const std::string& id, Timestamp time_to_live, ClientPtr owner, Timestamp now);

  /// The entry was written again: its time begins anew. Its owner stays; if the owner has ended,
  /// the entry stays due.
  void restart(const std::string& id, Timestamp time_to_live, Timestamp now);

  /// From now on the entry has the will that this client leaves; none if it is empty.
  void set_will(const std::string& id, ClientPtr testator, LastWill will);

  /// The will that is to be fulfilled, if that is why the entry is due; else null.
  const LastWill* due_will(const std::string& id) const;

  /// The will was fulfilled: the entry's time begins anew.
  void fulfil(const std::string& id, Timestamp time_to_live, Timestamp now);

  /// The entry was deleted.
  void erase(const std::string& id);

  /// Owner of the entry, or else the client whose will it has; null if it has neither.
  ClientPtr owner(const std::string& id) const;

  /// The client has ended: its entries, and those with its will, are due from now on.
  void end_owner(const Client& owner, Timestamp now);

  /// The entry's unknown owner has ended: the entry is due from now on.
  void orphan(const std::string& id, Timestamp now);

  /// Postpones the deletion of a due entry.
  void postpone(const std::string& id, Timestamp until);

  /// Time at which the next entry is due.
  std::optional<Timestamp> next_due() const;

  /// Ids of the due entries, the longest due first.
  std::vector<std::string> due(Timestamp now) const;

  /// Source of the change event for the deletion of a due entry.
  const char* source(const std::string& id) const { return lifetimes_.at(id).source; }

private:
  struct Lifetime {
    std::optional<Timestamp> due;
    const char* source = expiry_source;
    ClientPtr owner;
    ClientPtr testator;
    LastWill will;
  };

  void set_due(const std::string& id, Lifetime& lifetime, std::optional<Timestamp> due,
               const char* source);

  std::unordered_map<std::string, Lifetime> lifetimes_;
  /// Entries by the time at which they are due.
  std::set<std::pair<Timestamp, std::string>> due_;
  /// The ids of entries with an owner or a will.
  std::set<std::string> owned_;
};

} // namespace castor
