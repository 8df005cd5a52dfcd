#include "castor/tests/actors/node/support.hpp"
#include "castor/tests/actors/supervision/simulated_children.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Names = std::vector<std::string>;

const std::string two_subarchitectures =
  subarchitecture("a", "localhost") + "CPP MG a1 M\nCPP UM a2 U\n" +
  subarchitecture("b", "localhost") + "CPP MG b1 M\nCPP UM b2 U\nCOMPONENT CPP camera C\n";

/// Requests, failures, losses and answers in an order that numbers say.
class RandomRun {
public:
  explicit RandomRun(std::vector<unsigned> numbers) : numbers_(std::move(numbers)) {
    for_each_component(children_.model.architecture(), [&](auto& x) { names_.push_back(x.name); });
    names_ = children_.model.in_order(names_);
    children_.failure_handler = [this](const ComponentEnded& x) { handle_failure(x); };
    begin({.start = names_});
  }

  /// Calls `check` after every step.
  void run(const std::function<void(const SimulatedChildren&)>& check) {
    while (next_ < numbers_.size()) {
      step();
      check(children_);
    }
    // Nothing fails any more, and all that waits for something gets it.
    for (int i = 0; i < 1000 && !is_over(); ++i) {
      children_.work();
      come_back();
      children_.let_time_pass(1s);
      check(children_);
    }
  }

  bool is_over() const {
    return children_.scheduler.running().empty() && children_.scheduler.waiting().empty() &&
           lost_.empty() && children_.stops.empty() && children_.makings.empty() &&
           children_.phases.empty();
  }

  SimulatedChildren& children() { return children_; }
  const Names& names() const { return names_; }
  /// How often each request was reported as done.
  const std::vector<int>& done() const { return done_; }

private:
  unsigned number(std::size_t below) {
    return next_ < numbers_.size() ? numbers_[next_++] % static_cast<unsigned>(below) : 0;
  }

  Names some() {
    Names result;
    auto from = number(names_.size());
    auto count = 1 + number(3);
    for (auto i = from; i < std::min<std::size_t>(from + count, names_.size()); ++i)
      result.push_back(names_[i]);
    return result;
  }

  void begin(TransitionRequest x) {
    count(x);
    children_.scheduler.begin(std::move(x));
  }

  void count(TransitionRequest& x) {
    x.done = [this, i = done_.size()](const TransitionResult&) { ++done_[i]; };
    done_.push_back(0);
  }

  void restart(const Names& names, Timestamp delay) {
    TransitionRequest x;
    for (auto& name : names)
      if (!children_.model.child(name).given_up && !children_.failover.is_awaited(name))
        x.start.push_back(name);
    x.stop = x.start;
    x.remakes = true;
    x.delay = delay;
    begin(std::move(x));
  }

  /// As a supervisor does.
  void handle_failure(const ComponentEnded& x) {
    auto& child = children_.model.child(x.name);
    if (!child.given_up && !child.alive && child.incarnation == x.incarnation &&
        !children_.scheduler.is_scheduled(x.name))
      restart({x.name}, 100ms);
  }

  void fail(const std::string& name) {
    auto incarnation = children_.model.child(name).incarnation;
    bool was_alive = children_.model.child(name).alive;
    if (!children_.end(name) && was_alive)
      handle_failure({name, incarnation, ComponentEnded::How::failed, {}});
  }

  void lose_process(ProcessNumber process) {
    Names affected;
    for (auto& name : names_)
      if (!children_.model.child(name).given_up && children_.failover.process_of(name) == process) {
        children_.model.set_alive(name, false);
        children_.unreachable.insert(name);
        affected.push_back(name);
      }
    auto loss = children_.failover.lose(process, affected, children_.model.architecture(),
                                        [](ProcessNumber) { return false; });
    auto successor = ++last_process_;
    children_.failover.set_successor(process, successor, {loss.left, {}});
    lost_.push_back(successor);
    children_.scheduler.lose(affected);
  }

  /// Successors of lost processes are there.
  void come_back() {
    for (auto process : std::exchange(lost_, {}))
      if (auto awaited = children_.failover.take_awaited(process)) {
        for (auto& name : awaited->names)
          children_.unreachable.erase(name);
        children_.failover.begin_move(awaited->names);
        restart(awaited->names, {});
      }
  }

