#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::linearizability {

/// A write as recorded by its client.
struct ObservedWrite {
  Operation operation = Operation::add;
  Address address;
  std::string component;
  /// Undefined while the write is pending.
  Version version = 0;
  Tick invoked = 0;
  /// `never` while the write is pending.
  Tick returned = never;
  /// Number of the batch, 0 for a single write. Writes of one batch are adjacent in the list.
  std::size_t batch = 0;
};

/// Errors in the sequence of change events that a listener received from one working memory, given
/// all writes to it. The events must be numbered in order and without a gap, one for each write
/// that was made, with consecutive versions, in an order consistent with the times of the writes,
/// and with the events of a batch adjacent.
std::vector<std::string> faults_of(std::span<const ChangeEventPtr> told, std::uint64_t made,
                                   std::span<const ObservedWrite> writes);

} // namespace castor::linearizability
