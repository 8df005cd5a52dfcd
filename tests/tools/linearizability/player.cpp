#include "castor/tests/tools/linearizability/player.hpp"

#include "castor/actors/component/registry.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace castor::linearizability {

CASTOR_COMPONENT(Player, "operates on entries at random and writes down what it sees")
CASTOR_COMPONENT(Closer, "looks at how the entries stand in the end")

namespace {

using namespace std::chrono_literals;

/// A wait that lasts longer than this was given up by the component and not by the working memory,
/// which may have granted it meanwhile: the component gives the working memory a second, and no
/// time-outs of locks are longer than this.
constexpr auto grace = 500ms;
constexpr std::size_t longest_lock_wait_ms = 20;

/// How often who waits for others looks whether they are there.
constexpr auto poll_interval = 100us;

constexpr std::size_t operations_per_player = 60;
/// What a player may have begun before it sees that others have begun enough, with all that it has
/// to unlock in the end.
constexpr std::size_t reserve = 4;

} // namespace

void Player::run() {
  world_.emplace(path_.get());
  settings_ = world_->settings();
  number_ = Client(std::stoul(component_name().substr(1)));
  random_.seed(settings_.seed * 1000 + number_);
  views_.resize(settings_.homes.size());
  auto dies = chance(10);
  world_->enter();
  try {
    while (!world_->all_have_entered() && sleep_for(poll_interval))
      continue;
    play(dies);
  } catch (...) {
    // It was stopped, or its own working memory is lost.
    leave();
    throw;
  }
  leave();
  // Without its own working memory it could give nothing back.
  if (dies || home_lost_)
    throw std::runtime_error("dies on purpose");
}

void Player::play(bool dies) {
  for (std::size_t i = 0; i < operations_per_player && !home_lost_ && !(dies && chance(5)); ++i) {
    act();
    if (chance(settings_.pauses))
      sleep_for(settings_.longest_pause * pick(100) / 100);
  }
  take_reads();
  if (!dies)
    unlock_all();
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
  if (views_[entry].lost || world_->is_worn_out(entry, reserve))
    return;
  auto kind = pick_kind(views_[entry]);
  if (kind == OperationKind::unlock) {
    unlock_one(entry);
    return;
  }
  if (kind == OperationKind::add || kind == OperationKind::overwrite ||
      kind == OperationKind::remove) {
    write(entry, kind);
    return;
  }
  auto x = begin(entry, kind);
  switch (kind) {
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

Player::Attempt Player::begin(std::uint32_t entry, OperationKind kind, Token token,
                              std::optional<Version> last_seen) {
  Attempt x;
  x->client = number_;
  x->entry = entry;
  x->kind = kind;
  if (kind == OperationKind::add || kind == OperationKind::overwrite)
    x->content = world_->new_content();
  x->last_seen = last_seen;
  x->token = token;
  x->level = LockLevel(1 + pick(3));
  x->invoked = world_->now();
  x.number = world_->begin(x.record);
  return x;
}

/// Several overwrites at once, sometimes: each counts on the one before.
void Player::write(std::uint32_t entry, OperationKind kind) {
  auto& view = views_[entry];
  auto overwrites = kind == OperationKind::overwrite;
  auto seen_before = view.seen;
  auto seen = seen_before;
  std::vector<PendingWrite> sent;
  for (auto count = overwrites && chance(20) ? 3 : 1; count > 0; --count) {
    auto adds = kind == OperationKind::add;
    auto x = begin(entry, kind, adds ? 0 : view.token, overwrites ? seen : std::nullopt);
    Stamp stamp{std::int64_t(x->content)};
    auto answer = overwrites ? overwrite_async(address(x), stamp)
                  : adds     ? add_async(address(x), stamp)
                             : delete_entry_async(address(x));
    sent.push_back({x, std::move(answer)});
    if (seen)
      seen = *seen + 1;
  }
  for (auto& [x, answer] : sent)
    take(x, [&, &attempt = x, &y = answer](Result& result) {
      auto& last_seen = attempt->last_seen;
      // Who failed to write a version cannot count on it, unless by an earlier write.
      auto failed_before =
        last_seen && last_seen != seen_before && !view.written.contains(*last_seen);
      try {
        result = {Status::ok, y.get()};
      } catch (const WorkingMemoryException&) {
        if (failed_before)
          last_seen.reset();
        throw;
      }
      if (failed_before && !view.in_doubt)
        last_seen.reset();
    });
}

void Player::write_several() {
  auto home = settings_.homes[pick(views_.size())];
  WriteBatch batch;
  std::vector<Attempt> attempts;
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
    auto& view = views_[entry];
    if (settings_.homes[entry] != home)
      continue;
    if (view.lost)
      return;
    auto x = view.present ? begin(entry, OperationKind::overwrite, view.token, view.seen)
                          : begin(entry, OperationKind::add);
    Stamp stamp{std::int64_t(x->content)};
    if (view.present)
      batch.overwrite(address(x), stamp);
    else
      batch.add(address(x), stamp);
    attempts.push_back(x);
  }
  std::vector<Version> versions;
  try {
    versions = SubarchitectureComponent::write(batch);
  } catch (const WorkingMemoryException& e) {
    for (auto& x : attempts) {
      if (is_undecided(e, x) || address(x) == e.address())
        take(x, [&](Result&) { throw; });
      else
        world_->drop(x.number);
    }
    return;
  }
  for (std::size_t i = 0; i < attempts.size(); ++i)
    take(attempts[i], [&](Result& result) { result = {Status::ok, versions[i]}; });
}

void Player::read_later(const Attempt& x) {
  reads_.push_back({x, read_async<Stamp>(address(x))});
}

void Player::take_reads() {
  for (auto& [x, answer] : std::exchange(reads_, {}))
    take(x, [&, &y = answer](Result& result) {
      auto found = y.get();
      result = {Status::ok, found.version, Content(found->number)};
    });
}

void Player::lock_one(Attempt x) {
  std::chrono::milliseconds timeout{1 + pick(longest_lock_wait_ms)};
  std::optional<LockGuard> guard;
  take(x, [&](Result& result) {
    auto level = level_of(x->level);
    if (x->kind == OperationKind::lock)
      guard.emplace(lock(address(x), level, timeout));
    else
      guard = try_lock(address(x), level);
    result = {guard ? Status::ok : Status::busy, 0, 0, guard ? guard->token() : 0};
  });
  if (guard)
    views_[x->entry].guards.push_back(*std::move(guard));
}

void Player::unlock_one(std::uint32_t entry) {
  auto& view = views_[entry];
  auto guard = std::move(view.guards.back());
  view.guards.pop_back();
  // Who has deleted the entry has nothing to give back.
  if (view.token == 0) {
    guard.unlock();
    return;
  }
  auto x = begin(entry, OperationKind::unlock, guard.token());
  take(x, [&](Result&) {
    guard.unlock();
    // Who is told to stop does not wait for the answer.
    if (!is_running())
      throw ComponentStopped{};
  });
}

void Player::unlock_all() {
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry)
    while (!views_[entry].guards.empty() && !views_[entry].lost && !home_lost_)
      unlock_one(entry);
}

