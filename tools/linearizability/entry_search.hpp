#pragma once

#include "castor/tools/linearizability/entry_model.hpp"
#include "castor/tools/linearizability/seen_states.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace castor::linearizability {

/// A step of an order: an operation arrives, or one that need not have happened is left out.
struct Placement {
  OperationIndex operation = 0;
  bool left_out = false;
};

/// Looks for an order of the operations on one entry that the model agrees with: Wing and Gong's
/// search ("Testing and verifying concurrent objects", 1993) with Lowe's memory of configurations
/// that led nowhere ("Testing for linearizability", 2017).
///
/// What is placed is the arrival of an operation. If it has to wait, its completion follows from
/// what is placed later, and must come before it returned.
///
/// Whatever changes nothing is placed as soon as it may be, without a second thought: if there is
/// an order with it later, there is one with it now. Of locks whose tokens are known, only the one
/// with the next token is tried: no other could be granted any more. A pending lock whose lease
/// nothing in the history could end is not queued: granted from the queue, it would be the last,
/// and can as well come when nobody else waits.
class EntrySearch {
public:
  enum class Outcome : std::uint8_t { found, exhausted, gave_up };

  /// The operations in the order of their invocation. Gives up after so many states.
  Outcome run(std::span<const OperationRecord> operations, std::uint64_t max_states);

  /// How many states the last run tried.
  std::uint64_t states() const { return states_; }

  /// The longest order from which the last run found no way on.
  const std::vector<Placement>& longest() const { return longest_; }

private:
  struct Frame {
    EntryState state;
    /// The sizes of `order_` and `choices_` without this frame's share.
    std::size_t order_before = 0;
    std::size_t choices_before = 0;
  };

  enum class Fit : std::uint8_t { impossible, changes_nothing, possible };

  void prepare(std::span<const OperationRecord> operations);
  void enter(const EntryState& state, std::size_t order_before);
  void leave();
  void expand(const EntryState& state);
  void sort_choices(std::size_t from);
  bool follow(EntryState& state, Placement x);
  template <class F>
  bool any_success_to_come(F&& f) const;
  bool passes_by(const EntryState& state) const;
  bool is_used_later(Token lease) const;

  Fit fit(const EntryState& state, OperationIndex x) const;
  Fit fit_lapse(const EntryState& state, const OperationRecord& lapse) const;
  bool may_lock(const EntryState& state, OperationIndex x) const;
  bool may_queue_read(const EntryState& state, const OperationRecord& read) const;
  bool may_wait_for_version(const EntryState& state, const OperationRecord& read) const;
  bool is_lease_in_front(const EntryState& state, Token token) const;
  bool has_lock_waiting(const EntryState& state, Client client) const;
  bool may_obtain_lease(OperationIndex x) const;
  bool keeps_for_good(const OperationRecord& lock) const;
  void sort_waiting(EntryState& state) const;
  bool seen_before(const EntryState& state);
  /// The first operation from there on that is not placed; as many as there are if all are.
  OperationIndex next_open(OperationIndex from) const;
  void place(Placement x);
  void undo_to(std::size_t order_size);

  std::span<const OperationRecord> operations_;
  EntryModel model_{{}};
  /// Of a lock that obtained one: the highest lower token in the history.
  std::vector<Token> previous_token_;
  struct Write {
    Version version = 0;
    bool adds = false;
    Token token = 0;
  };
  /// Those that succeeded, by version.
  std::vector<Write> writes_;
  /// Of a pending lock: whether its lease, if it obtains one, outlasts the history.
  std::vector<bool> keeps_for_good_;

  std::vector<Frame> frames_;
  std::vector<Placement> order_;
  /// What is still to be tried, the next one last.
  std::vector<Placement> choices_;
  /// One bit per operation.
  std::vector<std::uint64_t> placed_;
  bool complete_ = false;

  SeenStates seen_;
  std::uint64_t states_ = 0;
  std::vector<Placement> longest_;
  /// Kept for their memory only.
  std::vector<SettledWait> settled_;
  std::vector<std::uint64_t> key_;
  std::vector<Token> tokens_;
};

} // namespace castor::linearizability
