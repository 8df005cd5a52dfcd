#include "castor/mapping/geometry/knows_frames.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/core.h>

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace castor::geometry::test {

using namespace std::chrono_literals;

/// Where the camera is in the map, as somebody else knows it.
struct Whereabouts {
  std::string text;

  friend bool operator==(const Whereabouts&, const Whereabouts&) = default;
};
CASTOR_REFLECT(Whereabouts, text)

/// A test has said what is to happen next.
struct Step {
  int number = 0;
};
CASTOR_REFLECT(Step, number)

namespace {

/// Says where the camera is whenever that has changed.
class FrameReader final : public KnowsFrames<UnmanagedComponent> {
  void start() override {
    know_frames_of("navigation");
    frames_changed();
  }

  void frames_changed() override {
    std::string problem;
    auto pose = frames().find_pose("camera", "map", {}, &problem);
    put(here("whereabouts"),
        Whereabouts{pose ? fmt::format("{}, {}", pose->position.x, pose->position.y) : problem});
  }
};
CASTOR_COMPONENT(FrameReader, "says where the camera is in the map")

/// Moves the robot step by step, each time after it was seen where it is.
class Localiser final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Whereabouts>().in("reader"), [this](const ChangeEvent& event) {
      if (event.operation != Operation::remove)
        seen_ = read<Whereabouts>(event.address)->text;
    });
  }

  void run() override {
    Address camera = here("camera");
    Address base = here("base");
    add(camera, Transform{"camera", {{0.5, 0, 1}, {}, "base"}, 0, true});
    add(base, Transform{"base", {{1, 2, 0}, {}, "map"}, now().count(), false});
    await("1.5, 2");
    overwrite(base, Transform{"base", {{3, 2, 0}, {}, "map"}, now().count(), false});
    await("3.5, 2");
    // Another opinion does not count, until the first is withdrawn.
    Address other = here("other");
    add(other, Transform{"base", {{7, 7, 0}, {}, "hall"}, 0, true});
    Address hall = here("hall");
    add(hall, Transform{"hall", {{10, 0, 0}, {}, "map"}, 0, true});
    overwrite(base, Transform{"base", {{4, 2, 0}, {}, "map"}, now().count(), false});
    await("4.5, 2");
    delete_entry(base);
    await("17.5, 7");
    // What two say is not forgotten with one of them.
    Address twin = here("twin");
    add(twin, Transform{"base", {{7, 7, 0}, {}, "hall"}, 0, true});
    delete_entry(other);
    overwrite(hall, Transform{"hall", {{11, 0, 0}, {}, "map"}, 0, true});
    await("18.5, 7");
    delete_entry(twin);
    await("no transform between 'map' and 'camera': 'camera' is not connected; connected to 'map': "
          "hall; connected to 'camera': base");
    add(Step{1});
    sleep_for(1h);
  }

  void await(const std::string& wanted) {
    while (seen_ != wanted && wait_for_changes())
      debug("the camera is at {}", seen_);
  }

  std::string seen_;
};
CASTOR_COMPONENT(Localiser, "moves a robot step by step")

constexpr auto two_subarchitectures = "HOST localhost\n"
                                      "SUBARCHITECTURE navigation\n"
                                      "CPP WM SubarchitectureWorkingMemory\n"
                                      "CPP TM AlwaysPositiveTaskManager\n"
                                      "CPP UM localiser Localiser\n"
                                      "SUBARCHITECTURE reader\n"
                                      "CPP WM SubarchitectureWorkingMemory\n"
                                      "CPP TM AlwaysPositiveTaskManager\n"
                                      "CPP UM reader FrameReader\n";

TEST(KnowsFrames, FollowsTheTransformsOfAnotherSubarchitecture) {
  TestSystem system{two_subarchitectures};
  system.expect_entry("Step in navigation where number == 1");
  system.expect_nobody_else_down();
}

TEST(KnowsFrames, AreThereAgainAfterAFailure) {
  TestSystem system{two_subarchitectures};
  system.expect_entry("Step in navigation where number == 1");
  system.inject("crash reader");
  system.expect_back("reader");
  system.expect_entry("Whereabouts in reader where text == \"no transform between 'map' and "
                      "'camera': 'camera' is not connected; connected to 'map': hall; connected to "
                      "'camera': base\"");
}

} // namespace

} // namespace castor::geometry::test
