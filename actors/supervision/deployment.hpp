#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/node/processes.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/message.hpp>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Sends plans to the agents of all processes, one plan after the other, and introduces the actors
/// that they make to each other.
///
/// A process that is out of reach is not waited for, unless `wait_for_all` is set: it gets the plan
/// when it is back.
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

  /// To be called when a process has gone out of reach, or is back. True if one is back that has
  /// missed a plan, and needs one.
  bool update_reachability();

  /// All actors that were made, by name.
  const std::map<std::string, caf::strong_actor_ptr>& actors() const { return actors_; }
  void set_actor(const std::string& name, const caf::strong_actor_ptr& x) { actors_[name] = x; }

private:
  /// Sends a question to the processes that the plan went to, unless they are lost; calls `then`
  /// once all have answered that are waited for.
  template <class Answer>
  void ask(const caf::message& question,
           std::function<void(ProcessNumber, const Answer&)> take_answer,
           std::function<void()> then);
  void begin();
  /// Whether the order under way has to wait for an answer of that process.
  bool is_waited_for(ProcessNumber x) const;
  /// Whether a process of `planned_` was lost, so that others would wait for it in vain.
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
  /// Processes that the plan under way was sent to; later ones do not have it.
  std::set<ProcessNumber> asked_;
  /// Processes of `asked_` that have not answered the last question.
  std::set<ProcessNumber> missing_;
  /// Processes that the plan under way waits for; all others were out of reach when it began.
  std::set<ProcessNumber> planned_;
  /// Processes that were not waited for, and need a plan when they are back.
  std::set<ProcessNumber> behind_;
  std::function<void()> then_;
  /// Number of questions so far, to recognise late answers.
  std::size_t question_ = 0;
  std::map<std::string, caf::strong_actor_ptr> actors_;
};

} // namespace castor
