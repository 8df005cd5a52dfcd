#include "castor/actors/runtime/keeper.hpp"

#include "castor/base/log.hpp"
#include "castor/wm/store/entry_table.hpp"

#include <caf/atom.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace castor {

namespace {

using TickAtom = caf::atom_constant<caf::atom("tick")>;

using LeaseAtom = caf::atom_constant<caf::atom("lease")>;

constexpr std::chrono::milliseconds period{250};
constexpr std::chrono::milliseconds resting_period{2000};
constexpr std::chrono::seconds patience{5};

/// Renews what one component holds, and tells it what it has lost.
void renew_leases(caf::event_based_actor* self, const KeeperParts& parts,
                  const std::shared_ptr<ComponentRecord>& component) {
  for (auto& [subarchitecture, leases] : component->leases.to_renew()) {
    auto wm = parts.working_memories.find(subarchitecture);
    if (wm == parts.working_memories.end())
      continue;
    RenewRequest request{component->client(), {}};
    for (auto& [id, token] : leases)
      request.leases.push_back({id, token});
    self->request(wm->second, patience, std::move(request))
      .then(
        [component, name = subarchitecture](const RenewReply& x) {
          for (auto& [id, token] : x.lost)
            component->leases.mark_lost({name, id}, token);
        },
        [](const caf::error&) {
          // The leases run out, and the component will hear of that from whoever holds them next.
        });
  }
}

void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

} // namespace

BudgetWatch::BudgetWatch(std::vector<std::shared_ptr<const ComponentRecord>> components) {
  for (auto& x : components)
    watched_.push_back({std::move(x), false});
}

std::vector<Overrun> BudgetWatch::check(ComponentRecord::Clock::time_point now) {
  std::vector<Overrun> result;
  for (auto& x : watched_) {
    bool over = !is_responsive(*x.component, now);
    if (over && !x.reported)
      result.push_back(
        {x.component.get(),
         std::chrono::duration_cast<std::chrono::milliseconds>(x.component->in_user_code_for(now)),
         x.component->activity.text()});
    x.reported = over;
  }
  return result;
}

bool DeletionWatch::check(std::uint64_t deletions, Clock::time_point now) {
  if (!given_back_at_) {
    given_back_at_ = second_began_at_ = deletions;
    second_began_ = now;
  }
  if (now - second_began_ < std::chrono::seconds{1})
    return false;
  second_began_ = now;
  const auto in_second = deletions - std::exchange(second_began_at_, deletions);
  if (in_second >= few || deletions - *given_back_at_ < many)
    return false;
  given_back_at_ = deletions;
  return true;
}

namespace {

class Keeper : public std::enable_shared_from_this<Keeper> {
public:
  Keeper(caf::event_based_actor* self, KeeperParts parts)
    : self_(self), parts_(std::move(parts)),
      watch_({parts_.components.begin(), parts_.components.end()}),
      rest_(std::make_shared<Rest>([keeper = caf::actor_cast<caf::actor_addr>(self)] {
        if (auto to = caf::actor_cast<caf::actor>(keeper))
          caf::anon_send(to, LeaseAtom::value);
      })) {}

  caf::behavior begin() {
    for (auto& x : parts_.components)
      x->leases.set_rest(rest_);
    schedule(period);
    auto keeper = shared_from_this();
    return {
      [keeper](TickAtom, std::uint64_t number) {
        if (number == keeper->ticks_)
          keeper->look();
      },
      // It is to be renewed soon.
      [keeper](LeaseAtom) { keeper->schedule(period); },
    };
  }

private:
  /// Replaces the tick that was scheduled before.
  void schedule(ComponentRecord::Clock::duration after) {
    self_->delayed_send(self_, after, TickAtom::value, ++ticks_);
  }

  void look() {
    const auto now = self_->clock().now();
    for (auto& x : watch_.check(now))
      report(x);
    for (auto& x : parts_.components)
      if (BudgetWatch::is_responsive(*x, now))
        renew_leases(self_, parts_, x);
    if (deletions_.check(EntryTable::deletions(), now))
      give_back_memory();
    rest_->begin();
    // A lease that comes from here on ends the rest.
    schedule(is_anything_to_watch(now) ? period : longest_rest());
  }

  void report(const Overrun& x) {
    log_runtime(
      LogLevel::warning, x.component->identity().full_name(),
      fmt::format("has computed for {:.1f} s without a pause in {}, its --budget is {:.1f} s; it "
                  "receives neither events nor a stop request meanwhile, and its leases expire",
                  std::chrono::duration<double>(x.duration).count(), x.activity,
                  std::chrono::duration<double>(x.component->budget()).count()));
    if (parts_.on_overrun)
      parts_.on_overrun(x);
  }

  bool is_anything_to_watch(ComponentRecord::Clock::time_point now) const {
    return std::ranges::any_of(parts_.components, [&](auto& x) {
      return !x->leases.empty() || x->in_user_code_for(now) > std::chrono::nanoseconds{0};
    });
  }

  /// A component that begins to compute meanwhile is looked at before its budget is over.
  std::chrono::milliseconds longest_rest() const {
    auto result = resting_period;
    for (auto& x : parts_.components)
      result = std::min(result, x->budget());
    return std::max(result, period);
  }

  caf::event_based_actor* self_;
  const KeeperParts parts_;
  BudgetWatch watch_;
  DeletionWatch deletions_;
  const std::shared_ptr<Rest> rest_;
  std::uint64_t ticks_ = 0;
};

} // namespace

caf::behavior keeper(caf::event_based_actor* self, KeeperParts parts) {
  return std::make_shared<Keeper>(self, std::move(parts))->begin();
}

} // namespace castor
