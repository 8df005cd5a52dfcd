#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::linearizability {

/// A write as its client knows it.
struct ObservedWrite {
  Operation operation = Operation::add;
  Address address;
  std::string component;
  /// Means nothing while it is pending.
  Version version = 0;
  Tick invoked = 0;
  /// `never` while it is pending.
  Tick returned = never;
  /// The writes of one batch stand side by side and have one number; 0 for a write of its own.
  std::size_t batch = 0;
};

/// What is wrong with the changes of one working memory that a listener was told, given all writes
/// to it: numbered without a gap and in order, one for each write that was made, with versions that
/// follow from one another, in an order that agrees with the moments of the writes, those of one
/// batch in one piece.
std::vector<std::string> faults_of(std::span<const ChangeEventPtr> told, std::uint64_t made,
                                   std::span<const ObservedWrite> writes);

} // namespace castor::linearizability
