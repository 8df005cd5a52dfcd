#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/node/processes.hpp"

#include <caf/event_based_actor.hpp>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Brings plans to the agents of all processes, one after the other, and introduces what they have
/// made to each other.
///
/// A process that is out of reach at the moment holds nothing up unless it was said to: it gets the
/// plan when it is back.
class Deployments : public std::enable_shared_from_this<Deployments> {
public:
  using Problems = std::vector<Diagnostic>;

  Deployments(caf::event_based_actor* self, const Processes& processes,
              std::chrono::milliseconds patience)
    : self_(self), processes_(processes), patience_(patience) {}

  struct Order {
    /// Called when it is this order's turn.
    std::function<PartPlan()> plan;
    /// Wait also for processes that are out of reach.
    bool wait_for_all = false;
    std::function<void(const Problems&)> done;
  };
  void add(Order x);

  /// A process has gone out of reach, or is back. True if one is back that has missed something: it
  /// needs a plan.
  bool look_again();

  /// All that was made, by name.
  const std::map<std::string, caf::strong_actor_ptr>& actors() const { return actors_; }
  void set_actor(const std::string& name, const caf::strong_actor_ptr& x) { actors_[name] = x; }

private:
  /// Asks those again that were asked first, unless they are lost, and goes on once those have
  /// answered that count.
  template <class Answer, class Question>
  void ask(const Question& question, std::function<void(ProcessNumber, const Answer&)> take,
           std::function<void()> then);
  void begin();
  /// Whether the order under way has to wait for what that process says.
  bool is_waited_for(ProcessNumber x) const;
  /// Whether a process was lost on which the plan under way counts, so that others wait for it.
  bool is_out_of_date() const;
  void take(const PartPlan& plan, ProcessNumber from, const PartMade& made);
  void introduce();
  void finish();
  void no_answer(ProcessNumber from, const caf::error& error);
  void go_on_if_answered();

  caf::event_based_actor* self_;
  const Processes& processes_;
  const std::chrono::milliseconds patience_;
  /// The first is under way.
  std::deque<Order> orders_;
  Problems problems_;
  /// Those that the plan under way went to: one that has come since knows nothing of it.
  std::set<ProcessNumber> asked_;
  /// Those of them that have not answered the last question.
  std::set<ProcessNumber> missing_;
  /// Those that the plan under way counts on: out of reach when it began were all others.
  std::set<ProcessNumber> planned_;
  /// Those that were not waited for.
  std::set<ProcessNumber> behind_;
  std::function<void()> then_;
  /// Counts questions, so that late answers are known as such.
  std::size_t question_ = 0;
  std::map<std::string, caf::strong_actor_ptr> actors_;
};

} // namespace castor
