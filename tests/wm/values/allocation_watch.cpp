#include "castor/tests/wm/values/allocation_watch.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local bool watching = false;
thread_local std::size_t requested = 0;

void* allocate(std::size_t size) {
  if (watching)
    requested += size;
  if (auto* result = std::malloc(size == 0 ? 1 : size))
    return result;
  throw std::bad_alloc{};
}

} // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}

void* operator new[](std::size_t size) {
  return allocate(size);
}

void operator delete(void* p) noexcept {
  std::free(p);
}

void operator delete[](void* p) noexcept {
  std::free(p);
}

void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}

namespace castor::test {

AllocationWatch::AllocationWatch() {
  requested = 0;
  watching = true;
}

AllocationWatch::~AllocationWatch() {
  watching = false;
}

std::size_t AllocationWatch::total() const {
  return requested;
}

} // namespace castor::test
