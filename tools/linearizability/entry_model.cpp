#include "castor/tools/linearizability/entry_model.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace castor::linearizability {

namespace {

constexpr int bits_per_level = 2;
constexpr std::uint64_t level_mask = 3;

void forget_lease(EntryState& state) {
  state.levels = 0;
  state.holder = 0;
  state.token = 0;
  state.token_known = false;
}

bool keeps_from_reading(const EntryState& state, Client client) {
  return state.leased() && state.holder != client && state.level() == LockLevel::odr;
}

void write(EntryState& state, const OperationRecord& operation, Version version) {
  state.presence = EntryState::Presence::present;
  state.version = version;
  state.content = operation.content;
}

} // namespace

LockLevel EntryState::level() const {
  std::uint64_t strongest = 0;
  for (auto rest = levels; rest != 0; rest >>= bits_per_level)
    strongest = std::max(strongest, rest & level_mask);
  return LockLevel(strongest);
}

std::optional<Result> EntryModel::answer(const EntryState& state, OperationIndex operation) const {
  const auto& x = operations_[operation];
  switch (x.kind) {
    case OperationKind::exists:
      return Result{state.present() ? Status::ok : Status::does_not_exist};
    case OperationKind::version:
      if (state.presence == EntryState::Presence::never_existed)
        return Result{Status::never_existed};
      return Result{Status::ok, state.version};
    case OperationKind::add:
      if (state.present())
        return Result{Status::already_exists};
      return Result{Status::ok, state.presence == EntryState::Presence::never_existed
                                  ? state.version
                                  : state.version + 1};
    case OperationKind::lapse:
      return Result{};
    case OperationKind::loss:
      return x.result;
    default:
      break;
  }
  if (!state.present())
    return Result{Status::does_not_exist};
  switch (x.kind) {
    case OperationKind::overwrite:
      if (auto result = refusal(state, x))
        return result;
      if (x.last_seen != state.version)
        return Result{Status::inconsistent};
      return Result{Status::ok, state.version + 1};
    case OperationKind::remove:
      if (auto result = refusal(state, x))
        return result;
      return Result{Status::ok, state.version};
    case OperationKind::unlock:
      return Result{state.leased_under(x.token, x.client) ? Status::ok : Status::stale};
    case OperationKind::try_lock:
      if (auto result = answer_lock(state, x))
        return result;
      return Result{Status::busy};
    case OperationKind::lock:
      return answer_lock(state, x);
    default:
      if (keeps_from_reading(state, x.client))
        return std::nullopt;
      return answer_read(state);
  }
}

std::optional<Result> EntryModel::arrive(EntryState& state, OperationIndex operation,
                                         std::vector<SettledWait>& settled) const {
  auto result = answer(state, operation);
  if (!result) {
    if (state.waiting == EntryState::max_waiting)
      throw std::length_error{"more than " + std::to_string(EntryState::max_waiting) +
                              " operations wait for one entry"};
    state.queue[state.waiting++] = operation;
    return result;
  }
  const auto& x = operations_[operation];
  if (result->status != Status::ok && x.kind != OperationKind::loss)
    return result;
  switch (x.kind) {
    case OperationKind::add:
    case OperationKind::overwrite:
      write(state, x, result->version);
      break;
    case OperationKind::remove:
      remove(state, settled);
      break;
    case OperationKind::lock:
    case OperationKind::try_lock:
      obtain(state, x, result->token);
      break;
    case OperationKind::unlock:
      give_back(state, settled);
      break;
    case OperationKind::lapse:
      if (ends_lease(state, x))
        end_lease(state, settled);
      break;
    case OperationKind::loss:
      lose(state, x, settled);
      break;
    default:
      break;
  }
  return result;
}

void EntryModel::give_up(EntryState& state, OperationIndex operation) const {
  auto end = state.queue.begin() + state.waiting;
  state.waiting =
    std::uint16_t(std::remove(state.queue.begin(), end, operation) - state.queue.begin());
}

