// Somebody shows the robot of configs/explorer.cast around: it follows through two rooms, is told
// what they are called, and goes to one by name. In simulated time.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/text_file.hpp"
#include "castor/communication/types.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping::test {

/// Entry: where the robot is when it has come to the place it was sent to.
struct TourEnd {
  double x = 0;
  double y = 0;
  /// Replies that were not as expected.
  std::string surprises;
};
CASTOR_REFLECT(TourEnd, x, y, surprises)

namespace {

using namespace std::chrono_literals;
using castor::test::TemporaryFolder;

/// A corridor of 12 m x 2 m with two rooms above it. Ann walks from the corridor into the left
/// room, out again, and into the right one, where she stays for long. The map's frame is that of
/// the start.
constexpr const char* house = "wall 0 0 to 12 0 to 12 6 to 0 6 close\n"
                              "wall 0 2 to 12 2\n"
                              "wall 6 2 to 6 6\n"
                              "door left at 3 2 width 0.9\n"
                              "door right at 9 2 width 0.9\n"
                              "room corridor at 1 1\n"
                              "room one at 1 5\n"
                              "room two at 11 5\n"
                              "person ann route 2.2 1 to 3 1 to 3 3 to 4.8 4.6 to 1.6 4.8 to 3 3.2 "
                              "to 3 1 to 9 1 to 9 3.2 to 7.4 4.6 to 10.6 4.8 to 10 4 speed 0.4\n"
                              "start 0.8 1\n";

/// What is said in the office, and what the robot replies. The corridor has no name.
const std::vector<std::pair<std::string, std::string>> talk_in_office{
  {"Is this the kitchen?", "No."},
  {"Where is the kitchen?", "It is near a room."},
  {"What do you call this place?", "It is an office."},
  {"What is this place called?", "It is an office."},
  {"What's the name of this room?", "It is an office."},
  {"What kind of room is this?", "It is an office."},
  {"Do you know where you are?", "I am in the office."},
  {"Where am I?", "You are in the office."},
  {"Tell me where we are.", "We are in the office."},
  {"Are we in the kitchen?", "No."},
  {"How many rooms do you know?", "There are three rooms."},
  {"Is there a kitchen?", "Yes."},
  {"Do you know where the kitchen is?", "It is near a room."},
  {"Is the office next to the kitchen?", "No."},
  {"What is next to the kitchen?", "There is a room."},
  {"Which rooms adjoin the office?", "There is a room."},
  {"How many rooms are next to the kitchen?", "There is one room next to the kitchen."},
  {"Which room is the biggest?", "I do not know."},
  {"What is behind the kitchen?", "I do not know."},
  {"How do I get to the kitchen?", "Through a room."},
  {"What is the way to the office?", "It is here."},
  {"How do I get to the bathroom?", "I do not know."},
  {"Is there a bathroom?", "I do not see a bathroom."},
  {"Can you fetch the mail?", "I do not"},
  {"Go to the bathroom.", "I do not know where the bathroom is."},
};

/// Says the sentences of the tour when Ann is where they belong, by the tracker's entries.
class Leader final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>(std::string{"robot"},
                        [this](const std::shared_ptr<const BodyStatus>& x) { status_ = x; });
  }

  void run() override {
    wait_for([this] { return !read_all_in<Person>("people").empty(); });
    say("Follow me.");
    // In the middle of a room, where the robot has followed.
    wait_for([this] { return is_robot_in(1, 5, 3.2, 5.2); });
    expect(ask("This is the kitchen."), "kitchen");
    wait_for([this] { return is_named("kitchen"); });
    expect(ask("Where are we?"), "We are in the kitchen.");
    expect(ask("What is this room?"), "It is a kitchen.");
    expect(ask("This is the kitchen."), "Yes, this is the kitchen.");
    wait_for([this] { return is_robot_in(7, 11, 3.2, 5.2); });
    expect(ask("We are in the office."), "office");
    wait_for([this] { return is_named("office"); });
    for (auto& [sentence, reply] : talk_in_office)
      expect(ask(sentence), reply);
    expect(ask("Go to the kitchen."), "I go to the kitchen.");
    wait_for([this] { return is_arrived(); });
    add(TourEnd{status_->pose.x, status_->pose.y, surprises_});
  }

  template <class Condition>
  void wait_for(Condition condition) {
    while (!condition() && sleep_for(200ms)) {
      // Until then.
    }
  }

  bool is_robot_in(double left, double right, double low, double high) const {
    return status_ && status_->pose.x > left && status_->pose.x < right && status_->pose.y > low &&
           status_->pose.y < high;
  }

  bool is_named(const std::string& name) {
    for (auto& x : read_all_in<Area>("mapping"))
      if (x->label == name)
        return true;
    return false;
  }

  bool is_arrived() {
    for (auto& x : read_all_in<Movement>("navigation"))
      if (x->task == "go to kitchen" && x->status == MovementStatus::arrived)
        return true;
    return false;
  }

  void say(const std::string& sentence) {
    communication::PhonString x;
    x.word_sequence = sentence;
    x.length = 3;
    x.turn = turn_++;
    add(Address{"communication", "said " + std::to_string(x.turn)}, x);
  }

  /// What the robot replies.
  std::string ask(const std::string& sentence) {
    const auto utterance = "said " + std::to_string(turn_);
    say(sentence);
    std::string result;
    wait_for([&] {
      for (auto& x : read_all_in<communication::SpokenOutputItem>("communication"))
        if (x->utterance.address.id == utterance)
          result = x->text;
      return !result.empty();
    });
    return result;
  }

  /// @param part of the reply
  void expect(const std::string& reply, const std::string& part) {
    if (reply.find(part) == reply.npos)
      surprises_ += '"' + reply + "\" does not say \"" + part + "\"\n";
  }

  std::string surprises_;
  std::shared_ptr<const BodyStatus> status_;
  std::int32_t turn_ = 0;
};
CASTOR_COMPONENT(Leader, "shows the robot around")

