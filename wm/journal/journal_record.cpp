#include "castor/wm/journal/journal_record.hpp"

namespace castor {

JournalRecord record_of(const ChangeEvent& event, const Entry& entry, const EntryPtr& before,
                        UnixTime began) {
  JournalRecord x;
  x.sequence = x.write = event.sequence;
  x.time = began + event.time;
  x.operation = event.operation;
  x.id = event.address.id;
  x.type = event.type;
  x.version = event.version;
  x.source = event.source;
  x.life = entry.life;
  if (event.operation != Operation::remove)
    x.value = entry.value;
  if (before)
    x.before = before->value;
  return x;
}

} // namespace castor
