// Locations in different frames, which a third subarchitecture relates.
#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::binding::test {

namespace {

using namespace std::chrono_literals;
using geometry::Transform;

/// Tells of one place.
class PlaceMonitor final : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    BindingProxy place;
    place.precedence = precedence_;
    place.features = {feature(FeatureKind::temporal_frame, perceived_frame),
                      not_from(subarchitecture()), location_at(x_, 0, 0, frame_)};
    tell(component_name(), std::move(place));
    publish();
  }

  Option<int> precedence_{this, "precedence", 0, "when it is bound"};
  Option<double> x_{this, "x", 0, "where the place is"};
  Option<std::string> frame_{this, "frame", "", "in which frame"};
};
CASTOR_COMPONENT(PlaceMonitor, "for tests: tells binding of one place")

/// Says where the robot is when binding has bound what it could before.
class RobotMover final : public UnmanagedComponent {
  void start() override {
    on_change(changed<BindingUnion>().in("binding"), [](const ChangeEvent&) {});
  }

  void run() override {
    await({"seen", "felt"}, 2);
    // One metre before the table: what it feels one metre before itself is in the middle.
    auto base = here("base");
    add(base, robot_at(-1));
    await({"seen", "felt"}, 1);
    read<Transform>(base);
    overwrite(base, robot_at(-2));
    await({"seen", "felt"}, 2);
    overwrite(base, robot_at(-1));
    await({"seen", "felt"}, 1);
    delete_entry(base);
    await({"seen", "felt"}, 2);
    end_system(0, "all was bound as it should be");
  }

  Transform robot_at(double x) const {
    return {"base", {{x, 0, 0}, {}, "table"}, now().count(), false};
  }

  /// Until these proxies are in so many unions.
  void await(const std::vector<std::string>& proxies, std::size_t unions) {
    while (true) {
      std::size_t members = 0;
      auto all = read_all_in<BindingUnion>("binding");
      for (auto& x : all)
        members += x->proxy_ids.size();
      if (members == proxies.size() && all.size() == unions)
        return;
      if (!wait_for_changes())
        return;
    }
  }
};
CASTOR_COMPONENT(RobotMover, "for tests: says where the robot is")

std::string subarchitecture(const std::string& name, const std::string& components) {
  return "SUBARCHITECTURE " + name +
         "\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n" + components +
         "ACCESS " + name + " WRITES binding\n";
}

TEST(BindingFrames, LocationsAreBoundWhenAndWhileTheirFramesAreRelatedSo) {
  TestSystem system{
    "HOST localhost\n"
    "SUBARCHITECTURE binding\n"
    "CPP WM SubarchitectureWorkingMemory\n"
    "CPP TM AlwaysPositiveTaskManager\n"
    "CPP UM scorer BindingScorer --frames-of navigation\n"
    "CPP UM judge BindingJudge\n"
    "CPP UM binder Binder\n" +
    subarchitecture("vision", "CPP UM seen PlaceMonitor --frame table\n") +
    subarchitecture("touch", "CPP UM felt PlaceMonitor --frame base --x 1 --precedence 1\n") +
    subarchitecture("navigation", "CPP UM mover RobotMover\n")};
  system.expect_end(0, "all was bound as it should be", 30s);
  system.expect_nobody_else_down();
}

} // namespace

} // namespace castor::binding::test
