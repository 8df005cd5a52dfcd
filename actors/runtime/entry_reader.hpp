#pragma once

#include "castor/actors/runtime/readable_memories.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/client.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// Reads entries of the working memories of this process for one component, without a message.
class EntryReader {
public:
  EntryReader(const ReadableMemories& memories, ClientPtr reader)
    : memories_(memories), reader_(std::move(reader)) {}

  /// Null if the working memory has to be asked.
  EntryPtr read(const Address& address);

private:
  struct Memory {
    std::string subarchitecture;
    std::shared_ptr<EntryTable> entries;
    ReadCounts::OfComponent* counts;
  };

  void look_again();

  const ReadableMemories& memories_;
  const ClientPtr reader_;
  /// Those that the component may read.
  std::vector<Memory> known_;
  /// When `known_` was made.
  std::uint64_t changes_ = 0;
};

} // namespace castor
