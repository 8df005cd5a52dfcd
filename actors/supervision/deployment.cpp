#include "castor/actors/supervision/deployment.hpp"

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/base/plain_words.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

void Deployments::add(Order x) {
  orders_.push_back(std::move(x));
  if (orders_.size() == 1)
    begin();
}

template <class Answer>
void Deployments::ask(const caf::message& question,
                      std::function<void(ProcessNumber, const Answer&)> take_answer,
                      std::function<void()> then) {
  // One for all processes: it may be large.
  auto take = std::make_shared<decltype(take_answer)>(std::move(take_answer));
  then_ = std::move(then);
  auto number = ++question_;
  std::erase_if(asked_, [this](auto x) { return processes_.state(x).link == LinkState::lost; });
  missing_ = asked_;
  for (auto process : asked_) {
    auto answered = [self = shared_from_this(), process, number] {
      if (number == self->question_ && self->missing_.erase(process) > 0)
        self->go_on_if_answered();
    };
    self_->request(processes_.agent(process), patience_, question)
      .then(
        [self = shared_from_this(), take, process, number, answered](const Answer& x) {
          if (number == self->question_)
            (*take)(process, x);
          answered();
        },
        [self = shared_from_this(), process, number, answered](const caf::error& error) {
          // Of a process that is lost, nothing is expected any more.
          if (number == self->question_ && self->missing_.count(process) > 0)
            self->no_answer(process, error);
          answered();
        });
  }
  go_on_if_answered();
}

void Deployments::begin() {
  problems_.clear();
  auto plan = std::make_shared<const PartPlan>(orders_.front().plan());
  asked_.clear();
  planned_.clear();
  for (std::size_t i = 0; i < processes_.size(); ++i) {
    auto process = static_cast<ProcessNumber>(i);
    asked_.insert(process);
    if (is_waited_for(process))
      planned_.insert(process);
  }
  ask<PartMade>(
    caf::make_message(*plan),
    [this, plan](ProcessNumber from, const PartMade& x) { take(*plan, from, x); },
    [this, plan] {
      if (!problems_.empty())
        return finish();
      std::set<std::string> names{working_memory_of(health_subarchitecture)};
      for_each_component(plan->architecture, [&](auto& x) { names.insert(x.name); });
      std::erase_if(actors_, [&](auto& x) { return names.count(x.first) == 0; });
      introduce();
    });
}

void Deployments::take(const PartPlan& plan, ProcessNumber from, const PartMade& made) {
  for (auto& [name, actor] : made.actors)
    if (process_of(plan.placement, name) == from)
      actors_[name] = actor;
  for (auto problem : made.problems) {
    if (from != 0)
      problem.message =
        "on the node " + processes_.state(from).description.name + ": " + problem.message;
    problems_.push_back(std::move(problem));
  }
}

void Deployments::introduce() {
  JoinParts all{actors_, {}};
  std::copy_if(planned_.begin(), planned_.end(), std::inserter(all.processes, all.processes.end()),
               [this](auto x) { return behind_.count(x) == 0; });
  ask<Acknowledged>(
    caf::make_message(std::move(all)), [](ProcessNumber, const Acknowledged&) {},
    [this] { finish(); });
}

void Deployments::finish() {
  auto order = std::move(orders_.front());
  orders_.pop_front();
  auto self = shared_from_this();
  order.done(problems_);
  if (!orders_.empty())
    begin();
}

void Deployments::no_answer(ProcessNumber from, const caf::error& error) {
  auto x = processes_.state(from);
  Diagnostic problem;
  problem.message = (from == 0 ? "this process" : "the node " + x.description.name) +
                    " did not make its part of the system";
  problem.message += error == caf::sec::request_timeout
                       ? " in " + std::to_string(patience_.count() / 1000) + " s"
                       : ": " + plain_words(error, self_->system());
  if (x.link != LinkState::up)
    problem.message += ": " + x.reason;
  problem.remedy = "check that the nodes can reach each other at the addresses in the file";
  problems_.push_back(std::move(problem));
}

bool Deployments::is_waited_for(ProcessNumber x) const {
  auto link = processes_.state(x).link;
  return link == LinkState::up || (link == LinkState::down && orders_.front().wait_for_all);
}

bool Deployments::is_out_of_date() const {
  return std::any_of(planned_.begin(), planned_.end(),
                     [&](auto x) { return processes_.state(x).link == LinkState::lost; });
}

bool Deployments::update_reachability() {
  if (!orders_.empty() && is_out_of_date())
    begin();
  else if (!orders_.empty())
    go_on_if_answered();
  return std::erase_if(behind_, [&](auto x) { return processes_.is_up(x); }) > 0;
}

void Deployments::go_on_if_answered() {
  if (!then_)
    return;
  std::erase_if(missing_, [&](ProcessNumber x) {
    if (is_waited_for(x))
      return false;
    behind_.insert(x);
    return true;
  });
  if (missing_.empty())
    std::exchange(then_, nullptr)();
}

} // namespace castor
