#include "castor/actors/runtime/command_gate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Time = CommandGate::Time;

Time at(std::chrono::microseconds x) {
  return Time{} + 1h + x;
}

const ClientPtr driver = std::make_shared<const Client>(Client{"driver", "nav", 1});
const ClientPtr joystick = std::make_shared<const Client>(Client{"joystick", "people", 4});

class CommandGateTest : public testing::Test {
protected:
  CommandGate::Offer offer(const ClientPtr& commander, LeaseToken token, Time sent,
                           std::chrono::microseconds valid_for = 300ms) {
    return {++ticket_, commander, token, sent, valid_for, {}};
  }

  /// "obeyed", or why not; "waits" if nothing is decided.
  static std::string outcome(CommandGate& gate, Time now) {
    auto x = gate.decide(now);
    if (!x)
      return "waits";
    return x->refusal.empty() ? "obeyed" : x->refusal;
  }

  std::string outcome(CommandGate& gate, CommandGate::Offer x, Time now) {
    gate.offer(std::move(x), now);
    return outcome(gate, now);
  }

  std::string confirm(const CommandGate::Confirmation& x, Time now) {
    gate_.confirm(x);
    return outcome(gate_, now);
  }

  /// Commands `gate_`, and answers its question, if it has one.
  std::string command(const ClientPtr& commander, LeaseToken token, Time now, LeaseToken truth,
                      const ClientPtr& holder) {
    auto result = outcome(gate_, offer(commander, token, now), now);
    return result == "waits" && gate_.should_ask(now) ? confirm({now, truth, holder}, now) : result;
  }

  std::uint64_t ticket_ = 0;
  CommandGate open_{"wheel", {500ms, std::nullopt}};
  CommandGate gate_{"wheel", {500ms, Address{"nav", "drive"}}};
};

TEST_F(CommandGateTest, WithoutALeaseAnybodyIsObeyedUntilTheCommandExpires) {
  EXPECT_EQ(outcome(open_, offer(driver, 0, at(0ms)), at(1ms)), "obeyed");
  EXPECT_FALSE(open_.should_ask(at(1ms)));
  EXPECT_EQ(open_.next_alarm(), at(300ms));
  EXPECT_FALSE(open_.take_safe_state(at(299ms)));
  EXPECT_EQ(open_.take_safe_state(at(300ms)), SafeStateCause::expired);
  EXPECT_FALSE(open_.take_safe_state(at(301ms)));
  EXPECT_FALSE(open_.next_alarm());
}

TEST_F(CommandGateTest, ObeysOnlyTheCommanderThatItIsTold) {
  CommandGate gate{"wheel", {500ms, std::nullopt, "driver"}};
  EXPECT_EQ(outcome(gate, offer(joystick, 0, at(0ms)), at(1ms)),
            "wheel obeys only driver, not joystick of people: command that one");
  EXPECT_EQ(outcome(gate, offer(driver, 0, at(2ms)), at(3ms)), "obeyed");
  // It is obeyed again after it was restarted.
  const auto next = std::make_shared<const Client>(Client{"driver", "nav", 2});
  EXPECT_EQ(outcome(gate, offer(next, 0, at(4ms)), at(5ms)), "obeyed");
}

TEST_F(CommandGateTest, NoCommandHoldsForLongerThanTheEffectorAllows) {
  outcome(open_, offer(driver, 0, at(0ms), 10s), at(100ms));
  EXPECT_EQ(open_.in_force()->until, at(500ms));
}

TEST_F(CommandGateTest, ANewCommandTakesThePlaceOfTheLast) {
  outcome(open_, offer(driver, 0, at(0ms)), at(0ms));
  outcome(open_, offer(joystick, 0, at(200ms)), at(200ms));
  EXPECT_FALSE(open_.take_safe_state(at(400ms)));
  open_.forget(*driver);
  EXPECT_FALSE(open_.take_safe_state(at(400ms)));
  open_.forget(*joystick);
  EXPECT_EQ(open_.next_alarm(), Time{});
  EXPECT_EQ(open_.take_safe_state(at(400ms)), SafeStateCause::commander_ended);
}

