#include "castor/wm/leases/lease_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// Leases the simple way: one list of leases, one of waits, both searched from end to end, and
/// everything looked at again after every step.
class NaiveLeases {
public:
  struct Held {
    std::string id;
    int client;
    LeaseToken token;
    WaitNumber number;
    Timestamp expires;
    std::vector<LockLevel> levels;
  };
  struct Wait {
    std::string id;
    int client;
    WaitNumber number;
    std::optional<LockLevel> level;
    Timestamp deadline;
  };
  /// Client, number, result, token.
  using Settled = std::tuple<int, WaitNumber, SettledWait::Result, LeaseToken>;

  explicit NaiveLeases(Timestamp duration) : duration_(duration) {}

  Held* find(const std::string& id) {
    for (auto& x : held)
      if (x.id == id)
        return &x;
    return nullptr;
  }

  static LockLevel level_of(const Held& x) {
    return *std::max_element(x.levels.begin(), x.levels.end());
  }

  bool blocks_reading(const std::string& id, int client) {
    auto* x = find(id);
    return x && x->client != client && level_of(*x) == LockLevel::odr;
  }

  LeaseToken lock(const std::string& id, int client, LockLevel level, WaitNumber number,
                  Timestamp now, std::optional<Timestamp> deadline) {
    if (auto* x = find(id)) {
      if (x->client == client) {
        x->levels.push_back(level);
        return x->token;
      }
      if (deadline)
        waits.push_back({id, client, number, level, *deadline});
      return 0;
    }
    held.push_back({id, client, ++last_token, number, now + duration_, {level}});
    return last_token;
  }

  bool unlock(const std::string& id, int client, LeaseToken token, Timestamp now) {
    auto* x = find(id);
    if (!x || x->client != client || x->token != token)
      return false;
    x->levels.pop_back();
    if (x->levels.empty())
      std::erase_if(held, [&](auto& y) { return y.id == id; });
    serve(id, now);
    return true;
  }

  bool renew(const std::string& id, int client, LeaseToken token, Timestamp now) {
    auto* x = find(id);
    if (!x || x->client != client || x->token != token)
      return false;
    auto renewed = *x;
    renewed.expires = now + duration_;
    std::erase_if(held, [&](auto& y) { return y.id == id; });
    held.push_back(renewed);
    return true;
  }

  void cancel(const std::string& id, int client, WaitNumber number, Timestamp now) {
    std::erase_if(waits, [&](auto& x) { return x.client == client && x.number == number; });
    std::erase_if(held,
                  [&](auto& x) { return x.id == id && x.client == client && x.number == number; });
    serve(id, now);
  }

  void drop(int client, Timestamp now) {
    std::erase_if(waits, [&](auto& x) { return x.client == client; });
    auto before = held;
    std::erase_if(held, [&](auto& x) { return x.client == client; });
    for (auto& x : before)
      serve(x.id, now);
  }

  void erase(const std::string& id) {
    std::erase_if(held, [&](auto& x) { return x.id == id; });
    for (auto& x : waits)
      if (x.id == id)
        settled.insert({x.client, x.number, SettledWait::Result::deleted, 0});
    std::erase_if(waits, [&](auto& x) { return x.id == id; });
  }

  void expire(Timestamp now) {
    for (auto& x : waits)
      if (x.deadline <= now)
        settled.insert({x.client, x.number, SettledWait::Result::timed_out, 0});
    std::erase_if(waits, [&](auto& x) { return x.deadline <= now; });
    while (!held.empty() && held.front().expires <= now) {
      auto id = held.front().id;
      held.erase(held.begin());
      serve(id, now);
    }
  }

  /// Settles, again and again, the first wait that can be.
  void serve(const std::string& id, Timestamp now) {
    for (bool again = true; again;) {
      again = false;
      for (auto i = waits.begin(); i != waits.end() && !again; ++i) {
        if (i->id != id)
          continue;
        auto* x = find(id);
        if (!i->level && !blocks_reading(id, i->client)) {
          settled.insert({i->client, i->number, SettledWait::Result::readable, 0});
        } else if (i->level && !x) {
          held.push_back({id, i->client, ++last_token, i->number, now + duration_, {*i->level}});
          settled.insert({i->client, i->number, SettledWait::Result::granted, last_token});
        } else {
          continue;
        }
        waits.erase(i);
        again = true;
      }
    }
  }

  /// The next to expire first.
  std::vector<Held> held;
  std::vector<Wait> waits;
  LeaseToken last_token = 0;
  std::multiset<Settled> settled;

private:
  Timestamp duration_;
};

