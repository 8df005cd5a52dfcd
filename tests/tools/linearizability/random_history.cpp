#include "castor/tests/tools/linearizability/random_history.hpp"

#include "castor/tools/linearizability/entry_model.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace castor::linearizability {

namespace {

constexpr Tick step = 10;

/// A number from `low` to `high`, both included.
template <class T>
T between(Random& random, T low, T high) {
  return std::uniform_int_distribution<T>{low, high}(random);
}

class Scenario {
public:
  Scenario(const RandomHistoryOptions& options, Random& random)
    : options_(options), random_(random), clients_(options.clients), entries_(options.entries) {}

  History play() {
    for (std::size_t i = 0; i < options_.operations; ++i) {
      now_ += step;
      if (chance(options_.lapses))
        lapse(pick_entry());
      if (chance(options_.time_outs))
        time_out(pick_entry());
      end_leases_of_the_dead();
      if (auto client = pick_client())
        act(*client);
    }
    return written_down();
  }

private:
  struct EntryView {
    std::optional<Version> seen;
    Token token = 0;
  };

  struct Player {
    Tick free_from = 1;
    bool waiting = false;
    bool dead = false;
    std::map<std::size_t, EntryView> views;
  };

  struct Entry {
    EntryState state;
    History records;
  };

  bool chance(unsigned percent) { return between(random_, 0U, 99U) < percent; }
  std::size_t pick_entry() { return between<std::size_t>(random_, 0, entries_.size() - 1); }

  std::optional<Client> pick_client() {
    std::vector<Client> free;
    for (Client x = 0; x < clients_.size(); ++x) {
      auto is_busy = clients_[x].waiting || clients_[x].free_from > now_;
      if (!clients_[x].dead && (!is_busy || chance(options_.overlaps)))
        free.push_back(x);
    }
    if (free.empty())
      return std::nullopt;
    return free[between<std::size_t>(random_, 0, free.size() - 1)];
  }

  Tick before(Tick earliest) {
    return between(random_, std::max(earliest, now_ - std::min(now_, options_.width)), now_);
  }
  Tick after() { return now_ + between<Tick>(random_, 0, options_.width); }

  OperationKind pick_kind(const EntryState& state, Client client) {
    using enum OperationKind;
    if (!state.present() && !chance(20))
      return add;
    if (state.leased_by(client) && chance(35))
      return unlock;
    static constexpr OperationKind kinds[] = {
      add,  overwrite, overwrite, overwrite, overwrite, overwrite, remove,   read,   read,
      read, exists,    version,   lock,      lock,      lock,      try_lock, unlock,
    };
    return kinds[between<std::size_t>(random_, 0, std::size(kinds) - 1)];
  }

  void act(Client client) {
    auto at = pick_entry();
    auto& entry = entries_[at];
    auto& view = clients_[client].views[at];
    OperationRecord x;
    x.client = client;
    x.entry = std::uint32_t(at);
    x.kind = pick_kind(entry.state, client);
    x.content = ++contents_;
    x.last_seen = chance(10)   ? std::nullopt
                  : chance(20) ? std::optional{entry.state.version}
                               : view.seen;
    x.level = LockLevel(between(random_, 1, 3));
    bool shows_token = x.kind == OperationKind::unlock || x.kind == OperationKind::overwrite ||
                       x.kind == OperationKind::remove;
    if (shows_token && !chance(10))
      x.token = view.token;
    // What it gets if it obtains a lease: queues are first come, first served.
    if (x.kind == OperationKind::lock || x.kind == OperationKind::try_lock)
      x.result.token = tokens_ += between<Token>(random_, 1, 3);
    x.invoked = before(std::min(clients_[client].free_from, now_));
    if (x.may_wait() && chance(60))
      x.queued_by = after();
    clients_[client].waiting = true;
    arrive(at, x);
    if (chance(options_.deaths))
      die(client, at);
  }

  void arrive(std::size_t at, const OperationRecord& x) {
    auto& entry = entries_[at];
    entry.records.push_back(x);
    auto index = OperationIndex(entry.records.size() - 1);
    std::vector<SettledWait> settled;
    if (auto answer = EntryModel{entry.records}.arrive(entry.state, index, settled))
      settled.push_back({index, *answer});
    for (auto& wait : settled)
      settle(at, wait);
  }

