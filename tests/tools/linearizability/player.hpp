#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/tests/tools/linearizability/world.hpp"
#include "castor/tools/linearizability/history.hpp"
#include "castor/tools/simulation/seen.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace castor::linearizability {

/// A component that operates on entries at random and writes down what it sees, and what its
/// runtime shows of it: the version last seen and the token in hand. Its name ends with its number.
class Player : public UnmanagedComponent {
protected:
  void run() override;

private:
  struct View {
    std::optional<Version> seen;
    std::set<Version> written;
    /// Whether there are writes of which it does not know what became of them.
    bool in_doubt = false;
    bool present = false;
    /// Its working memory is not there any more.
    bool lost = false;
    /// In hand, and obtained so often.
    Token token = 0;
    std::size_t times = 0;
    std::vector<LockGuard> guards;
  };

  /// An operation that is written down.
  struct Attempt {
    OperationRecord record;
    World::Number number = 0;

    OperationRecord* operator->() { return &record; }
    const OperationRecord* operator->() const { return &record; }
  };

  struct PendingRead {
    Attempt attempt;
    Pending<EntryOf<Stamp>> answer;
  };

  struct PendingWrite {
    Attempt attempt;
    Pending<Version> answer;
  };

  std::size_t pick(std::size_t count) { return random_() % count; }
  bool chance(unsigned percent) { return pick(100) < percent; }
  Address address(const Attempt& x) const { return world_->address(x->entry); }

  void play(bool dies);

  // -- operations
  void act();
  void write(std::uint32_t entry, OperationKind kind);
  void write_several();
  void read_later(const Attempt& x);
  void take_reads();
  void lock_one(Attempt x);
  void unlock_one(std::uint32_t entry);
  void unlock_all();
  OperationKind pick_kind(const View& view);
  Attempt begin(std::uint32_t entry, OperationKind kind, Token token = 0,
                std::optional<Version> last_seen = {});

  // -- what came of them
  /// Takes the result of an operation, and writes down how it ended, if somebody knows.
  template <class F>
  void take(Attempt& x, F&& result);
  bool is_undecided(const WorkingMemoryException& e, const Attempt& x) const;
  void note_undecided(const WorkingMemoryException& e, const Attempt& x);
  void learn(const OperationRecord& x);
  void known_to_have_arrived(const OperationRecord& answered);
  void leave();

  Option<std::string> path_{this, "world", "", "where the players of a run find what they share"};

  std::optional<World> world_;
  WorldSettings settings_;
  std::mt19937_64 random_;
  Client number_ = 0;
  std::vector<View> views_;
  /// The own working memory, through which all operations go, is not there any more.
  bool home_lost_ = false;
  std::vector<PendingRead> reads_;
};

/// Looks, once the players have left, at how the entries stand in the end: each of them can be
/// locked then, unless its working memory is lost.
class Closer : public UnmanagedComponent {
protected:
  void run() override;

private:
  void look_at(World& world, std::uint32_t entry);

  Option<std::string> path_{this, "world", "", "where the players of a run find what they share"};
};

} // namespace castor::linearizability