TEST_F(CommandGateTest, ACommandThatWasOnItsWayForTooLongIsRefused) {
  EXPECT_EQ(outcome(open_, offer(driver, 0, at(0ms), 200ms), at(1530ms)),
            "the command arrived 1.53 s after it was sent, and is valid for 0.2 s");
  EXPECT_FALSE(open_.in_force());
}

TEST_F(CommandGateTest, WhoHoldsNoLeaseIsRefusedWithoutAQuestion) {
  EXPECT_EQ(outcome(gate_, offer(driver, 0, at(0ms)), at(0ms)),
            "wheel obeys only the holder of the lease of nav/drive; driver of nav holds none");
  EXPECT_FALSE(gate_.should_ask(at(0ms)));
}

TEST_F(CommandGateTest, TheHolderIsObeyedOnceTheWorkingMemoryHasConfirmedIt) {
  EXPECT_EQ(outcome(gate_, offer(driver, 7, at(0ms)), at(0ms)), "waits");
  EXPECT_EQ(gate_.next_alarm(), Time{});
  EXPECT_TRUE(gate_.should_ask(at(0ms)));
  EXPECT_FALSE(gate_.should_ask(at(1ms)));
  EXPECT_EQ(confirm({at(0ms), 7, driver}, at(2ms)), "obeyed");
  // The next within the time that the confirmation is trusted for need no other.
  EXPECT_EQ(outcome(gate_, offer(driver, 7, at(50ms)), at(50ms)), "obeyed");
}

TEST_F(CommandGateTest, AStaleTokenIsRefusedInWords) {
  EXPECT_EQ(command(joystick, 8, at(0ms), 8, joystick), "obeyed");
  EXPECT_EQ(
    command(driver, 7, at(1ms), 8, joystick),
    "wheel obeys only the holder of the lease of nav/drive; that of driver of nav (token 7) "
    "has ended, now joystick of people holds it (token 8)");
  EXPECT_EQ(
    command(driver, 9, at(2ms), 8, joystick),
    "wheel obeys only the holder of the lease of nav/drive; that of driver of nav (token 9) "
    "has ended, now joystick of people holds it (token 8)");
  // Another incarnation of the holder is another client.
  auto restarted = std::make_shared<const Client>(Client{"joystick", "people", 5});
  EXPECT_NE(command(restarted, 8, at(3ms), 8, joystick), "obeyed");
}

TEST_F(CommandGateTest, AnAnswerSaysNothingOfWhoCameAfterTheQuestion) {
  gate_.offer(offer(driver, 7, at(0ms)), at(0ms));
  ASSERT_TRUE(gate_.should_ask(at(0ms)));
  gate_.offer(offer(joystick, 8, at(5ms)), at(5ms));
  EXPECT_EQ(confirm({at(0ms), 7, driver}, at(6ms)), "obeyed");
  EXPECT_EQ(gate_.in_force()->commander, driver);
  EXPECT_EQ(outcome(gate_, at(6ms)), "waits");
  ASSERT_TRUE(gate_.should_ask(at(6ms)));
  EXPECT_EQ(confirm({at(6ms), 8, joystick}, at(7ms)), "obeyed");
  EXPECT_EQ(gate_.in_force()->commander, joystick);
  EXPECT_FALSE(gate_.take_safe_state(at(8ms)));
}