  void settle(std::size_t at, const SettledWait& wait) {
    auto& x = entries_[at].records[wait.operation];
    if (x.kind == OperationKind::lapse)
      return;
    auto& client = clients_[x.client];
    client.waiting = false;
    if (client.dead)
      return;
    x.result = wait.result;
    x.returned = after();
    client.free_from = x.returned + 1;
    auto& view = client.views[at];
    if (wait.result.status != Status::ok)
      return;
    if (x.kind == OperationKind::add || x.kind == OperationKind::overwrite ||
        x.kind == OperationKind::read)
      view.seen = wait.result.version;
    if (wait.result.token != 0)
      view.token = wait.result.token;
  }

  void lapse(std::size_t at) {
    auto& state = entries_[at].state;
    if (!state.leased())
      return;
    OperationRecord x;
    x.client = state.holder;
    x.entry = std::uint32_t(at);
    x.kind = OperationKind::lapse;
    x.token = state.token_known && !chance(10) ? state.token : 0;
    x.mandatory = chance(50);
    x.invoked = before(1);
    x.returned = after();
    if (!x.mandatory && chance(50))
      entries_[at].records.push_back(x);
    else
      arrive(at, x);
  }

  void time_out(std::size_t at) {
    auto& [state, records] = entries_[at];
    if (state.waiting == 0)
      return;
    auto index = state.queue[between<std::size_t>(random_, 0, state.waiting - 1U)];
    EntryModel{records}.give_up(state, index);
    settle(at, {index, Result{Status::timed_out}});
  }

  /// Its last operation is never answered, whether it happened or not.
  void die(Client client, std::size_t at) {
    clients_[client].dead = true;
    auto& x = entries_[at].records.back();
    x.returned = never;
    if (x.result.token != 0 && entries_[at].state.leased_by(client) &&
        entries_[at].state.token == x.result.token)
      entries_[at].state.token_known = false;
    x.result = {};
  }

  void end_leases_of_the_dead() {
    for (std::size_t at = 0; at < entries_.size(); ++at) {
      auto& state = entries_[at].state;
      if (!state.leased() || !clients_[state.holder].dead)
        continue;
      OperationRecord x;
      x.client = state.holder;
      x.entry = std::uint32_t(at);
      x.kind = OperationKind::lapse;
      x.mandatory = true;
      x.invoked = before(now_ - step);
      x.returned = after();
      arrive(at, x);
    }
  }

  History written_down() {
    History result;
    for (auto& entry : entries_)
      for (auto x : entry.records) {
        if (x.pending())
          x.result = {};
        result.push_back(x);
      }
    std::ranges::shuffle(result, random_);
    return result;
  }

  RandomHistoryOptions options_;
  Random& random_;
  std::vector<Player> clients_;
  std::vector<Entry> entries_;
  Tick now_ = 100;
  Content contents_ = 0;
  Token tokens_ = 0;
};

} // namespace

History random_history(const RandomHistoryOptions& options, Random& random) {
  return Scenario{options, random}.play();
}

void falsify(History& history, Random& random) {
  auto& x = history[between<std::size_t>(random, 0, history.size() - 1)];
  auto& other = history[between<std::size_t>(random, 0, history.size() - 1)];
  switch (between(random, 0, 7)) {
    case 0:
      x.result = {Status(between(random, 0, int(Status::timed_out)))};
      break;
    case 1:
      ++x.result.version;
      break;
    case 2:
      --x.result.version;
      break;
    case 3:
      x.result.content = other.content;
      break;
    case 4:
      x.result.token = other.result.token + between<Token>(random, 0, 1);
      break;
    case 5:
      std::swap(x.result, other.result);
      break;
    case 6:
      x.queued_by = x.invoked;
      break;
    default:
      x.invoked += step;
      x.returned = x.pending() ? never : x.returned + step;
      x.queued_by = never;
      break;
  }
}

} // namespace castor::linearizability