bool EntryModel::ends_lease(const EntryState& state, const OperationRecord& lapse) const {
  return lapse.token == 0 ? state.leased_by(lapse.client)
                          : state.leased_under(lapse.token, lapse.client);
}

std::optional<Result> EntryModel::answer_lock(const EntryState& state,
                                              const OperationRecord& lock) const {
  auto shown = lock.result.token;
  if (!state.leased())
    return Result{.token = std::max(shown, state.last_token + 1)};
  if (state.holder != lock.client)
    return std::nullopt;
  return Result{.token = state.token_known ? state.token : std::max(shown, state.token)};
}

std::optional<Result> EntryModel::refusal(const EntryState& state,
                                          const OperationRecord& write) const {
  if (write.token != 0) {
    if (!state.leased_under(write.token, write.client))
      return Result{Status::stale};
    return std::nullopt;
  }
  auto strong_enough = write.kind == OperationKind::overwrite ? LockLevel::o : LockLevel::od;
  if (state.leased() && state.level() >= strong_enough)
    return Result{Status::locked};
  return std::nullopt;
}

Result EntryModel::answer_read(const EntryState& state) const {
  return {Status::ok, state.version, state.content, 0};
}

void EntryModel::obtain(EntryState& state, const OperationRecord& lock, Token token) const {
  if (state.levels >> (64 - bits_per_level) != 0)
    throw std::length_error{"a lease is nested more than 32 deep"};
  state.levels = state.levels << bits_per_level | std::uint64_t(lock.level);
  state.holder = lock.client;
  state.token = token;
  state.last_token = token;
  state.token_known |= lock.result.token != 0;
}

void EntryModel::give_back(EntryState& state, std::vector<SettledWait>& settled) const {
  if (state.levels >> bits_per_level == 0) {
    end_lease(state, settled);
    return;
  }
  state.levels >>= bits_per_level;
  serve_reads(state, settled);
}

void EntryModel::end_lease(EntryState& state, std::vector<SettledWait>& settled) const {
  forget_lease(state);
  std::uint16_t served = 0;
  while (served < state.waiting && !state.leased()) {
    auto next = state.queue[served++];
    const auto& x = operations_[next];
    if (x.kind == OperationKind::lock) {
      auto result = *answer_lock(state, x);
      obtain(state, x, result.token);
      settled.push_back({next, result});
    } else {
      settled.push_back({next, answer_read(state)});
    }
  }
  std::copy(state.queue.begin() + served, state.queue.begin() + state.waiting, state.queue.begin());
  state.waiting = std::uint16_t(state.waiting - served);
  if (state.leased())
    serve_reads(state, settled);
}

void EntryModel::remove(EntryState& state, std::vector<SettledWait>& settled) const {
  state.presence = EntryState::Presence::deleted;
  state.content = 0;
  forget_lease(state);
  for (std::size_t i = 0; i < state.waiting; ++i)
    settled.push_back({state.queue[i], Result{Status::does_not_exist}});
  state.waiting = 0;
}

void EntryModel::lose(EntryState& state, const OperationRecord& loss,
                      std::vector<SettledWait>& settled) const {
  // Nobody answers those who wait.
  for (std::size_t i = 0; i < state.waiting; ++i)
    settled.push_back({state.queue[i], Result{Status::never_existed}});
  using enum EntryState::Presence;
  auto& begin = loss.result;
  state = {};
  state.presence = begin.status == Status::ok               ? present
                   : begin.status == Status::does_not_exist ? deleted
                                                            : never_existed;
  state.version = begin.version;
  state.content = begin.content;
  state.last_token = begin.token;
}

void EntryModel::serve_reads(EntryState& state, std::vector<SettledWait>& settled) const {
  auto end = state.queue.begin() + state.waiting;
  auto rest = std::remove_if(state.queue.begin(), end, [&](OperationIndex x) {
    if (operations_[x].kind == OperationKind::lock ||
        keeps_from_reading(state, operations_[x].client))
      return false;
    settled.push_back({x, answer_read(state)});
    return true;
  });
  state.waiting = std::uint16_t(rest - state.queue.begin());
}

} // namespace castor::linearizability