TEST(GuidedTour, FollowsLearnsNamesAndGoesToOneOfThem) {
  const TemporaryFolder folder;
  const auto building = (folder / "house.building").string();
  save_text(building, house);
  TestSystemOptions options;
  options.file = CASTOR_CONFIGS "/explorer.cast";
  options.simulated_time = true;
  options.patience = 300s;
  options.open_access = true;
  options.variables = {{"building", building}, {"drive", "tour"}, {"talk", "true"},
                       {"people", "true"},     {"legs", "true"},  {"laser", "360"},
                       {"after", "stay"},      {"pictures", "0s"}};
  TestSystem system{load_text(options.file) + "\nSUBARCHITECTURE guide\n"
                                              "CPP WM SubarchitectureWorkingMemory\n"
                                              "CPP TM AlwaysPositiveTaskManager\n"
                                              "CPP UM leader Leader\n",
                    options};
  const auto end = system.expect_entry("TourEnd in guide")->value.as<TourEnd>();
  EXPECT_EQ(end->surprises, "");
  // The left room of the building.
  EXPECT_LT(end->x, 6);
  EXPECT_GT(end->y, 2);
  // Each name is that of one area, and of the right one.
  std::multiset<std::string> names;
  for (auto& entry : system.system().entries("mapping"))
    if (auto x = entry->value.as<Area>(); x && x->merged_into < 0 && !x->label.empty()) {
      names.insert(x->label);
      EXPECT_GT(x->y + 1, 2) << x->label << ": not the corridor";
      EXPECT_EQ(x->x + 0.8 < 6, x->label == "kitchen") << x->label << " at " << x->x;
    }
  EXPECT_EQ(names, (std::multiset<std::string>{"kitchen", "office"}));
  system.expect_nobody_else_down();
}

} // namespace

} // namespace castor::mapping::test
