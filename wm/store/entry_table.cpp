#include "castor/wm/store/entry_table.hpp"

namespace castor {

EntryPtr EntryTable::read_in_time(const std::string& id) const {
  EntryPtr result;
  {
    auto& part = part_of(id);
    std::lock_guard guard{part.lock};
    auto i = part.slots.find(std::string_view{id});
    if (i == part.slots.end() || i->may_end || i->is_excluded)
      return nullptr;
    result = i->entry;
  }
  // If it is of an atomic write, all of that write is there once the table is not held.
  bool must_ask =
    is_held_.load(std::memory_order_acquire) || is_closed_.load(std::memory_order_acquire);
  return must_ask ? nullptr : result;
}

EntryTable::Slot& EntryTable::insert(EntryPtr entry, std::uint64_t written, bool may_end) {
  auto& part = part_of(entry->address.id);
  std::lock_guard guard{part.lock};
  ++size_;
  Slot slot;
  slot.entry = std::move(entry);
  slot.set_written(written);
  slot.may_end = may_end;
  return const_cast<Slot&>(*part.slots.insert(slot).first);
}

void EntryTable::erase(const std::string& id) {
  auto& part = part_of(id);
  // Freed without the lock.
  Slots::node_type node;
  std::lock_guard guard{part.lock};
  if (auto i = part.slots.find(std::string_view{id}); i != part.slots.end())
    node = part.slots.extract(i);
  size_ -= node.empty() ? 0 : 1;
  deletions_.fetch_add(1, std::memory_order_relaxed);
}

void EntryTable::clear() {
  close();
  for (auto& part : parts_) {
    Slots slots;
    std::lock_guard guard{part.lock};
    slots.swap(part.slots);
  }
  deletions_.fetch_add(size_, std::memory_order_relaxed);
  size_ = 0;
}

} // namespace castor
