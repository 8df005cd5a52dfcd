#include "castor/tools/cli/foxglove.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

// Types as users have them: none is called as Castor's are.
struct Vec {
  double x = 0;
  double y = 0;
  double z = 0;
};
struct Quat {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};
struct Placement {
  Vec position;
  Quat orientation;
};
struct Extent {
  Vec center;
  Vec size;
};
struct Snapshot {
  std::string mime_type;
  std::vector<std::uint8_t> data;
};
struct Cup {
  Placement place;
  Extent extent;
  std::string colour;
  std::string name;
};
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  std::vector<std::uint8_t> bytes;
};
struct Report {
  Snapshot photo;
  std::optional<Pixels> sketch;
  std::int32_t camera = 3;
};
struct Words {
  std::string text;
  std::vector<std::uint8_t> data;
};
CASTOR_REFLECT(Vec, x, y, z)
CASTOR_REFLECT(Quat, w, x, y, z)
CASTOR_REFLECT(Placement, position, orientation)
CASTOR_REFLECT(Extent, center, size)
CASTOR_REFLECT(Snapshot, mime_type, data)
CASTOR_REFLECT(Cup, place, extent, colour, name)
CASTOR_REFLECT(Pixels, width, height, channels, bytes)
CASTOR_REFLECT(Report, photo, sketch, camera)
CASTOR_REFLECT(Words, text, data)

std::vector<std::string> topics(const std::vector<FoxgloveMessage>& messages) {
  std::vector<std::string> result;
  for (auto& x : messages)
    result.push_back(x.topic);
  return result;
}

Cup red_cup() {
  return {{{1, 2, 3}, {}}, {{1, 2, 3}, {0.1, 0.2, 0.3}}, "red", "cup"};
}

TEST(FoxgloveView, ShowsAnEntryAsACubeUntilItIsGone) {
  FoxgloveView view;
  auto shown = view.change("/table/Cup", "a", 1'500'000us, Value::of(red_cup()));
  ASSERT_THAT(topics(shown), ElementsAre("/table/Cup/poses", "/table/Cup/scene"));
  EXPECT_EQ(shown[0].content["poses"][0]["position"]["z"], 3);
  EXPECT_EQ(shown[0].content["timestamp"]["sec"], 1);
  EXPECT_EQ(shown[0].content["timestamp"]["nsec"], 500'000'000);
  auto& entity = shown[1].content["entities"][0];
  EXPECT_EQ(entity["id"], "a");
  EXPECT_EQ(entity["cubes"][0]["size"]["y"], 0.2);
  EXPECT_GT(entity["cubes"][0]["color"]["r"], 0.5);
  EXPECT_THAT(entity["arrows"], IsEmpty());
  EXPECT_EQ(entity["texts"][0]["text"], "red cup");
  view.change("/table/Cup", "b", 2s, Value::of(red_cup()));
  auto gone = view.change("/table/Cup", "a", 3s, {});
  ASSERT_THAT(topics(gone), ElementsAre("/table/Cup/poses", "/table/Cup/scene"));
  EXPECT_EQ(gone[0].content["poses"].size(), 1u);
  EXPECT_EQ(gone[1].content["deletions"][0]["id"], "a");
  EXPECT_THAT(view.change("/table/Cup", "a", 4s, {}), IsEmpty());
}

TEST(FoxgloveView, ShowsWhatIsFlatAsAThinBoxAndWhatHasNoSizeAsAnArrow) {
  FoxgloveView view;
  auto flat = red_cup();
  flat.extent.size.z = 0;
  auto entity = view.change("/t/Cup", "a", 1s, Value::of(flat)).back().content["entities"][0];
  EXPECT_EQ(entity["cubes"][0]["size"]["z"], 0.001);
  flat.extent.size = {};
  entity = view.change("/t/Cup", "a", 1s, Value::of(flat)).back().content["entities"][0];
  EXPECT_THAT(entity["cubes"], IsEmpty());
  EXPECT_EQ(entity["arrows"].size(), 1u);
}

TEST(FoxgloveView, LeavesOutWhatIsNoNumber) {
  FoxgloveView view;
  auto lost = red_cup();
  lost.place.position.x = std::numeric_limits<double>::quiet_NaN();
  lost.extent.center.y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(view.change("/t/Cup", "a", 1s, Value::of(lost)), IsEmpty());
}

TEST(FoxgloveView, ShowsPicturesByTheirShapeAndFormat) {
  FoxgloveView view;
  Report report{{"image/jpeg", {0xff, 0xd8, 0xff}}, Pixels{2, 1, 3, {0, 0, 255, 0, 0, 255}}, 3};
  auto shown = view.change("/t/Report", "a", 1s, Value::of(report));
  ASSERT_THAT(topics(shown), ElementsAre("/t/Report/photo", "/t/Report/sketch"));
  EXPECT_EQ(shown[0].content["format"], "jpeg");
  EXPECT_EQ(shown[0].content["data"], "/9j/");
  EXPECT_EQ(shown[0].content["frame_id"], "camera 3");
  EXPECT_EQ(shown[1].content["format"], "png");
  EXPECT_EQ(shown[1].content["data"].get<std::string>().substr(0, 6), "iVBORw");
  report.photo.mime_type = "text/plain";
  report.sketch->bytes.pop_back();
  EXPECT_THAT(view.change("/t/Report", "b", 1s, Value::of(report)), IsEmpty());
  EXPECT_THAT(view.change("/t/Words", "c", 1s, Value::of(Words{"png", {1, 2, 3}})), IsEmpty());
}

TEST(FoxgloveView, ShowsAPictureThatIsTheValueItselfAndRepeatsNoneThatIsHandedOut) {
  FoxgloveView view;
  auto value = Value::of(Snapshot{"png", {1, 2, 3}});
  EXPECT_THAT(topics(view.handed_out("/camera/Snapshot", 1s, value)),
              ElementsAre("/camera/Snapshot/picture"));
  EXPECT_THAT(view.handed_out("/camera/Snapshot", 2s, value), IsEmpty());
  EXPECT_THAT(view.handed_out("/camera/Snapshot", 3s, Value::of(Snapshot{"png", {1, 2, 4}})).size(),
              1u);
}

} // namespace

} // namespace castor::cli
