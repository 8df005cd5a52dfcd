#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"

#include <memory>

namespace castor {

/// A change of the store that is not journaled and not sent yet.
struct CommittedChange {
  /// Complete but for the fields that changed.
  std::shared_ptr<ChangeEvent> event;
  /// As it is now, or was before its deletion.
  EntryPtr entry;
  /// Before an overwrite.
  EntryPtr before;
};

} // namespace castor