/// Steps of random operations on a table and on the model at once, compared after each.
void compare_with_model(std::uint32_t seed, int steps) {
  std::mt19937 random{seed};
  auto upto = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  constexpr Timestamp duration = 50us;
  LeaseTable table{{.duration = duration}};
  NaiveLeases model{duration};
  std::vector<ClientPtr> clients;
  for (int i = 0; i < 5; ++i)
    clients.push_back(
      std::make_shared<const Client>(Client{std::string(1, static_cast<char>('p' + i)), "a", 1}));
  Timestamp now{0};
  WaitNumber number = 0;
  LeaseToken last_seen_token = 0;
  for (int step = 0; step < steps; ++step) {
    now += Timestamp{upto(12)};
    table.expire(now);
    model.expire(now);
    auto id = std::string(1, static_cast<char>('x' + upto(3)));
    auto who = upto(5);
    auto& client = clients[static_cast<std::size_t>(who)];
    auto level = static_cast<LockLevel>(upto(3));
    auto* held = model.find(id);
    // Mostly the right token, sometimes one of the past or of nobody.
    auto token = held && upto(8) > 0 ? held->token : static_cast<LeaseToken>(upto(20));
    if (held && upto(3) > 0)
      who = held->client;
    switch (auto what = upto(20)) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4: {
        bool patient = what > 0;
        Timestamp deadline = now + Timestamp{1 + upto(200)};
        auto& c = clients[static_cast<std::size_t>(who)];
        ++number;
        auto lease = patient ? table.lock(id, c, level, number, now, deadline)
                             : table.try_lock(id, c, level, number, now);
        ASSERT_EQ(lease ? lease->token : 0,
                  model.lock(id, who, level, number, now,
                             patient ? std::optional{deadline} : std::nullopt));
        break;
      }
      case 5:
      case 6:
      case 7:
      case 8:
        ASSERT_EQ(table.unlock(id, *clients[static_cast<std::size_t>(who)], token, now),
                  model.unlock(id, who, token, now));
        break;
      case 9:
      case 10:
        ASSERT_EQ(table.renew(id, *clients[static_cast<std::size_t>(who)], token, now),
                  model.renew(id, who, token, now));
        break;
      case 11:
      case 12:
      case 13:
        ASSERT_EQ(table.may_read(id, *client),
                  !model.blocks_reading(id, static_cast<int>(client->component[0] - 'p')));
        if (!table.may_read(id, *client)) {
          auto reader = static_cast<int>(client->component[0] - 'p');
          table.wait_to_read(id, client, ++number, now + 40us);
          model.waits.push_back({id, reader, number, std::nullopt, now + 40us});
        }
        break;
      case 14:
        table.erase(id);
        model.erase(id);
        break;
      case 15:
        if (!model.waits.empty()) {
          auto wait =
            model.waits[static_cast<std::size_t>(upto(static_cast<int>(model.waits.size())))];
          table.cancel(wait.id, *clients[static_cast<std::size_t>(wait.client)], wait.number, now);
          model.cancel(wait.id, wait.client, wait.number, now);
        }
        break;
      case 16:
        if (held) {
          auto holder = held->client;
          auto granted = held->number;
          table.cancel(id, *clients[static_cast<std::size_t>(holder)], granted, now);
          model.cancel(id, holder, granted, now);
        }
        break;
      case 17:
        if (upto(4) == 0) {
          table.drop(*clients[static_cast<std::size_t>(who)], now);
          model.drop(who, now);
        }
        break;
      default: {
        auto operation = upto(2) == 0 ? Operation::overwrite : Operation::remove;
        auto writer = static_cast<int>(client->component[0] - 'p');
        auto used = upto(2) == 0 ? 0 : token;
        auto* x = model.find(id);
        auto expected = LeaseTable::Verdict::permitted;
        if (used != 0)
          expected =
            x && x->client == writer && x->token == used ? expected : LeaseTable::Verdict::stale;
        else if (x &&
                 !(operation == Operation::remove && NaiveLeases::level_of(*x) == LockLevel::o))
          expected = LeaseTable::Verdict::leased;
        ASSERT_EQ(table.check(id, *client, operation, used), expected);
      }
    }
    std::multiset<NaiveLeases::Settled> settled;
    for (auto& x : table.take_settled()) {
      settled.insert({x.client->component[0] - 'p', x.number, x.result, x.lease.token});
      if (x.result == SettledWait::Result::granted) {
        ASSERT_GT(x.lease.token, 0u);
      }
    }
    ASSERT_EQ(settled, model.settled) << "seed " << seed << ", step " << step;
    model.settled.clear();
    ASSERT_EQ(table.size(), model.held.size());
    ASSERT_EQ(table.empty(), model.held.empty());
    Timestamp next = Timestamp::max();
    for (auto& x : model.held) {
      auto* y = table.holding(x.id);
      ASSERT_TRUE(y);
      ASSERT_EQ(y->lease.token, x.token);
      ASSERT_EQ(y->lease.level, NaiveLeases::level_of(x));
      ASSERT_EQ(y->lease.expires, x.expires);
      ASSERT_EQ(y->levels, x.levels);
      ASSERT_EQ(y->holder->component[0] - 'p', x.client);
      next = std::min(next, x.expires);
    }
    for (auto& x : model.waits)
      next = std::min(next, x.deadline);
    ASSERT_EQ(table.next_deadline().value_or(Timestamp::max()), next);
    ASSERT_GE(model.last_token, last_seen_token);
    last_seen_token = model.last_token;
  }
}

TEST(LeaseTableProperties, AgreesWithANaiveModelOverAMillionSteps) {
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    compare_with_model(seed, 2000);
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed;
  }
}

} // namespace

} // namespace castor
