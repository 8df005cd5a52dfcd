#pragma once

#include <cstddef>

namespace castor::test {

/// Sees what this thread asks the allocator for, from its construction on. The test executable
/// replaces the global operator new for this (allocation_watch.cpp). One at a time per thread.
class AllocationWatch {
public:
  AllocationWatch();
  ~AllocationWatch();

  AllocationWatch(const AllocationWatch&) = delete;
  AllocationWatch& operator=(const AllocationWatch&) = delete;

  /// The bytes of all requests together, whether given back or not.
  std::size_t total() const;
};

} // namespace castor::test
