#include "castor/actors/runtime/keeper.hpp"

#include "castor/base/log.hpp"
#include "castor/wm/store/entry_table.hpp"

#include <caf/atom.hpp>

#include <fmt/core.h>

#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace castor {

namespace {

using TickAtom = caf::atom_constant<caf::atom("tick")>;

constexpr std::chrono::milliseconds period{1000 / DeletionWatch::checks_per_second};
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
      result.push_back({x.component.get(), std::chrono::duration_cast<std::chrono::milliseconds>(
                                             x.component->in_user_code_for(now))});
    x.reported = over;
  }
  return result;
}

bool DeletionWatch::check(std::uint64_t deletions) {
  if (!given_back_at_)
    given_back_at_ = second_began_at_ = deletions;
  if (++checks_ < checks_per_second)
    return false;
  checks_ = 0;
  const auto in_second = deletions - std::exchange(second_began_at_, deletions);
  if (in_second >= few || deletions - *given_back_at_ < many)
    return false;
  given_back_at_ = deletions;
  return true;
}

caf::behavior keeper(caf::event_based_actor* self, KeeperParts parts) {
  auto watch = std::make_shared<BudgetWatch>(std::vector<std::shared_ptr<const ComponentRecord>>(
    parts.components.begin(), parts.components.end()));
  auto deletions = std::make_shared<DeletionWatch>();
  self->delayed_send(self, period, TickAtom::value);
  return {
    [self, watch, deletions, parts = std::move(parts)](TickAtom) {
      auto now = self->clock().now();
      for (auto& x : watch->check(now)) {
        log_runtime(
          LogLevel::warning, x.component->identity().full_name(),
          fmt::format("has computed for {:.1f} s without a pause, its --budget is {:.1f} s; it "
                      "receives neither events nor a stop request meanwhile, and its leases expire",
                      std::chrono::duration<double>(x.duration).count(),
                      std::chrono::duration<double>(x.component->budget()).count()));
        if (parts.on_overrun)
          parts.on_overrun(x);
      }
      for (auto& x : parts.components)
        if (BudgetWatch::is_responsive(*x, now))
          renew_leases(self, parts, x);
      if (deletions->check(EntryTable::deletions()))
        give_back_memory();
      self->delayed_send(self, period, TickAtom::value);
    },
  };
}

} // namespace castor
