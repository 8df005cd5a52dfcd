#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Result of a transition.
struct TransitionResult {
  /// Wrong configurations of children that were started for the first time. Then none of them was
  /// started.
  std::vector<Diagnostic> problems;
  /// In the order of their end.
  std::vector<std::string> stopped;
  /// Those that did not return from their own code.
  std::vector<std::string> stuck;
};

/// Children to stop and to start.
struct TransitionRequest {
  /// Both in the order of their start.
  std::vector<std::string> stop = {};
  std::vector<std::string> start = {};
  /// Whether the children to start are made anew, and why.
  bool remakes = false;
  std::string reason = {};
  /// Time between the last stop and the making.
  Timestamp delay{0};
  /// Called once, when the transition has ended, or another one replaces it.
  std::function<void(const TransitionResult&)> done = {};
};

/// The stopping and starting of some children, one step after the other. In most steps the children
/// have their turn one after the other.
class Transition {
public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Names = std::vector<std::string>;

  enum class Step : std::uint8_t { stop, wait, make, configure, start };

  Transition(std::uint64_t id, TransitionRequest request, TimePoint now);

  std::uint64_t id() const { return id_; }
  /// In the order in which they are stopped: the last one started is the first.
  const Names& stop() const { return request_.stop; }
  /// In the order in which they are started.
  const Names& start() const { return request_.start; }
  bool remakes() const { return request_.remakes; }
  const std::string& reason() const { return request_.reason; }
  Timestamp delay() const { return request_.delay; }

  bool involves(const std::string& name) const;
  /// Whether both involve some child.
  bool overlaps(const Transition& other) const;
  /// Whether it involves all that the other one does.
  bool includes(const Transition& other) const;

  // -- steps and turns

  Step step() const { return step_; }
  bool leads_through_phases() const { return step_ == Step::configure || step_ == Step::start; }
  /// Child whose turn it is, or null after the last one.
  const std::string* current() const;
  /// Number of the present turn, which no other turn has.
  std::uint64_t turn() const { return turn_; }
  /// When the present turn began, or was prolonged.
  TimePoint since() const { return since_; }
  /// Whether the current child was sent the command of the present phase.
  bool is_commanded() const { return commanded_; }

  void enter(Step step, TimePoint now);
  /// Configures those that `is_last` says after the others.
  void enter_configure(TimePoint now, const std::function<bool(const std::string&)>& is_last);
  void next(TimePoint now);
  /// Restarts the time of the present turn.
  void restart_turn(TimePoint now) { since_ = now; }
  void set_commanded() { commanded_ = true; }

  /// Excludes these from being started, in any step. Those that are being made are still made.
  void withdraw(const Names& names);

  // -- what happens meanwhile

  void add_stopped(const std::string& name) { result_.stopped.push_back(name); }
  void add_stuck(const std::string& name) { result_.stuck.push_back(name); }
  void do_not_start(const std::string& name);
  void add_problem(Diagnostic x) { result_.problems.push_back(std::move(x)); }
  bool has_problems() const { return !result_.problems.empty(); }
  /// A child failed; the failure is handled when the transition has ended.
  void add_failure(ComponentEnded x) { failures_.push_back(std::move(x)); }
  const std::vector<ComponentEnded>& failures() const { return failures_; }
  bool has_failed(const std::string& name, std::uint64_t incarnation) const;
  /// The process of a child is lost.
  void add_lost(const std::string& name) { lost_.insert(name); }
  bool is_lost(const std::string& name) const { return lost_.count(name) > 0; }

  void report_done() const;

private:
  /// Those whose turns make up the present step.
  const Names& order() const;

  std::uint64_t id_;
  TransitionRequest request_;
  /// What is started, in the order in which it is configured.
  Names configure_;
  Step step_ = Step::stop;
  std::uint64_t turn_ = 0;
  /// Index of the current child.
  std::size_t at_ = 0;
  bool commanded_ = false;
  TimePoint since_;
  TransitionResult result_;
  std::vector<ComponentEnded> failures_;
  std::set<std::string> lost_;
  /// Those not to be configured once they are made.
  std::set<std::string> withdrawn_;
};

} // namespace castor
