#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/journal/journal.hpp"

#include <string>

namespace castor::cli {

/// The event of a recorded change; its time is relative to `begin`.
inline ChangeEvent event_of(const JournalRecord& x, const std::string& subarchitecture,
                            UnixTime begin) {
  ChangeEvent result;
  result.operation = x.operation;
  result.address = {subarchitecture, x.id};
  result.source = x.source;
  result.type = x.type;
  result.version = x.version;
  result.sequence = x.sequence;
  result.time = x.time - begin;
  result.changed = x.changed;
  return result;
}

} // namespace castor::cli
