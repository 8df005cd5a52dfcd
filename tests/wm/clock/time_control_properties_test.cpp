#include "castor/wm/clock/time_control.hpp"

#include <rapidcheck/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// Processes whose actors send each other messages, which take any time and overtake each other, as
/// do the orders to go on. Whoever gets a message of a later round goes on to that round first.
class Model {
public:
  explicit Model(std::uint64_t seed)
    : random_(seed), processes_(2 + seed % 4), budget_(static_cast<int>(1 + seed % 40)) {
    for (ClockMember x = 1; x < processes_.size(); ++x)
      control_.add_member(x);
    for (auto& x : processes_)
      x.active = chance(50);
    for (ClockMember x = 0; x < processes_.size(); ++x)
      if (!processes_[x].active)
        report(x);
  }

  /// Number of times at which time went on.
  int run() {
    for (int i = 0; i < 4000 && advances_ < 20; ++i) {
      take_a_step();
      decide();
    }
    return advances_;
  }

private:
  struct Process {
    bool active = false;
    std::uint64_t round = 0;
    MessageCounts counts;
    /// Reports on their way, which keep their order.
    std::vector<ClockReport> reports;
  };

  struct Message {
    ClockMember from = 0;
    ClockMember to = 0;
    std::uint64_t round = 0;
  };

  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  bool chance(unsigned percent) { return below(100) < percent; }

  void report(ClockMember x) {
    auto& process = processes_[x];
    // The next to be woken, if there is one.
    auto next = control_.now() + Timestamp{static_cast<std::int64_t>(1 + below(3))};
    process.reports.push_back(
      {process.round, x == 0 || chance(80) ? next : Timestamp::max(), process.counts});
  }

  void advance(ClockMember x, std::uint64_t round) {
    auto& process = processes_[x];
    if (round <= process.round)
      return;
    process.round = round;
    // A sleeper may be woken.
    process.active = process.active || chance(50);
    if (!process.active)
      report(x);
  }

  void take_a_step() {
    auto x = static_cast<ClockMember>(below(processes_.size()));
    auto& process = processes_[x];
    if (process.active) {
      if (budget_ > 0 && chance(60)) {
        auto to =
          static_cast<ClockMember>((x + 1 + below(processes_.size() - 1)) % processes_.size());
        --budget_;
        ++process.counts.sent[to];
        messages_.push_back({x, to, process.round});
      } else if (chance(50)) {
        process.active = false;
        report(x);
      }
    }
    if (!messages_.empty() && chance(40)) {
      std::swap(messages_[below(messages_.size())], messages_.back());
      auto message = messages_.back();
      messages_.pop_back();
      advance(message.to, message.round);
      ++processes_[message.to].counts.received[message.from];
      processes_[message.to].active = true;
    }
    if (!orders_.empty() && chance(40)) {
      std::swap(orders_[below(orders_.size())], orders_.back());
      auto [to, round] = orders_.back();
      orders_.pop_back();
      advance(to, round);
    }
    auto y = static_cast<ClockMember>(below(processes_.size()));
    if (auto& reports = processes_[y].reports; !reports.empty() && chance(50)) {
      control_.report(y, reports.front());
      reports.erase(reports.begin());
    }
  }

  void decide() {
    auto decision = control_.decide(TimeControl::RealTime{1h});
    if (!decision.advance)
      return;
    RC_ASSERT(messages_.empty());
    for (auto& x : processes_)
      RC_ASSERT(!x.active);
    ++advances_;
    budget_ += static_cast<int>(below(6));
    // The process that decides knows at once.
    advance(0, decision.advance->round);
    for (auto x : decision.receivers)
      orders_.emplace_back(x, decision.advance->round);
  }

  std::mt19937_64 random_;
  std::vector<Process> processes_;
  std::vector<Message> messages_;
  std::vector<std::pair<ClockMember, std::uint64_t>> orders_;
  TimeControl control_{TimeControl::RealTime{1h}};
  int budget_;
  int advances_ = 0;
};

RC_GTEST_PROP(TimeControl, GoesOnOnlyWhenNobodyIsActiveAndNoMessageIsUnderWay, ()) {
  RC_ASSERT(Model{*rc::gen::arbitrary<std::uint64_t>()}.run() > 0);
}

} // namespace

} // namespace castor