TEST_F(CommandGateTest, WhileACommandHoldsItsLeaseIsConfirmedAgain) {
  command(driver, 7, at(0ms), 7, driver);
  EXPECT_EQ(gate_.next_alarm(), at(40ms));
  EXPECT_FALSE(gate_.should_ask(at(39ms)));
  EXPECT_TRUE(gate_.should_ask(at(40ms)));
  gate_.confirm({at(40ms), 7, driver});
  EXPECT_EQ(gate_.next_alarm(), at(80ms));
  ASSERT_TRUE(gate_.should_ask(at(80ms)));
  gate_.confirm({at(80ms), 0, nullptr});
  EXPECT_EQ(gate_.take_safe_state(at(81ms)), SafeStateCause::lease_ended);
}

TEST_F(CommandGateTest, WithoutConfirmationTheSafeStateIsTakenInTime) {
  command(driver, 7, at(0ms), 7, driver);
  EXPECT_TRUE(gate_.should_ask(at(40ms)));
  EXPECT_TRUE(gate_.should_ask(at(80ms)));
  EXPECT_FALSE(gate_.take_safe_state(at(99ms)));
  EXPECT_EQ(gate_.take_safe_state(at(100ms)), SafeStateCause::lease_unconfirmed);
}

TEST_F(CommandGateTest, ALateAnswerConfirmsNothing) {
  gate_.offer(offer(driver, 7, at(0ms)), at(0ms));
  ASSERT_TRUE(gate_.should_ask(at(0ms)));
  EXPECT_EQ(confirm({at(0ms), 7, driver}, at(150ms)), "waits");
  EXPECT_TRUE(gate_.should_ask(at(150ms)));
  EXPECT_FALSE(gate_.in_force());
}

TEST_F(CommandGateTest, WhileTheEffectorIsBusyAConfirmationGrowsOld) {
  gate_.offer(offer(driver, 7, at(0ms)), at(0ms));
  gate_.offer(offer(driver, 7, at(1ms)), at(1ms));
  ASSERT_TRUE(gate_.should_ask(at(1ms)));
  EXPECT_EQ(confirm({at(1ms), 7, driver}, at(2ms)), "obeyed");
  // It obeys for 200 ms; who knows whose the lease is then?
  EXPECT_EQ(outcome(gate_, at(202ms)), "waits");
  EXPECT_TRUE(gate_.should_ask(at(202ms)));
}

TEST_F(CommandGateTest, WithoutAWorkingMemoryNobodyIsObeyed) {
  gate_.offer(offer(driver, 7, at(0ms)), at(0ms));
  ASSERT_TRUE(gate_.should_ask(at(0ms)));
  gate_.cannot_confirm("it is down", at(1ms));
  EXPECT_EQ(outcome(gate_, at(1ms)),
            "wheel cannot confirm that driver of nav holds the lease of nav/drive: it is down");
}

TEST_F(CommandGateTest, WhoWaitsForAnAnswerInVainIsToldSo) {
  gate_.offer(offer(driver, 7, at(0ms)), at(0ms));
  ASSERT_TRUE(gate_.should_ask(at(0ms)));
  EXPECT_EQ(outcome(gate_, at(299ms)), "waits");
  EXPECT_EQ(outcome(gate_, at(300ms)), "wheel cannot confirm that driver of nav holds the lease of "
                                       "nav/drive: no answer in 0.3 s");
}

TEST_F(CommandGateTest, AnOlderAnswerDoesNotOverruleANewerOne) {
  command(joystick, 8, at(50ms), 8, joystick);
  EXPECT_EQ(confirm({at(10ms), 7, driver}, at(60ms)), "waits");
  EXPECT_FALSE(gate_.take_safe_state(at(61ms)));
  EXPECT_EQ(outcome(gate_, offer(joystick, 8, at(62ms)), at(62ms)), "obeyed");
}

// -- any course of events

/// A working memory that grants one lease after the other, and answers with delays; commanders that
/// command whether or not they still hold the lease; and a gate between them.
class SimulatedCommands {
public:
  /// When each token was granted, and when its lease ended.
  struct Tenure {
    Time from;
    std::optional<Time> until;
  };

  struct Obeyed {
    LeaseToken token = 0;
    Time from;
    std::optional<Time> until;
  };