// -- what came of them

template <class F>
void Player::take(Attempt& x, F&& result) {
  try {
    result(x->result);
  } catch (const WorkingMemoryException& e) {
    if (is_undecided(e, x)) {
      note_undecided(e, x);
      return;
    }
    auto status = status_of(e.kind(), x->kind);
    if (!status)
      world_->report("an operation that cannot end so: " + std::string{e.what()});
    x->result = {status.value_or(Status::timed_out)};
  }
  x->returned = world_->now();
  world_->end(x.number, x.record);
  known_to_have_arrived(x.record);
  learn(x.record);
}

/// Whether nobody knows if the operation was made, is still on its way, or never will be.
bool Player::is_undecided(const WorkingMemoryException& e, const Attempt& x) const {
  switch (e.kind()) {
    case FailureKind::deadlock:
    case FailureKind::working_memory_lost:
      return true;
    case FailureKind::no_answer:
      return !x->may_wait() || std::chrono::nanoseconds{world_->now() - x->invoked} > grace;
    default:
      return false;
  }
}

void Player::note_undecided(const WorkingMemoryException& e, const Attempt& x) {
  auto& view = views_[x->entry];
  view.in_doubt |= x->kind == OperationKind::add || x->kind == OperationKind::overwrite;
  // As its runtime does, which has nothing in hand any more.
  if (x->kind == OperationKind::unlock)
    learn(x.record);
  auto said_to_be_lost = e.kind() == FailureKind::working_memory_lost;
  auto entry_lost = world_->is_lost(address(x).subarchitecture);
  auto home_lost = world_->is_lost(subarchitecture());
  if (said_to_be_lost && !entry_lost && !home_lost && !settings_.may_lose)
    world_->report("a working memory that lives is said to be lost: " + std::string{e.what()});
  // To go on trying, now and then, shows that nothing is answered.
  if (!said_to_be_lost && chance(30))
    return;
  view.lost = entry_lost || said_to_be_lost;
  home_lost_ = home_lost || std::ranges::all_of(views_, &View::lost);
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
    if (x->invoked < answered.invoked && x->queued_by == never &&
        settings_.homes[x->entry] == settings_.homes[answered.entry])
      x->queued_by = answered.returned;
}

/// Of one who goes with leases in hand, the guards give them back, unless his end ends them first.
void Player::leave() {
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry)
    for (auto& guard : views_[entry].guards)
      begin(entry, OperationKind::unlock, guard.token());
  world_->leave(number_);
}

// -- Closer

void Closer::run() {
  World world{path_.get()};
  while (!world.may_close() && sleep_for(poll_interval))
    continue;
  if (!world.may_close())
    return;
  for (std::uint32_t entry = 0; entry < world.settings().homes.size(); ++entry)
    if (!world.is_lost(world.address(entry).subarchitecture))
      look_at(world, entry);
  world.close();
}

void Closer::look_at(World& world, std::uint32_t entry) {
  auto at = world.address(entry);
  auto note = [&](OperationKind kind, Tick invoked, const Result& result) {
    OperationRecord x;
    x.entry = entry;
    x.kind = kind;
    x.level = LockLevel::odr;
    x.invoked = invoked;
    auto number = world.begin(x);
    x.result = result;
    x.returned = world.now();
    world.end(number, x);
  };
  auto invoked = world.now();
  try {
    auto guard = lock(at, castor::LockLevel::odr);
    note(OperationKind::lock, invoked, {.token = guard.token()});
    invoked = world.now();
    auto found = read<Stamp>(at);
    note(OperationKind::read, invoked, {Status::ok, found.version, Content(found->number)});
  } catch (const DoesNotExistOnWM&) {
    note(OperationKind::exists, invoked, {Status::does_not_exist});
  } catch (const WorkingMemoryException& e) {
    if (!world.settings().may_lose)
      world.report("what cannot be looked at in the end: " + std::string{e.what()});
  }
}

} // namespace castor::linearizability
