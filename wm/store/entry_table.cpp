#include "castor/wm/store/entry_table.hpp"

namespace castor {

EntryPtr EntryTable::read_in_time(const std::string& id) const {
  EntryPtr result;
  {
    auto& part = part_of(id);
    std::lock_guard guard{part.lock};
    auto i = part.slots.find(id);
    if (i == part.slots.end() || i->second.may_end || i->second.is_excluded)
      return nullptr;
    result = i->second.entry;
  }
  // If it is of an atomic write, all of that write is there once the table is not held.
  bool must_ask =
    is_held_.load(std::memory_order_acquire) || is_closed_.load(std::memory_order_acquire);
  return must_ask ? nullptr : result;
}

void EntryTable::insert(const std::string& id, Slot slot) {
  auto& part = part_of(id);
  std::lock_guard guard{part.lock};
  part.slots.emplace(id, std::move(slot));
  ++size_;
}

void EntryTable::erase(const std::string& id) {
  auto& part = part_of(id);
  // Freed without the lock.
  std::unordered_map<std::string, Slot>::node_type node;
  std::lock_guard guard{part.lock};
  node = part.slots.extract(id);
  size_ -= node.empty() ? 0 : 1;
}

void EntryTable::clear() {
  close();
  for (auto& part : parts_) {
    std::unordered_map<std::string, Slot> slots;
    std::lock_guard guard{part.lock};
    slots.swap(part.slots);
  }
  size_ = 0;
}

} // namespace castor
