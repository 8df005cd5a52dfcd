#include "castor/binding/binder.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/binding/components/binding_component.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::components {

namespace {

using namespace std::chrono_literals;

/// Puts every proxy into the best of its unions, and takes those out that are to be deleted.
class Binder final : public BindingComponent {
  void start() override {
    BindingComponent::start();
    on_change(changed<BestUnionsForProxy>(),
              [this](const ChangeEvent& event) { judged_.insert(event.address.id); });
    on_change(added<BindingProxyDeletionTask>(), [this](const ChangeEvent&) { tasks_ = true; });
    for (auto& x : read_all<BestUnionsForProxy>())
      judged_.insert(x.address.id);
    // Its predecessor may have been in the middle of something.
    try {
      auto phase = lock(here(binder_status), LockLevel::od);
      put(binder_status, told_);
    } catch (const DoesNotExistOnWM&) {
      add(here(binder_status), told_);
    }
  }

  void work(const Changes&) override {
    for (auto& id : std::exchange(judged_, {}))
      try {
        auto x = read<BestUnionsForProxy>(here(id));
        best_[x->proxy] = x->unions.empty() ? std::string{} : x->unions.front();
      } catch (const DoesNotExistOnWM&) {
        best_.erase(id.substr(best_prefix.size()));
      }
    try {
      bind();
    } catch (const ConsistencyException& e) {
      // Somebody was faster; what has changed is looked at again.
      debug("{}", e.what());
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  void bind() {
    auto tasks = tasks_ ? read_all<BindingProxyDeletionTask>()
                        : std::vector<EntryOf<BindingProxyDeletionTask>>{};
    std::set<std::string> leaving;
    for (auto& x : tasks)
      leaving.insert(x->proxy);
    auto plan = plan_binding(view(), best_, leaving);
    auto idle = plan.empty() && tasks.empty();
    if (idle && status(true) == told_)
      return;
    auto phase = lock(here(binder_status), LockLevel::od);
    if (!idle) {
      tell(status(false));
      carry_out(plan, tasks, leaving);
      tasks_ = false;
    }
    // Whoever writes next makes that known by an event of its own.
    tell(status(idle || plan_binding(view(), best_).empty()));
  }

  void carry_out(const BindingPlan& plan,
                 const std::vector<EntryOf<BindingProxyDeletionTask>>& tasks,
                 const std::set<std::string>& leaving) {
    WriteBatch batch;
    for (auto& [id, x] : plan.unions)
      if (view().unions().contains(id))
        batch.overwrite(here(id), x);
      else
        batch.add(here(id), x);
    for (auto& id : plan.deleted_unions)
      batch.delete_entry(here(id));
    for (auto& [id, x] : plan.proxies)
      batch.overwrite(here(id), x);
    for (auto& id : leaving)
      if (auto* proxy = view().proxy(id)) {
        batch.add(here(new_id()), DeletedBindingProxy{id, proxy->source, proxy->union_id},
                  {.time_to_live = tombstones_.get()});
        batch.delete_entry(here(id));
      }
    for (auto& x : tasks)
      batch.delete_entry(x.address);
    write(batch);
    for (auto& [id, x] : plan.unions)
      view().set(id, std::make_shared<const BindingUnion>(x));
    for (auto& id : plan.deleted_unions)
      view().remove_union(id);
    for (auto& [id, x] : plan.proxies)
      view().set(id, std::make_shared<const BindingProxy>(x));
    for (auto& id : leaving)
      view().remove_proxy(id);
  }

  BinderStatus status(bool nothing_to_do) const {
    BinderStatus result;
    result.stable = nothing_to_do && std::ranges::all_of(view().proxies(), [this](auto& x) {
                      return best_.contains(x.first);
                    });
    result.proxies = view().proxies().size();
    result.unions = view().unions().size();
    return result;
  }

  /// \pre under a lease of the status.
  void tell(const BinderStatus& x) {
    if (x != told_)
      put(binder_status, x);
    told_ = x;
  }

  Option<std::chrono::milliseconds> tombstones_{this, "tombstones", 60s,
                                                "how long tombstones of deleted proxies are kept"};

  /// The first of the best unions of each proxy; empty for one of its own.
  std::map<std::string, std::string> best_;
  /// Entries with new judgements.
  std::set<std::string> judged_;
  bool tasks_ = true;
  BinderStatus told_;
};

CASTOR_COMPONENT(Binder, "binds proxies that are about the same thing into unions")

} // namespace

} // namespace castor::binding::components
