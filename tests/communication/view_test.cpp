// "The leftmost thing" is the one that is left of all others, wherever the camera stands.
#include "castor/perception/spatial/camera_directions.hpp"
#include "castor/tests/communication/table_scene.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace castor::communication::test {

namespace {

using binding::FeatureKind;
using spatial::GroundPoint;
using spatial::SpatialRelation;
using testing::HasSubstr;

const double pi = std::acos(-1.0);

/// Looks at the origin from `turn` (radians, counter-clockwise) beside the south, and down by 45
/// degrees.
vision::Pose camera_turned_by(double turn) {
  const double down = 3 * pi / 8;
  const double cosine = std::cos(turn / 2);
  const double sine = std::sin(turn / 2);
  // First down, then around the z axis.
  return {{std::sin(turn), -std::cos(turn), 1},
          {cosine * std::cos(down), -cosine * std::sin(down), -sine * std::sin(down),
           sine * std::cos(down)}};
}

/// One thing of each colour, as seen from a camera.
class TableInView {
public:
  explicit TableInView(double turn)
    : directions_(*spatial::viewing_directions(camera_turned_by(turn))) {
    for (auto& [colour, at] : places_) {
      const auto seen = as_seen(directions_, at);
      table_.put(colour,
                 {feature(FeatureKind::colour, colour), feature(FeatureKind::shape, "cube"),
                  binding::extent_of(0.05, 0.05, 0.05)},
                 at.x, at.y, {binding::seen_at(seen.x, seen.y, 0)});
    }
    for (auto& [target, at] : places_)
      for (auto& [landmark, other] : places_)
        if (target != landmark)
          for (auto& [relation, name] : names_)
            if (is_on_side(directions_, relation, at, other))
              table_.relate(name, target, landmark);
  }

  /// The colour of what is on that side of all others.
  std::string beyond_all_others(SpatialRelation relation) const {
    for (auto& [target, at] : places_) {
      bool is_beyond = true;
      for (auto& [landmark, other] : places_)
        is_beyond &= target == landmark || is_on_side(directions_, relation, at, other);
      if (is_beyond)
        return target;
    }
    return {};
  }

  std::string say(const std::string& text) {
    TableTalk talk{[this](auto& asked) { return table_.reply(asked); }};
    return talk.say(text).text;
  }

private:
  spatial::GroundDirections directions_;
  std::map<std::string, GroundPoint> places_{
    {"red", {-0.3, 0.05}}, {"green", {0.05, 0.3}}, {"blue", {0.3, -0.05}}, {"yellow", {0, -0.3}}};
  std::map<SpatialRelation, std::string> names_{{SpatialRelation::left, "left"},
                                                {SpatialRelation::right, "right"},
                                                {SpatialRelation::front, "front"},
                                                {SpatialRelation::back, "back"}};
  TableScene table_;
};

TEST(View, DecidesWhatIsOutermostAsItDecidesRelations) {
  const std::map<SpatialRelation, std::vector<std::string>> questions{
    {SpatialRelation::left,
     {"What colour is the leftmost thing?", "What colour is the thing on the left?",
      "What colour is the first cube from the left?"}},
    {SpatialRelation::right,
     {"What colour is the rightmost thing?", "What colour is the thing on the right?"}},
    {SpatialRelation::front,
     {"What colour is the thing nearest to you?", "What colour is the thing at the front?"}},
    {SpatialRelation::back,
     {"What colour is the thing that is furthest away?", "What colour is the thing at the back?",
      "What colour is the thing furthest back?"}}};
  for (const int degrees : {0, 90, 180, 270}) {
    TableInView table{degrees * pi / 180};
    for (auto& [relation, texts] : questions) {
      const auto colour = table.beyond_all_others(relation);
      ASSERT_FALSE(colour.empty());
      for (auto& text : texts)
        EXPECT_THAT(table.say(text), HasSubstr(colour)) << text << ' ' << degrees;
    }
  }
}

} // namespace

} // namespace castor::communication::test
