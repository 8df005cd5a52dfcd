#pragma once

#include "castor/wm/store/entry_table.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace castor {

/// The working memories of this process whose entries its components read without a message. Safe
/// to use from any thread.
class ReadableMemories {
public:
  struct Memory {
    std::shared_ptr<EntryTable> entries;
    /// As WorkingMemoryOptions::readers.
    std::optional<std::set<std::string>> readers;
  };
  using Memories = std::map<std::string, Memory>;

  /// In place of an earlier one of that subarchitecture, which is closed.
  void set(const std::string& subarchitecture, Memory memory) {
    std::lock_guard guard{mutex_};
    remove_now(subarchitecture);
    memories_[subarchitecture] = std::move(memory);
    ++changes_;
  }

  void remove(const std::string& subarchitecture) {
    std::lock_guard guard{mutex_};
    remove_now(subarchitecture);
    ++changes_;
  }

  /// How often they have changed.
  std::uint64_t changes() const { return changes_.load(std::memory_order_acquire); }

  Memories all() const {
    std::lock_guard guard{mutex_};
    return memories_;
  }

private:
  void remove_now(const std::string& subarchitecture) {
    auto i = memories_.find(subarchitecture);
    if (i == memories_.end())
      return;
    i->second.entries->close();
    memories_.erase(i);
  }

  mutable std::mutex mutex_;
  Memories memories_;
  std::atomic<std::uint64_t> changes_{0};
};

} // namespace castor
