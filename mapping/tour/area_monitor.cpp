#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/values_of.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/mapping/tour/area_knowledge.hpp"
#include "castor/mapping/tour/place_names.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

/// Says which areas of the navigation graph there are, and where the robot is, to who asks binding;
/// and takes note of what people call them. In the subarchitecture of the graph.
class AreaMonitor final : public binding::BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_call<binding::KnowledgeRequest>([this](const binding::KnowledgeRequest&) {
      return knowledge_of_areas(values_of(read_all<Area>()), values_of(read_all<GraphNode>()),
                                values_of(read_all<GraphEdge>()), area_of_robot());
    });
    on_call<binding::ToldName>([this](const binding::ToldName& x) {
      return binding::ToldNameReply{take_note(label_of_concept(x.name))};
    });
    on_change(changed<RobotArea>().in(subarchitecture()),
              [this](const ChangeEvent&) { name_areas(); });
    declare_knowledge_of("room", true, true);
    declare_knowledge_of("self", true);
  }

  /// @returns what is said in reply
  std::string take_note(const std::string& label) {
    const auto where = place_of_speaker();
    if (!where)
      return "I do not know where I am.";
    names_.add(label, *where);
    for (auto& x : name_areas())
      if (x.label == label)
        return reply_to_name(label, x.before);
    return reply_to_name(label, std::nullopt);
  }

  std::optional<Pose2> robot() {
    for (auto& x : read_all_in<RobotPose>(localisation_.get()))
      if (x->state != LocalisationState::starting && x->state != LocalisationState::lost)
        return x->pose;
    return std::nullopt;
  }

  std::optional<std::int64_t> area_of_robot() {
    const auto positions = read_all<RobotArea>();
    if (positions.empty() || positions.front()->area < 0 || !robot())
      return std::nullopt;
    return positions.front()->area;
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

  struct Labelled {
    std::string label;
    /// What the area was called before.
    std::string before;
  };

  /// @returns what areas are called now
  std::vector<Labelled> name_areas() {
    std::vector<Labelled> result;
    if (names_.is_empty())
      return result;
    const auto pose = robot();
    const auto positions = read_all<RobotArea>();
    if (!pose || positions.empty())
      return result;
    const auto nodes = values_of(read_all<GraphNode>());
    for (auto& x : names_.take_moved(nodes)) {
      name({x.from, {}});
      name(x.now);
    }
    for (auto& x : names_.take_known(*pose, *positions.front(), nodes))
      if (const auto before = name(x))
        result.push_back({x.name, *before});
    return result;
  }

  /// @param x without a name, the area has none any more
  /// @returns the name before; nothing if there is no such area
  std::optional<std::string> name(const PlaceNames::Named& x) {
    const auto address = here("area-" + std::to_string(x.area));
    // Its builder may write it at the same time.
    for (;;)
      try {
        auto area = *read<Area>(address);
        const auto before = area.label;
        area.label = x.name;
        overwrite(address, area);
        if (x.name.empty())
          info("area {} has no name any more", x.area);
        else
          info("area {} is called {}", x.area, x.name);
        return before;
      } catch (const ConsistencyException&) {
        debug("{} has changed meanwhile", address.id);
      } catch (const DoesNotExistOnWM&) {
        warning("\"{}\" is not noted: area {} does not exist any more", x.name, x.area);
        return std::nullopt;
      }
  }

  Option<SubarchitectureName> localisation_{this, "localisation", "slam",
                                            "whose RobotPose entries say where the robot is"};
  Option<std::string> people_{this, "people", "",
                              "subarchitecture of a PersonTracker; empty: none"};
  Option<double> speaker_{this, "speaker", 4,
                          "somebody who speaks is at most so far from the robot, metres"};

  PlaceNames names_;
};

CASTOR_COMPONENT(AreaMonitor, "says which areas there are, and what people call them")

} // namespace

} // namespace castor::mapping