  void run() {
    for (int step = 0; step < 200; ++step) {
      now_ += *rc::gen::inRange(0, 30) * 1ms;
      answer();
      switch (*rc::gen::inRange(0, 6)) {
        case 0:
          grant();
          break;
        case 1:
          end_lease();
          break;
        case 2:
          is_silent_ = !is_silent_;
          break;
        default:
          command();
      }
      work();
    }
  }

  std::map<LeaseToken, Tenure> tenures;
  std::vector<Obeyed> obeyed;
  std::size_t decided = 0;
  std::size_t offered = 0;

private:
  void end_lease() {
    if (held_ && !tenures[last_].until)
      tenures[last_].until = now_;
    held_ = false;
  }

  void grant() {
    end_lease();
    held_ = true;
    tenures[++last_] = {now_, std::nullopt};
  }

  static ClientPtr commander(LeaseToken token) { return token % 2 == 0 ? driver : joystick; }

  void command() {
    if (last_ == 0)
      return;
    auto token = static_cast<LeaseToken>(*rc::gen::inRange<int>(
      std::max(0, static_cast<int>(last_) - 2), static_cast<int>(last_) + 1));
    auto sent = now_ - *rc::gen::inRange(0, 20) * 1ms;
    if (token > 0 && sent < tenures[token].from)
      sent = tenures[token].from;
    ++offered;
    gate_.offer({offered, commander(token), token, sent, 100ms, {}}, now_);
  }

  void work() {
    decide();
    if (gate_.take_safe_state(now_))
      end_force();
    if (gate_.should_ask(now_) && !is_silent_)
      answers_.push_back({{now_, held_ ? last_ : 0, held_ ? commander(last_) : nullptr},
                          now_ + *rc::gen::inRange(0, 150) * 1ms});
  }

  void answer() {
    auto due = std::stable_partition(answers_.begin(), answers_.end(),
                                     [&](auto& x) { return x.second > now_; });
    std::vector<CommandGate::Confirmation> arrived;
    for (auto i = due; i != answers_.end(); ++i)
      arrived.push_back(i->first);
    answers_.erase(due, answers_.end());
    for (auto& x : arrived)
      gate_.confirm(x);
  }

  void decide() {
    while (auto x = gate_.decide(now_)) {
      ++decided;
      if (!x->refusal.empty())
        continue;
      end_force();
      obeyed.push_back({x->offer.token, now_, std::nullopt});
    }
  }

  void end_force() {
    if (!obeyed.empty() && !obeyed.back().until)
      obeyed.back().until = now_;
  }

  Time now_ = at(0ms);
  CommandGate gate_{"wheel", {100ms, Address{"nav", "drive"}}};
  LeaseToken last_ = 0;
  bool held_ = false;
  bool is_silent_ = false;
  std::vector<std::pair<CommandGate::Confirmation, Time>> answers_;
};

RC_GTEST_PROP(CommandGateProperties, NobodyIsObeyedForLongerThanTrustedAfterTheEndOfHisLease, ()) {
  SimulatedCommands x;
  x.run();
  LeaseToken newest = 0;
  for (auto& y : x.obeyed) {
    RC_ASSERT(y.token > 0U);
    // Never a predecessor again.
    RC_ASSERT(y.token >= newest);
    newest = y.token;
    auto& tenure = x.tenures.at(y.token);
    RC_ASSERT(tenure.from <= y.from);
    if (tenure.until) {
      // The simulation's time goes in steps of up to 30 ms.
      RC_ASSERT(y.from <= *tenure.until + CommandGate::trusted_for + 30ms);
      if (y.until)
        RC_ASSERT(*y.until <= *tenure.until + CommandGate::trusted_for + 30ms);
    }
  }
  RC_ASSERT(x.decided <= x.offered);
  RC_CLASSIFY(!x.obeyed.empty(), "some obeyed");
}

} // namespace

} // namespace castor::test
