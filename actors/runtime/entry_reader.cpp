#include "castor/actors/runtime/entry_reader.hpp"

#include "castor/wm/store/access_rules.hpp"

#include <chrono>

namespace castor {

EntryPtr EntryReader::read(const Address& address) {
  if (changes_ != memories_.changes())
    look_again();
  for (auto& x : known_) {
    if (x.subarchitecture != address.subarchitecture)
      continue;
    auto entry = x.entries->read(address.id, std::chrono::steady_clock::now);
    if (entry)
      x.counts->add(entry->value.type_ptr());
    return entry;
  }
  return nullptr;
}

void EntryReader::look_again() {
  // Before they are taken: what changes meanwhile is noticed next time.
  changes_ = memories_.changes();
  known_.clear();
  for (auto& [subarchitecture, memory] : memories_.all()) {
    AccessRules access{subarchitecture};
    access.set_readers(memory.readers);
    if (access.may_read(reader_->subarchitecture))
      known_.push_back({subarchitecture, memory.entries,
                        &memory.entries->counts().of_component(reader_->component)});
  }
}

} // namespace castor
