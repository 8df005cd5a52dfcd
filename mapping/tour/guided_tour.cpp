#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/tour/tour_request.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

/// Lets the robot be shown around: it follows who says so, and goes to where it is sent by name. In
/// the subarchitecture of the navigation graph, whose areas an AreaMonitor names.
class GuidedTour final : public UnmanagedComponent {
  void start() override {
    on_change(added<communication::DialogueMove>().in(communication_),
              [this](const ChangeEvent& event) {
                try {
                  hear(event.address);
                } catch (const DoesNotExistOnWM&) {
                  debug("{} was deleted before it was read", event.address.id);
                }
              });
  }

  void hear(const Address& address) {
    const auto move = read<communication::DialogueMove>(address);
    const auto request = tour_request(*move);
    // The dialogue says itself what it has not understood.
    if (move->type == communication::DialogueMoveType::action_directive && move->problem.empty())
      acknowledge(address, request);
    if (!request)
      return;
    switch (request->wish) {
      case TourWish::go: {
        GoToArea what;
        what.label = request->place;
        what.priority = MovementPriority::urgent;
        move_robot(std::move(what));
        break;
      }
      case TourWish::follow: {
        FollowPerson what;
        what.priority = MovementPriority::urgent;
        move_robot(std::move(what));
        break;
      }
      case TourWish::stop:
        move_robot(StopMoving{});
        break;
    }
  }

  void acknowledge(const Address& move, const std::optional<TourRequest>& request) {
    const bool is_known =
      request &&
      (request->wish != TourWish::go ||
       std::ranges::any_of(read_all<Area>(), [&](auto& x) { return x->label == request->place; }));
    planning::MotiveAcknowledgement reply;
    reply.cause = EntryPointer<communication::DialogueMove>{move};
    reply.reply = is_known ? planning::MotiveReply::accepted : planning::MotiveReply::impossible;
    reply.words = reply_to(request, is_known);
    add(here("reply to " + move.id), reply);
  }

  template <class T>
  void move_robot(T what) {
    // The action before is cleared from the queue by this one.
    ActionOptions options;
    options.continues = true;
    movement_ = perform(navigation_.get(), std::move(what), options);
  }

  Option<SubarchitectureName> communication_{this, "communication", "communication",
                                             "whose dialogue moves count"};
  Option<SubarchitectureName> navigation_{this, "navigation", "navigation",
                                          "subarchitecture of the Navigator"};
  std::optional<ActionHandle> movement_;
};

CASTOR_COMPONENT(GuidedTour, "follows, and goes to areas by their names, as people say")

} // namespace

} // namespace castor::mapping
