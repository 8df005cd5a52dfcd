#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"

#include <memory>

namespace castor {

/// A change of the store, before it is journaled and sent.
struct CommittedChange {
  /// Complete except for the changed fields.
  std::shared_ptr<ChangeEvent> event;
  /// The entry after the change, or before its deletion.
  EntryPtr entry;
  /// The entry before an overwrite.
  EntryPtr before;
};

} // namespace castor
