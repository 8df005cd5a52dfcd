#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/mapping/tour/place_names.hpp"
#include "castor/mapping/tour/tour_request.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Lets the robot be shown around: it follows who says so, names areas as it is told, and goes to
/// where it is sent by name. In the subarchitecture of the navigation graph.
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
    on_change(changed<RobotArea>().in(subarchitecture()),
              [this](const ChangeEvent&) { name_areas(); });
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
      case TourWish::name_place:
        if (const auto where = place_of_speaker()) {
          names_.add(request->place, *where);
          name_areas();
        } else {
          warning("\"{}\" is not noted: the robot does not know where it is", request->place);
        }
        break;
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

  std::optional<Pose2> robot() {
    for (auto& x : read_all_in<RobotPose>(localisation_.get()))
      if (x->state != LocalisationState::starting && x->state != LocalisationState::lost)
        return x->pose;
    return std::nullopt;
  }

  /// Of the person in sight who is nearest to the robot; without, of the robot.
  std::optional<Point2> place_of_speaker() {
    const auto pose = robot();
    if (!pose)
      return std::nullopt;
    Point2 result{pose->x, pose->y};
    double nearest = speaker_;
    constexpr double in_sight = 0.5;
    if (!people_->empty())
      for (auto& x : read_all_in<Person>(people_.get()))
        if (const auto far = distance(Point2{pose->x, pose->y}, Point2{x->x, x->y});
            x->visibility >= in_sight && far < nearest) {
          nearest = far;
          result = {x->x, x->y};
        }
    return result;
  }

  void name_areas() {
    if (names_.is_empty())
      return;
    const auto pose = robot();
    const auto positions = read_all<RobotArea>();
    if (!pose || positions.empty())
      return;
    std::vector<GraphNode> nodes;
    for (auto& x : read_all<GraphNode>())
      nodes.push_back(*x);
    for (auto& x : names_.take_moved(nodes)) {
      name({x.from, {}});
      name(x.now);
    }
    for (auto& x : names_.take_known(*pose, *positions.front(), nodes))
      name(x);
  }

  /// @param x without a name, the area has none any more
  void name(const PlaceNames::Named& x) {
    const auto address = here("area-" + std::to_string(x.area));
    // Its builder may write it at the same time.
    for (;;)
      try {
        auto area = *read<Area>(address);
        area.label = x.name;
        overwrite(address, area);
        if (x.name.empty())
          info("area {} has no name any more", x.area);
        else
          info("area {} is called {}", x.area, x.name);
        return;
      } catch (const ConsistencyException&) {
        debug("{} has changed meanwhile", address.id);
      } catch (const DoesNotExistOnWM&) {
        warning("\"{}\" is not noted: area {} does not exist any more", x.name, x.area);
        return;
      }
  }

  Option<SubarchitectureName> communication_{this, "communication", "communication",
                                             "whose dialogue moves count"};
  Option<SubarchitectureName> navigation_{this, "navigation", "navigation",
                                          "subarchitecture of the Navigator"};
  Option<SubarchitectureName> localisation_{this, "localisation", "slam",
                                            "whose RobotPose entries say where the robot is"};
  Option<std::string> people_{this, "people", "",
                              "subarchitecture of a PersonTracker; empty: none"};
  Option<double> speaker_{this, "speaker", 4,
                          "somebody who speaks is at most so far from the robot, metres"};

  PlaceNames names_;
  std::optional<ActionHandle> movement_;
};

CASTOR_COMPONENT(GuidedTour, "follows, names areas and goes to them, as people say")

} // namespace

} // namespace castor::mapping