  template <class T>
  std::optional<T> take_one(std::vector<T>& from) {
    if (from.empty())
      return std::nullopt;
    auto i = from.begin() + number(from.size());
    auto result = std::move(*i);
    from.erase(i);
    return result;
  }

  void step() {
    switch (number(12)) {
      case 0:
        return restart(some(), number(2) * 1s);
      case 1: {
        TransitionRequest x;
        x.stop = some();
        // Most of the time a system is to be kept running.
        if (number(3) != 0)
          return;
        count(x);
        return children_.scheduler.stop(std::move(x));
      }
      case 2:
        return fail(names_[number(names_.size())]);
      case 3:
        if (number(4) == 0)
          lose_process(children_.failover.process_of(names_[number(names_.size())]));
        return;
      case 4:
        return come_back();
      case 5:
        return children_.let_time_pass(number(4000) * 1ms);
      case 6:
      case 7:
        if (auto x = take_one(children_.stops); x && children_.lives(x->first, x->second))
          children_.end(x->first, ComponentEnded::How::stopped);
        return;
      case 8:
        if (auto x = take_one(children_.makings)) {
          std::set<std::string> failed;
          if (number(4) == 0)
            failed.insert(x->children.front());
          x->done(failed);
        }
        return;
      default:
        if (auto x = take_one(children_.phases);
            x && x->phase != Phase::run && children_.lives(x->child, x->incarnation)) {
          bool fails = number(8) == 0;
          children_.phase_done(x->child, x->phase, fails ? "it failed" : "");
          if (fails)
            fail(x->child);
        }
    }
  }

  std::vector<unsigned> numbers_;
  std::size_t next_ = 0;
  SimulatedChildren children_{architecture(two_subarchitectures)};
  Names names_;
  std::vector<int> done_;
  std::vector<ProcessNumber> lost_;
  ProcessNumber last_process_ = 0;
};

std::vector<unsigned> numbers() {
  return *rc::gen::container<std::vector<unsigned>>(*rc::gen::inRange<std::size_t>(10, 300),
                                                    rc::gen::inRange(0u, 100'000u));
}

RC_GTEST_PROP(TransitionSchedulerProperties, RunningTransitionsShareNoChild, ()) {
  RandomRun run{numbers()};
  run.run([](const SimulatedChildren& x) {
    auto& running = x.scheduler.running();
    for (auto i = running.begin(); i != running.end(); ++i)
      for (auto j = std::next(i); j != running.end(); ++j)
        RC_ASSERT(!i->overlaps(*j));
    RC_ASSERT(!running.empty() || x.scheduler.waiting().empty());
  });
}

RC_GTEST_PROP(TransitionSchedulerProperties, EveryTransitionEndsOnce, ()) {
  RandomRun run{numbers()};
  run.run([](auto&) {});
  RC_ASSERT(run.is_over());
  for (auto x : run.done())
    RC_ASSERT(x == 1);
}

RC_GTEST_PROP(TransitionSchedulerProperties, WhatIsNotGivenUpRunsInTheEnd, ()) {
  RandomRun run{numbers()};
  run.run([](auto&) {});
  RC_ASSERT(run.is_over());
  std::map<std::string, std::string> last;
  for (auto& line : run.children().log)
    for (auto* word : {"stop ", "make ", "plan ", "configure ", "start ", "run "})
      if (line.starts_with(word))
        last[line.substr(std::string_view{word}.size())] = word;
  for (auto& name : run.names()) {
    auto& child = run.children().model.child(name);
    if (child.given_up)
      continue;
    RC_ASSERT(child.alive);
    if (child.kind != ComponentKind::working_memory)
      RC_ASSERT(last[name] == "run ");
  }
}

RC_GTEST_PROP(TransitionSchedulerProperties, TheSameEventsGiveTheSameCommands, ()) {
  auto events = numbers();
  RandomRun first{events};
  RandomRun second{events};
  first.run([](auto&) {});
  second.run([](auto&) {});
  RC_ASSERT(first.children().log == second.children().log);
}

} // namespace

} // namespace castor::test
