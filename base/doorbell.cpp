#include "castor/base/doorbell.hpp"

#include "castor/base/ring_batch_end.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <thread>
#include <utility>

namespace castor {

namespace {

thread_local RingBatch* batch = nullptr;

/// Who is to be called at the end of the batch, and how.
thread_local std::vector<std::pair<std::shared_ptr<void>, void (*)(void*)>> at_end;

/// @param until null for ever
long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const timespec* until) {
  static_assert(sizeof word == sizeof(std::uint32_t) &&
                std::atomic<std::uint32_t>::is_always_lock_free);
  return syscall(SYS_futex, &word, operation | FUTEX_PRIVATE_FLAG, value, until, nullptr,
                 FUTEX_BITSET_MATCH_ANY);
}

} // namespace

Doorbell::Chain* Doorbell::waiting() {
  static Chain mark;
  return &mark;
}

Doorbell::Chain* Doorbell::woken() {
  static Chain mark;
  return &mark;
}

void Doorbell::ring(const std::shared_ptr<Doorbell>& bell) {
  if (batch)
    batch->bells_.push_back(bell);
  else
    bell->wake(nullptr);
}

bool Doorbell::wake(Chain* others) {
  auto* expected = waiting();
  if (!state_.compare_exchange_strong(expected, others ? others : woken()))
    return false;
  ++rings_;
  futex(rings_, FUTEX_WAKE, 1, nullptr);
  return true;
}

void Doorbell::ring_all(Chain* chain) {
  if (chain == waiting() || chain == woken())
    return;
  while (chain) {
    std::unique_ptr<Chain> first{chain};
    chain = first->next;
    if (first->bell->wake(chain))
      return;
  }
}

bool Doorbell::sleep(std::uint32_t seen, Clock::time_point until) {
  if (until == Clock::time_point::max()) {
    futex(rings_, FUTEX_WAIT_BITSET, seen, nullptr);
    return true;
  }
  // The steady clock is the kernel's monotonic one.
  auto since_boot = until.time_since_epoch();
  auto seconds = std::chrono::floor<std::chrono::seconds>(since_boot);
  timespec time{};
  time.tv_sec = seconds.count();
  time.tv_nsec = std::chrono::nanoseconds{since_boot - seconds}.count();
  return futex(rings_, FUTEX_WAIT_BITSET, seen, &time) == 0 || errno != ETIMEDOUT;
}

bool at_end_of_ring_batch(const std::shared_ptr<void>& who, void (*wake)(void* who)) {
  if (!batch)
    return false;
  if (std::ranges::none_of(at_end, [&](auto& x) { return x.first == who; }))
    at_end.emplace_back(who, wake);
  return true;
}

RingBatch::RingBatch() : is_outermost_(batch == nullptr) {
  if (is_outermost_)
    batch = this;
}

RingBatch::~RingBatch() {
  if (!is_outermost_)
    return;
  batch = nullptr;
  for (auto& [who, wake] : at_end)
    wake(who.get());
  at_end.clear();
  static const std::size_t processors = std::max(std::thread::hardware_concurrency(), 1U);
  auto chains = std::min(bells_.size(), processors);
  for (std::size_t i = 0; i < chains; ++i) {
    Doorbell::Chain* others = nullptr;
    // From the last: the first is to be rung first.
    for (auto k = bells_.size(); k-- > chains;)
      if (k % chains == i)
        others = new Doorbell::Chain{std::move(bells_[k]), others};
    if (!bells_[i]->wake(others))
      Doorbell::ring_all(others);
  }
}

} // namespace castor
