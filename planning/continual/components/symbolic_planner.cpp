#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/file_access.hpp"
#include "castor/planning/continual/plan_continuation.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/symbolic/syntax_tree.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

/// One search on a thread of its own. It can be left alone once it is cancelled: freeing the memory
/// of a huge task takes longer than anybody wants to wait.
class PlanningThread {
public:
  /// @param on_end called by the thread when the search is over
  PlanningThread(DomainText domain, FindPlan request, PlanningOptions options, TimeHold hold,
                 std::function<void()> on_end)
    : domain_(std::move(domain)), request_(std::move(request)), options_(std::move(options)) {
    options_.limits.is_cancelled = &is_cancelled_;
    options_.on_progress = [this](const PlanningProgress& x) {
      const std::lock_guard lock(mutex_);
      progress_ = x;
    };
    thread_ = std::jthread([this, time = std::move(hold), on_end = std::move(on_end)] {
      result_ = continue_plan(domain_, request_, options_);
      is_over_ = true;
      on_end();
    });
  }
  PlanningThread(const PlanningThread&) = delete;
  PlanningThread& operator=(const PlanningThread&) = delete;
  ~PlanningThread() { cancel(); }

  void cancel() { is_cancelled_ = true; }
  bool is_over() const { return is_over_; }
  PlanningProgress progress() {
    const std::lock_guard lock(mutex_);
    return progress_;
  }
  /// Once it is over.
  const FoundPlan& result() const { return result_; }

private:
  DomainText domain_;
  FindPlan request_;
  PlanningOptions options_;
  std::atomic<bool> is_cancelled_ = false;
  std::atomic<bool> is_over_ = false;
  std::mutex mutex_;
  PlanningProgress progress_;
  FoundPlan result_;
  /// Joined before the rest is destroyed.
  std::jthread thread_;
};

/// Finds plans, one after the other, for whoever asks for the action FindPlan.
class SymbolicPlanner final : public ManagedComponent {
  void configure() override {
    auto content = read_file(domain_.get(), most_pddl_bytes);
    if (!content.text)
      throw std::runtime_error("the domain " + domain_.get() + " cannot be read: " + content.error +
                               "; give a file of PDDL with --domain");
    text_ = {domain_.get(), std::move(*content.text)};
  }

  void start() override {
    put(here("progress of " + component_name()), PlannerProgress{});
    on_action<FindPlan>(
      [this](ActionInProgress& action, const FindPlan& request) { return plan(action, request); });
  }

  ActionResult plan(ActionInProgress& action, const FindPlan& request) {
    const auto is_over = [this] { return !thread_ || thread_->is_over(); };
    // The one before may still be freeing its memory.
    while (!is_over())
      if (!action.wait_until(is_over))
        return ActionResult::cancelled("the planner has not begun");
    PlanningOptions options;
    options.limits.time = time_.get();
    options.limits.memory_bytes = static_cast<std::size_t>(memory_.get()) << 20;
    thread_ =
      std::make_unique<PlanningThread>(text_, request, std::move(options), hold_time(), waker());
    while (!is_over()) {
      if (!action.wait_until(is_over, tell_every)) {
        thread_->cancel();
        tell(false);
        return ActionResult::cancelled("the planner has ended its search");
      }
      if (!is_over())
        tell(true);
    }
    tell(false);
    add(here(action.address().id + " plan"), thread_->result(), {.time_to_live = 1min});
    thread_.reset();
    return ActionResult::succeeded();
  }

  void tell(bool is_planning) {
    const auto x = thread_->progress();
    put(here("progress of " + component_name()),
        PlannerProgress{is_planning, x.expanded, x.seconds, x.best_cost});
  }

  static constexpr auto tell_every = 200ms;

  Option<std::string> domain_{this, "domain", "", "file of the domain, in PDDL or MAPL"};
  Option<std::chrono::milliseconds> time_{this, "time", 10s, "how long it looks for a plan"};
  Option<std::int64_t> memory_{this, "memory", 1000, "MiB that it may use"};

  DomainText text_;
  std::unique_ptr<PlanningThread> thread_;
};

CASTOR_COMPONENT(SymbolicPlanner, "finds plans for goals in PDDL or MAPL")

} // namespace

} // namespace castor::planning
