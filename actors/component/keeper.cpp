#include "castor/actors/component/keeper.hpp"

#include "castor/actors/component/log.hpp"

#include <caf/atom.hpp>

#include <fmt/core.h>

#include <utility>

namespace castor {

namespace {

using TickAtom = caf::atom_constant<caf::atom("tick")>;

constexpr std::chrono::milliseconds period{250};

} // namespace

BudgetWatch::BudgetWatch(std::vector<std::shared_ptr<const ComponentRecord>> components) {
  for (auto& x : components)
    watched_.push_back({std::move(x), false});
}

std::vector<Overrun> BudgetWatch::check(ComponentRecord::Clock::time_point now) {
  std::vector<Overrun> result;
  for (auto& x : watched_) {
    auto duration = x.component->in_user_code_for(now);
    bool over = duration > x.component->budget();
    if (over && !x.reported)
      result.push_back(
        {x.component.get(), std::chrono::duration_cast<std::chrono::milliseconds>(duration)});
    x.reported = over;
  }
  return result;
}

caf::behavior keeper(caf::event_based_actor* self,
                     std::vector<std::shared_ptr<const ComponentRecord>> components) {
  auto watch = std::make_shared<BudgetWatch>(std::move(components));
  self->delayed_send(self, period, TickAtom::value);
  return {
    [self, watch](TickAtom) {
      for (auto& x : watch->check(ComponentRecord::Clock::now()))
        log(LogLevel::warning, x.component->identity().full_name(),
            fmt::format("has computed for {:.1f} s without a pause, its --budget is {:.1f} s; it "
                        "hears neither events nor a stop meanwhile",
                        std::chrono::duration<double>(x.duration).count(),
                        std::chrono::duration<double>(x.component->budget()).count()));
      self->delayed_send(self, period, TickAtom::value);
    },
  };
}

} // namespace castor
