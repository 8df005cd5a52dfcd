#include "castor/tests/linearizability/player.hpp"

#include "castor/actors/registry.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <thread>
#include <utility>

namespace castor::linearizability {

CASTOR_COMPONENT(Player, "operates on entries at random and writes down what it sees")

namespace {

/// Longer than that after its time-out an operation was given up by the component and not by the
/// working memory, which may have granted it meanwhile.
constexpr std::chrono::milliseconds grace{500};

constexpr std::size_t most_operations = 60;
constexpr std::size_t most_operations_per_entry = 200;
/// What a player may have begun before it sees that others have begun enough, with all that it has
/// to unlock in the end.
constexpr std::size_t reserve = 4;

} // namespace

RealWorld* Player::world = nullptr;

void Player::run() {
  number_ = Client(std::stoul(component_name().substr(1)));
  random_.seed(world->seed * 1000 + number_);
  views_.resize(world->entries.size());
  for (++world->ready; world->ready < world->players;)
    std::this_thread::yield();
  auto dies = chance(10);
  for (std::size_t i = 0; i < most_operations && !(dies && chance(5)); ++i) {
    act();
    if (chance(5))
      sleep_for(world->longest_pause * pick(100) / 100);
  }
  take_reads();
  if (!dies)
    unlock_all();
  hand_in();
  if (++world->finished == world->players)
    end_system(0, "all have played");
  if (dies)
    throw std::runtime_error("dies on purpose");
}

// -- operations

void Player::act() {
  if (!reads_.empty() && chance(40))
    take_reads();
  if (chance(5)) {
    write_several();
    return;
  }
  auto entry = std::uint32_t(pick(views_.size()));
  if (world->begun[entry] + reserve * world->players > most_operations_per_entry)
    return;
  auto kind = pick_kind(views_[entry]);
  auto x = planned(entry, kind);
  switch (kind) {
    case OperationKind::add:
    case OperationKind::overwrite:
    case OperationKind::remove:
      write(entry, kind);
      break;
    case OperationKind::read:
      if (chance(30))
        read_later(x);
      else
        take(x, [&](Result& result) {
          auto found = read<Stamp>(address(x));
          result = {Status::ok, found.version, Content(found->number)};
        });
      break;
    case OperationKind::exists:
      take(x, [&](Result& result) {
        result = {exists(address(x)) ? Status::ok : Status::does_not_exist};
      });
      break;
    case OperationKind::version:
      take(x, [&](Result& result) { result = {Status::ok, version(address(x))}; });
      break;
    case OperationKind::unlock:
      unlock_one(entry);
      break;
    default:
      lock_one(x);
  }
}

OperationKind Player::pick_kind(const View& view) {
  using enum OperationKind;
  if (!view.present && chance(30))
    return add;
  if (!view.guards.empty() && chance(35))
    return unlock;
  if (!view.seen && chance(40))
    return read;
  static constexpr std::array kinds{
    add,  overwrite, overwrite, overwrite, overwrite, overwrite, remove,   read,
    read, exists,    version,   lock,      lock,      lock,      try_lock,
  };
  return kinds[pick(kinds.size())];
}

OperationRecord Player::planned(std::uint32_t entry, OperationKind kind) {
  ++world->begun[entry];
  auto& view = views_[entry];
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = kind;
  auto writes = kind == OperationKind::add || kind == OperationKind::overwrite;
  if (writes)
    x.content = ++world->contents;
  if (kind == OperationKind::overwrite)
    x.last_seen = view.seen;
  if (kind == OperationKind::overwrite || kind == OperationKind::remove)
    x.token = view.token;
  x.level = LockLevel(1 + pick(3));
  x.invoked = world->now();
  return x;
}

/// Several overwrites at once, sometimes: each counts on the one before.
void Player::write(std::uint32_t entry, OperationKind kind) {
  auto overwrites = kind == OperationKind::overwrite;
  auto& seen = views_[entry].seen;
  auto seen_before = seen;
  std::vector<std::pair<OperationRecord, Pending<Version>>> sent;
  for (auto count = overwrites && chance(20) ? 3 : 1; count > 0; --count) {
    auto x = planned(entry, kind);
    Stamp stamp{std::int64_t(x.content)};
    auto answer = overwrites                   ? overwrite_async(address(x), stamp)
                  : kind == OperationKind::add ? add_async(address(x), stamp)
                                               : delete_entry_async(address(x));
    sent.emplace_back(x, std::move(answer));
    if (x.last_seen)
      seen = *x.last_seen + 1;
  }
  seen = seen_before;
  for (auto& [x, answer] : sent) {
    // Who failed to write a version cannot count on it, unless by an earlier write.
    if (x.last_seen != seen_before && !views_[entry].written.contains(*x.last_seen))
      x.last_seen.reset();
    take(x, [&, &y = answer](Result& result) { result = {Status::ok, y.get()}; });
  }
}

void Player::write_several() {
  auto& home = world->entries[pick(views_.size())].subarchitecture;
  WriteBatch batch;
  std::vector<OperationRecord> records;
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
    if (world->entries[entry].subarchitecture != home)
      continue;
    auto x = planned(entry, views_[entry].present ? OperationKind::overwrite : OperationKind::add);
    Stamp stamp{std::int64_t(x.content)};
    if (x.kind == OperationKind::add)
      batch.add(address(x), stamp);
    else
      batch.overwrite(address(x), stamp);
    records.push_back(x);
  }
  std::vector<Version> versions;
  try {
    versions = SubarchitectureComponent::write(batch);
  } catch (const WorkingMemoryException& e) {
    // All versions are checked before any lease, so of a batch an old version says nothing of the
    // leases.
    for (auto& x : records)
      if (address(x) == e.address() && e.kind() != FailureKind::inconsistent)
        take(x, [&](Result&) { throw; });
    return;
  }
  for (std::size_t i = 0; i < records.size(); ++i)
    take(records[i], [&](Result& result) { result = {Status::ok, versions[i]}; });
}

