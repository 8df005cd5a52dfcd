#pragma once

#include "castor/tools/chaos/workload.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace castor::faults {

/// What has become of the entries that a workload says something of, by what is told by any thread.
class ExpectedChanges {
public:
  explicit ExpectedChanges(const std::vector<ExpectedChange>& each)
    : each_(each), entries_(each.size()) {}

  /// Of each statement the one that begins and the one that ends, to be watched.
  std::vector<ChangeFilter> filters() const;

  /// A change that the filter of that index matched.
  void note(std::size_t filter, const Address& entry);

  /// An entry as it stands, of whose changes not all may have been told.
  void note(const Entry& entry);

  /// Whether each has become what it is to become.
  bool is_complete() const;

  /// Entries with a change that begins.
  std::size_t begun() const;

  /// The longest time that a statement allows.
  Timestamp patience() const;

  /// One text for each statement of which entries have not become so.
  std::vector<std::string> violations() const;

private:
  /// What has been seen of an entry.
  struct Seen {
    bool begin = false;
    bool end = false;
  };

  const std::vector<ExpectedChange>& each_;
  mutable std::mutex mutex_;
  /// By statement.
  std::vector<std::map<Address, Seen>> entries_;
};

} // namespace castor::faults
