#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/planning/motivation/failure_words.hpp"
#include "castor/planning/motivation/motive_schedule.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

/// Decides which motives are pursued, has their goals reached, and says why.
class MotiveManager final : public ManagedComponent {
  void configure() override { schedule_ = MotiveSchedule(static_cast<std::size_t>(keep_.get())); }

  void start() override {
    on_change(added<Motive>(), [this](const ChangeEvent& event) { look(event.address); });
    on_change(deleted<Motive>(), [this](const ChangeEvent& event) {
      schedule_.withdraw(event.address.id, "nobody wants it any more", now());
    });
    // The end of an action is an occasion to look.
    on_change(overwritten<Action>().where(field(&Action::requester) == component_name() &&
                                          field(&Action::status) == ActionStatus::over),
              [](const ChangeEvent&) {});
    on_call<MotiveQuestion>([this](const MotiveQuestion& question) {
      return MotiveAnswer{schedule_.answer(question, waiting())};
    });
    // What a predecessor has not brought to an end; the oldest first.
    auto known = read_all<Motive>();
    for (auto x = known.rbegin(); x != known.rend(); ++x)
      look(x->address);
  }

  void run() override {
    while (is_running()) {
      schedule_.drop_old(now());
      end_actions();
      follow_orders();
      tell_changes();
      forget_old();
      wait_for_changes(look_every);
    }
  }

  void look(const Address& address) {
    try {
      const auto x = read<Motive>(address);
      if (x->status == MotiveStatus::completed || x->status == MotiveStatus::rejected ||
          x->status == MotiveStatus::dropped)
        schedule_.recall(address.id, *x);
      else
        schedule_.propose(address.id, *x, now());
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// Why there will be further motives.
  std::vector<std::string> waiting() {
    const auto told = read_all<RequestsWaiting>(1);
    return told.empty() ? std::vector<std::string>{} : told.front()->because;
  }

  void end_actions() {
    for (auto i = actions_.begin(); i != actions_.end();) {
      if (!i->second.is_over()) {
        ++i;
        continue;
      }
      const auto id = i->first;
      const auto end = i->second.state();
      i = actions_.erase(i);
      if (end.executor_ended)
        schedule_.interrupted(id, end.reason, now());
      else
        schedule_.ended(id, end.outcome, end.reason, now());
    }
  }

  void follow_orders() {
    for (const auto& order : schedule_.take_orders()) {
      if (order.kind == MotiveOrder::Kind::begin) {
        const AnyEntryPointer cause(here(order.motive), type_name<Motive>());
        actions_[order.motive] =
          perform(planner_, schedule_.motive(order.motive).goal, {.cause = cause});
      } else if (const auto found = actions_.find(order.motive); found != actions_.end()) {
        found->second.cancel();
      }
    }
  }

  void tell_changes() {
    for (const auto& id : schedule_.take_changed()) {
      const auto& motive = schedule_.motive(id);
      try {
        if (read<Motive>(here(id))->history != motive.history)
          overwrite(here(id), motive);
      } catch (const DoesNotExistOnWM& e) {
        debug("{}", e.what());
      }
      acknowledge(id, motive);
    }
  }

  void forget_old() {
    for (const auto& id : schedule_.take_forgotten())
      if (exists(here(id)))
        delete_entry(here(id));
  }

  /// Each reply once, to those who asked for it.
  void acknowledge(const std::string& id, const Motive& motive) {
    if (motive.asker.empty())
      return;
    switch (motive.status) {
      case MotiveStatus::queued:
      case MotiveStatus::active:
        return reply(id, motive, MotiveReply::accepted, "I will " + motive.words + ".");
      case MotiveStatus::completed:
        if (motive.history.back().why.empty())
          return reply(id, motive, MotiveReply::done, "It is done: " + motive.words + ".");
        return reply(id, motive, MotiveReply::already_so, "It is so already.");
      case MotiveStatus::rejected:
      case MotiveStatus::dropped:
        return reply(id, motive, MotiveReply::impossible,
                     "I cannot " + motive.words + ", because " +
                       failure_in_words(motive.history.back().why) + ".");
      case MotiveStatus::proposed:
      case MotiveStatus::preempted:
        return;
    }
  }

  void reply(const std::string& id, const Motive& motive, MotiveReply kind, std::string words) {
    const auto address = here("reply " + std::to_string(static_cast<int>(kind)) + " to " + id);
    try {
      add(address,
          MotiveAcknowledgement{{here(id)}, motive.asker, motive.cause, kind, std::move(words)},
          {.time_to_live = 10min});
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was told before", address.id);
    }
  }

  /// For motives that have waited too long.
  static constexpr auto look_every = 500ms;

  Option<std::int64_t> keep_{this, "keep", 100, "motives that are over whose entries it keeps"};
  Option<SubarchitectureName> planner_{this, "planner", "planning",
                                       "the subarchitecture that reaches goals"};

  MotiveSchedule schedule_;
  std::map<std::string, ActionHandle> actions_;
};

CASTOR_COMPONENT(MotiveManager, "decides which motives are pursued, and says why")

} // namespace

} // namespace castor::planning
