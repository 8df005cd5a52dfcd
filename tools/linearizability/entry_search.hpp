#pragma once

#include "castor/tools/linearizability/entry_model.hpp"
#include "castor/tools/linearizability/seen_states.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace castor::linearizability {

/// A step of an order: an operation arrives, or an optional one is left out.
struct Placement {
  OperationIndex operation = 0;
  bool left_out = false;
};

/// Searches for an order of the operations on one entry that satisfies the model: Wing and Gong's
/// algorithm ("Testing and verifying concurrent objects", 1993) with Lowe's cache of failed
/// configurations ("Testing for linearizability", 2017).
///
/// Steps are arrivals of operations. The completion of a waiting operation results from later
/// steps, and must come before it returned.
///
/// An operation that changes nothing is placed as soon as possible, without backtracking: if there
/// is an order with it later, there is one with it now. Of locks whose tokens are known, only the
/// one with the next token is tried, since tokens rise. A pending lock whose lease nothing in the
/// history could end is not queued: granted from the queue, it would be the last, so it can as well
/// arrive when nothing else waits.
class EntrySearch {
public:
  enum class Outcome : std::uint8_t { found, exhausted, gave_up };

  /// @param operations in the order of their invocation
  /// @param max_states limit after which the search gives up
  Outcome run(std::span<const OperationRecord> operations, std::uint64_t max_states);

  /// Number of states that the last run tried.
  std::uint64_t states() const { return states_; }

  /// The longest partial order that the last run could not extend.
  const std::vector<Placement>& longest() const { return longest_; }

private:
  struct Frame {
    EntryState state;
    /// Sizes of `order_` and `choices_` before this frame.
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
  /// The first unplaced operation from index `from` on; the number of operations if there is none.
  OperationIndex next_open(OperationIndex from) const;
  void place(Placement x);
  void undo_to(std::size_t order_size);

  std::span<const OperationRecord> operations_;
  EntryModel model_{{}};
  /// For a lock that obtained a token: the next lower token in the history.
  std::vector<Token> previous_token_;
  struct Write {
    Version version = 0;
    bool adds = false;
    Token token = 0;
  };
  /// Successful writes, by version.
  std::vector<Write> writes_;
  /// For a pending lock: whether its lease, if it obtains one, lasts to the end of the history.
  std::vector<bool> keeps_for_good_;

  std::vector<Frame> frames_;
  std::vector<Placement> order_;
  /// Stack of placements still to be tried.
  std::vector<Placement> choices_;
  /// One bit per operation.
  std::vector<std::uint64_t> placed_;
  bool complete_ = false;

  SeenStates seen_;
  std::uint64_t states_ = 0;
  std::vector<Placement> longest_;
  /// Buffers, members only to reuse their memory.
  std::vector<SettledWait> settled_;
  std::vector<std::uint64_t> key_;
  std::vector<Token> tokens_;
};

} // namespace castor::linearizability
