#include "castor/tools/linearizability/entry_search.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <tuple>

namespace castor::linearizability {

namespace {

constexpr std::size_t word_bits = 64;

bool obtained_lease(const OperationRecord& x) {
  return x.locks() && !x.pending() && x.result.status == Status::ok;
}

bool has_written(const OperationRecord& x) {
  return (x.kind == OperationKind::add || x.kind == OperationKind::overwrite) && !x.pending() &&
         x.result.status == Status::ok;
}

bool only_looks(const OperationRecord& x) {
  return x.kind == OperationKind::read || x.kind == OperationKind::exists ||
         x.kind == OperationKind::version;
}

/// Grows with time for the answers to reads of those who wait together: a deletion fails all.
Version seen_at(const OperationRecord& read) {
  return read.result.status == Status::ok ? read.result.version
                                          : std::numeric_limits<Version>::max();
}

} // namespace

EntrySearch::Outcome EntrySearch::run(std::span<const OperationRecord> operations,
                                      std::uint64_t max_states) {
  prepare(operations);
  enter({}, 0);
  while (!frames_.empty()) {
    if (complete_)
      return Outcome::found;
    if (choices_.size() == frames_.back().choices_before) {
      leave();
      continue;
    }
    if (++states_ > max_states)
      return Outcome::gave_up;
    auto choice = choices_.back();
    choices_.pop_back();
    auto state = frames_.back().state;
    auto order_before = order_.size();
    place(choice);
    if (follow(state, choice))
      enter(state, order_before);
    else
      undo_to(order_before);
  }
  return Outcome::exhausted;
}

void EntrySearch::prepare(std::span<const OperationRecord> operations) {
  operations_ = operations;
  model_ = EntryModel{operations};
  frames_.clear();
  order_.clear();
  choices_.clear();
  seen_.clear();
  states_ = 0;
  longest_.clear();

  // What lies beyond the last operation counts as placed, and so does what nobody would notice.
  placed_.assign((operations.size() + word_bits - 1) / word_bits, 0);
  if (auto used = operations.size() % word_bits)
    placed_.back() = ~std::uint64_t{0} << used;
  tokens_.assign(1, 0);
  writes_.clear();
  for (OperationIndex x = 0; x < operations.size(); ++x) {
    if (operations[x].pending() && only_looks(operations[x]))
      placed_[x / word_bits] |= std::uint64_t{1} << x % word_bits;
    if (obtained_lease(operations[x]))
      tokens_.push_back(operations[x].result.token);
    if (has_written(operations[x]))
      writes_.push_back({operations[x].result.version, operations[x].kind == OperationKind::add,
                         operations[x].token});
  }

  std::ranges::sort(writes_, {}, &Write::version);
  std::ranges::sort(tokens_);
  previous_token_.assign(operations.size(), 0);
  keeps_for_good_.assign(operations.size(), false);
  for (OperationIndex x = 0; x < operations.size(); ++x) {
    keeps_for_good_[x] =
      operations[x].locks() && operations[x].pending() && keeps_for_good(operations[x]);
    if (obtained_lease(operations[x]) && operations[x].result.token != 0)
      previous_token_[x] =
        *std::prev(std::ranges::lower_bound(tokens_, operations[x].result.token));
  }
}

void EntrySearch::enter(const EntryState& state, std::size_t order_before) {
  frames_.push_back({state, order_before, choices_.size()});
  expand(state);
  if (!complete_ && seen_before(state))
    leave();
}

void EntrySearch::leave() {
  if (order_.size() > longest_.size())
    longest_ = order_;
  choices_.resize(frames_.back().choices_before);
  undo_to(frames_.back().order_before);
  frames_.pop_back();
}

/// Places what changes nothing, and finds out what may come next.
void EntrySearch::expand(const EntryState& state) {
  // What is invoked later comes after something that is not placed or still waits.
  Tick bound = never;
  for (std::size_t i = 0; i < state.waiting; ++i)
    bound = std::min(bound, operations_[state.queue[i]].returned);
  complete_ = bound == never;

  auto choices_before = choices_.size();
  auto blocker = operations_.size();
  for (auto x = next_open(0); x < operations_.size(); x = next_open(x + 1)) {
    const auto& operation = operations_[x];
    if (operation.invoked > bound) {
      complete_ = false;
      break;
    }
    auto how = fit(state, x);
    if (how == Fit::changes_nothing) {
      place({x});
      continue;
    }
    if (how == Fit::possible)
      choices_.push_back({x});
    complete_ &= operation.may_be_left_out();
    if (operation.arrived_by() < bound) {
      bound = operation.arrived_by();
      blocker = x;
    }
  }
  sort_choices(choices_before);
  // Nothing else is left to try then.
  if (blocker < operations_.size() && operations_[blocker].may_be_left_out())
    choices_.insert(choices_.begin() + std::ptrdiff_t(choices_before),
                    {OperationIndex(blocker), true});
}

/// The one to be tried first stands last: one that must happen, of these a read, of these the one
/// that saw the lowest version, of these the earliest invoked. A read seldom waits too early, a
/// lock often does, and most often what waits until a deletion fails it.
void EntrySearch::sort_choices(std::size_t from) {
  std::ranges::sort(
    choices_.begin() + std::ptrdiff_t(from), choices_.end(), std::greater{}, [&](auto& x) {
      auto& operation = operations_[x.operation];
      auto reads = operation.kind == OperationKind::read;
      auto fails = operation.kind != OperationKind::loss && operation.result.status != Status::ok;
      return std::tuple{operation.may_be_left_out(),
                        fails   ? 2
                        : reads ? 0
                                : 1,
                        reads ? seen_at(operation) : 0, x.operation};
    });
}

/// Whether what was observed agrees with the step.
bool EntrySearch::follow(EntryState& state, Placement x) {
  if (x.left_out)
    return true;
  settled_.clear();
  auto version = state.version;
  auto lease = state.token_known ? state.token : 0;
  if (!model_.arrive(state, x.operation, settled_))
    sort_waiting(state);
  if (state.version != version && passes_by(state))
    return false;
  if (lease != 0 && state.token != lease && is_used_later(lease))
    return false;
  return std::ranges::all_of(settled_, [&](auto& settled) {
    const auto& operation = operations_[settled.operation];
    return operation.pending() || operation.result == settled.result;
  });
}

template <class F>
bool EntrySearch::any_success_to_come(F&& f) const {
  for (auto x = next_open(0); x < operations_.size(); x = next_open(x + 1)) {
    const auto& operation = operations_[x];
    if (!operation.pending() && operation.result.status == Status::ok && f(operation))
      return true;
  }
  return false;
}

/// Whether something that is still to come found a lower version, which only rises, or this one
/// with another content.
bool EntrySearch::passes_by(const EntryState& state) const {
  // After a loss the version is the one that an addition gets.
  auto written = state.presence != EntryState::Presence::never_existed;
  return any_success_to_come([&](auto& x) {
    switch (x.kind) {
      case OperationKind::add:
      case OperationKind::overwrite:
        return x.result.version < state.version + (written ? 1 : 0);
      case OperationKind::read:
        return x.result.version < state.version ||
               (written && x.result.version == state.version && x.result.content != state.content);
      case OperationKind::version:
      case OperationKind::remove:
        return x.result.version < state.version;
      default:
        return false;
    }
  });
}

/// Whether something that is still to come has succeeded under that lease.
bool EntrySearch::is_used_later(Token lease) const {
  return any_success_to_come([&](auto& x) {
    return x.kind != OperationKind::lapse && x.kind != OperationKind::loss &&
           (x.token == lease || x.result.token == lease);
  });
}

EntrySearch::Fit EntrySearch::fit(const EntryState& state, OperationIndex x) const {
  const auto& operation = operations_[x];
  if (operation.kind == OperationKind::lapse)
    return fit_lapse(state, operation);
  if (operation.kind == OperationKind::loss)
    return Fit::possible;
  auto answer = model_.answer(state, x);
  if (!answer) {
    if (keeps_for_good_[x])
      return Fit::impossible;
    // To give up at once disturbs others no more than to give up later.
    if (!operation.pending() && operation.result.status == Status::timed_out)
      return Fit::changes_nothing;
    if (operation.kind == OperationKind::read && !may_queue_read(state, operation))
      return Fit::impossible;
  } else if (operation.pending()) {
    if (answer->status != Status::ok)
      return Fit::impossible;
  } else {
    if (*answer != operation.result)
      return Fit::impossible;
    if (answer->status != Status::ok || only_looks(operation))
      return Fit::changes_nothing;
  }
  return !operation.locks() || may_lock(state, x) ? Fit::possible : Fit::impossible;
}

EntrySearch::Fit EntrySearch::fit_lapse(const EntryState& state,
                                        const OperationRecord& lapse) const {
  if (model_.ends_lease(state, lapse))
    return Fit::possible;
  if (!lapse.mandatory)
    return Fit::impossible;
  // Without a token it speaks of the lease that the client has when it is placed: not to be placed
  // in haste.
  if (lapse.token == 0)
    return Fit::possible;
  return state.last_token >= lapse.token ? Fit::changes_nothing : Fit::impossible;
}

/// Whether a lock may be granted or queued, seen from the tokens that are to be granted later.
bool EntrySearch::may_lock(const EntryState& state, OperationIndex x) const {
  const auto& lock = operations_[x];
  if (state.leased_by(lock.client))
    return true;
  auto newest = state.last_token;
  // One whose token nobody was told yet may turn out to be any of the lower ones.
  auto unknown = state.leased() && !state.token_known;
  for (std::size_t i = 0; i < state.waiting; ++i) {
    const auto& waiting = operations_[state.queue[i]];
    if (waiting.kind != OperationKind::lock) {
      // It would not have been answered so when the lock in question was granted.
      if (waiting.result.status != Status::ok && obtained_lease(lock))
        return false;
      continue;
    }
    if (!may_obtain_lease(state.queue[i]))
      return !may_obtain_lease(x);
    if (waiting.pending())
      unknown = true;
    else
      newest = std::max(newest, waiting.result.token);
  }
  if (!obtained_lease(lock))
    return true;
  return lock.result.token > newest && (unknown || previous_token_[x] <= newest);
}

/// Who waits in front is answered no later, and with no lock between that obtains the lease, at the
/// same time; but a client that locks reads as soon as it has its lock.
bool EntrySearch::may_queue_read(const EntryState& state, const OperationRecord& read) const {
  if (!may_wait_for_version(state, read))
    return false;
  bool own_lock = false;
  bool same_time = true;
  for (std::size_t i = 0; i < state.waiting; ++i) {
    const auto& other = operations_[state.queue[i]];
    if (other.kind == OperationKind::lock)
      own_lock |= other.client == read.client;
    else if (!own_lock && seen_at(other) > seen_at(read))
      return false;
  }
  for (std::size_t i = state.waiting; !own_lock && same_time && i-- > 0;) {
    const auto& other = operations_[state.queue[i]];
    if (other.kind == OperationKind::lock)
      same_time = !may_obtain_lease(state.queue[i]);
    else if (other.result != read.result && !has_lock_waiting(state, other.client))
      return false;
  }
  return true;
}

/// While a read waits, the entry is not deleted and added again, which would have failed the read,
/// and overwritten only under the leases that it waits for.
bool EntrySearch::may_wait_for_version(const EntryState& state, const OperationRecord& read) const {
  if (read.result.status != Status::ok || read.result.version <= state.version)
    return true;
  for (auto i = std::ranges::upper_bound(writes_, state.version, {}, &Write::version);
       i != writes_.end() && i->version <= read.result.version; ++i)
    if (i->adds || !is_lease_in_front(state, i->token))
      return false;
  return true;
}

/// Whether the token may be that of the lease, or of one that somebody waits for.
bool EntrySearch::is_lease_in_front(const EntryState& state, Token token) const {
  if (!state.token_known || state.token == token)
    return true;
  return std::any_of(state.queue.begin(), state.queue.begin() + state.waiting, [&](auto x) {
    const auto& operation = operations_[x];
    return operation.kind == OperationKind::lock &&
           (operation.pending() || operation.result.token == token);
  });
}

bool EntrySearch::has_lock_waiting(const EntryState& state, Client client) const {
  return std::any_of(state.queue.begin(), state.queue.begin() + state.waiting, [&](auto x) {
    return operations_[x].kind == OperationKind::lock && operations_[x].client == client;
  });
}

bool EntrySearch::may_obtain_lease(OperationIndex x) const {
  const auto& lock = operations_[x];
  return lock.pending() || lock.result.status == Status::ok;
}

bool EntrySearch::keeps_for_good(const OperationRecord& lock) const {
  return std::ranges::none_of(operations_, [&](auto& x) {
    if (x.returned < lock.invoked)
      return false;
    if (x.kind == OperationKind::loss)
      return true;
    if (x.kind == OperationKind::remove)
      return lock.level == LockLevel::o && (x.pending() || x.result.status == Status::ok);
    return &x != &lock && x.client == lock.client &&
           (x.locks() || (x.kind == OperationKind::lapse && x.token == 0));
  });
}

/// Behind the last lock that may obtain the lease, the order of the queue makes no difference.
void EntrySearch::sort_waiting(EntryState& state) const {
  auto matters = [&](OperationIndex x) {
    return operations_[x].kind == OperationKind::lock && may_obtain_lease(x);
  };
  auto last = state.queue.begin() + state.waiting - 1;
  if (matters(*last))
    return;
  for (; last != state.queue.begin() && !matters(last[-1]) && last[-1] > *last; --last)
    std::swap(last[-1], *last);
}

bool EntrySearch::seen_before(const EntryState& state) {
  auto full = [](std::uint64_t word) { return word == ~std::uint64_t{0}; };
  auto first = std::ranges::find_if_not(placed_, full);
  auto last =
    std::find_if(placed_.rbegin(), std::make_reverse_iterator(first), [](std::uint64_t word) {
      return word != 0;
    }).base();
  key_.assign({std::uint64_t(first - placed_.begin()) << 32 | std::uint64_t(last - first),
               std::uint64_t(state.holder) << 32 | std::uint64_t(state.waiting) << 16 |
                 std::uint64_t(state.presence) << 8 | std::uint64_t(state.token_known),
               state.version, state.content, state.levels, state.token, state.last_token});
  key_.insert(key_.end(), first, last);
  for (std::size_t i = 0; i < state.waiting; ++i)
    key_.push_back(state.queue[i]);
  return !seen_.insert(key_);
}

OperationIndex EntrySearch::next_open(OperationIndex from) const {
  auto unseen = ~std::uint64_t{0} << from % word_bits;
  for (auto word = from / word_bits; word < placed_.size(); ++word, unseen = ~std::uint64_t{0})
    if (auto open = ~placed_[word] & unseen; open != 0)
      return OperationIndex(word * word_bits + std::size_t(std::countr_zero(open)));
  return OperationIndex(operations_.size());
}

void EntrySearch::place(Placement x) {
  placed_[x.operation / word_bits] |= std::uint64_t{1} << x.operation % word_bits;
  order_.push_back(x);
}

void EntrySearch::undo_to(std::size_t order_size) {
  for (; order_.size() > order_size; order_.pop_back()) {
    auto x = order_.back().operation;
    placed_[x / word_bits] &= ~(std::uint64_t{1} << x % word_bits);
  }
}

} // namespace castor::linearizability
