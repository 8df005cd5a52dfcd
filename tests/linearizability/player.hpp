#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/tests/linearizability/history.hpp"
#include "castor/tests/linearizability/seen.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace castor::linearizability {

/// What the components of one real run share.
struct RealWorld {
  Tick now() const { return Tick((std::chrono::steady_clock::now() - begin).count()); }

  std::uint64_t seed = 0;
  std::size_t players = 0;
  std::chrono::nanoseconds lease_duration{0};
  std::chrono::nanoseconds longest_pause{0};
  std::vector<Address> entries;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  std::atomic<std::size_t> ready{0};
  std::atomic<std::size_t> finished{0};
  std::atomic<Content> contents{0};
  /// Operations begun, by entry.
  std::array<std::atomic<std::size_t>, 4> begun{};

  std::mutex mutex;
  /// Lapses may happen until the end of the run.
  History history;
  std::vector<std::string> findings;
};

/// A component that operates on entries at random and writes down what it sees, and what its
/// runtime shows of it: the version last seen and the token in hand.
class Player : public UnmanagedComponent {
public:
  /// What the players of this process play in, one run at a time.
  static RealWorld* world;

protected:
  void run() override;

private:
  struct View {
    std::optional<Version> seen;
    std::set<Version> written;
    bool present = false;
    /// In hand, and obtained so often.
    Token token = 0;
    std::size_t times = 0;
    std::vector<LockGuard> guards;
  };

  /// A read that was sent, and what it will be in the history.
  struct PendingRead {
    OperationRecord record;
    Pending<EntryOf<Stamp>> answer;
  };

  std::size_t pick(std::size_t count) { return random_() % count; }
  bool chance(unsigned percent) { return pick(100) < percent; }
  const Address& address(const OperationRecord& x) const { return world->entries[x.entry]; }

  // -- operations
  void act();
  void write(std::uint32_t entry, OperationKind kind);
  void write_several();
  void read_later(const OperationRecord& x);
  void take_reads();
  void lock_one(OperationRecord x);
  void unlock_one(std::uint32_t entry);
  void unlock_all();
  OperationKind pick_kind(const View& view);
  OperationRecord planned(std::uint32_t entry, OperationKind kind);

  // -- what came of them
  /// Takes the result of an operation, and writes down how it ended.
  template <class F>
  void take(OperationRecord x, F&& result);
  void learn(const OperationRecord& x);
  void known_to_have_arrived(const OperationRecord& answered);
  void may_lapse(std::uint32_t entry, Token token, Tick from);
  void hand_in();

  std::mt19937_64 random_;
  Client number_ = 0;
  std::vector<View> views_;
  std::vector<PendingRead> reads_;
  History history_;
  std::vector<std::string> findings_;
};

} // namespace castor::linearizability