void Player::read_later(const OperationRecord& x) {
  reads_.push_back({x, read_async<Stamp>(address(x))});
}

void Player::take_reads() {
  for (auto& [x, answer] : std::exchange(reads_, {}))
    take(x, [&, &y = answer](Result& result) {
      auto found = y.get();
      result = {Status::ok, found.version, Content(found->number)};
    });
}

void Player::lock_one(OperationRecord x) {
  std::chrono::milliseconds timeout{1 + pick(20)};
  std::optional<LockGuard> guard;
  take(x, [&](Result& result) {
    auto level = level_of(x.level);
    if (x.kind == OperationKind::lock)
      guard.emplace(lock(address(x), level, timeout));
    else
      guard = try_lock(address(x), level);
    result = {guard ? Status::ok : Status::busy, 0, 0, guard ? guard->token() : 0};
  });
  if (guard)
    views_[x.entry].guards.push_back(*std::move(guard));
}

void Player::unlock_one(std::uint32_t entry) {
  auto& view = views_[entry];
  auto guard = std::move(view.guards.back());
  view.guards.pop_back();
  auto x = planned(entry, OperationKind::unlock);
  x.token = guard.token();
  // Who has deleted the entry has nothing to give back.
  if (view.token == 0)
    guard.unlock();
  else
    take(x, [&](Result&) { guard.unlock(); });
}

void Player::unlock_all() {
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry)
    while (!views_[entry].guards.empty())
      unlock_one(entry);
}

// -- what came of them

template <class F>
void Player::take(OperationRecord x, F&& result) {
  try {
    result(x.result);
  } catch (const WorkingMemoryException& e) {
    auto status = status_of(e.kind(), x.kind);
    auto took = std::chrono::nanoseconds{world->now() - x.invoked};
    auto given_up =
      e.kind() == FailureKind::deadlock || (e.kind() == FailureKind::no_answer && took > grace);
    if (given_up) {
      may_lapse(x.entry, 0, x.invoked);
      history_.push_back(x);
      return;
    }
    if (!status)
      findings_.push_back("an operation that cannot end so: " + std::string{e.what()});
    x.result = {status.value_or(Status::timed_out)};
  }
  x.returned = world->now();
  known_to_have_arrived(x);
  learn(x);
  history_.push_back(x);
}

/// As its runtime does.
void Player::learn(const OperationRecord& x) {
  auto& view = views_[x.entry];
  auto ok = x.result.status == Status::ok;
  switch (x.kind) {
    case OperationKind::overwrite:
    case OperationKind::add:
      view.present = x.result.status != Status::does_not_exist;
      if (ok) {
        view.seen = x.result.version;
        view.written.insert(x.result.version);
      }
      break;
    case OperationKind::read:
      view.present = ok;
      view.seen = ok                                          ? std::optional{x.result.version}
                  : x.result.status == Status::does_not_exist ? std::nullopt
                                                              : view.seen;
      break;
    case OperationKind::remove:
      if (ok) {
        view.present = false;
        view.seen.reset();
        view.token = 0;
        view.times = 0;
      }
      break;
    case OperationKind::exists:
      view.present = ok;
      break;
    case OperationKind::lock:
    case OperationKind::try_lock:
      if (!ok)
        break;
      if (view.token != x.result.token) {
        view.token = x.result.token;
        view.times = 0;
        may_lapse(x.entry, x.result.token, x.invoked + Tick(world->lease_duration.count()));
      }
      ++view.times;
      break;
    case OperationKind::unlock:
      if (view.token == x.token && --view.times == 0)
        view.token = 0;
      break;
    default:
      break;
  }
}

/// What was sent before an operation that is answered has reached the working memory too.
void Player::known_to_have_arrived(const OperationRecord& answered) {
  for (auto& [x, answer] : reads_)
    if (x.invoked < answered.invoked && x.queued_by == never &&
        address(x).subarchitecture == address(answered).subarchitecture)
      x.queued_by = answered.returned;
}

void Player::may_lapse(std::uint32_t entry, Token token, Tick from) {
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = OperationKind::lapse;
  x.token = token;
  x.invoked = from;
  history_.push_back(x);
}

/// Of one who dies now, the guards give back their leases, unless his death ends them first.
void Player::hand_in() {
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
    for (auto& guard : views_[entry].guards) {
      auto x = planned(entry, OperationKind::unlock);
      x.token = guard.token();
      history_.push_back(x);
    }
    if (auto token = views_[entry].token; token != 0)
      may_lapse(entry, token, world->now());
  }
  std::lock_guard guard{world->mutex};
  world->history.insert(world->history.end(), history_.begin(), history_.end());
  world->findings.insert(world->findings.end(), findings_.begin(), findings_.end());
}

} // namespace castor::linearizability
