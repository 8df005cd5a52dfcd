#include "castor/tools/timeline/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace castor::timeline::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> told(const std::string& json) {
  return summary(nlohmann::ordered_json::parse(json),
                 [](const std::string& x) { return x == "0:1" || x == "0:2"; });
}

TEST(TimelineSummary, WhatIsSaidComesBeforeWordsAndNumbers) {
  EXPECT_THAT(told(R"({"length": 5, "rank": 0, "colour": "blue",
                       "word_sequence": "this is a blue square"})"),
              ElementsAre("\u201cthis is a blue square\u201d", "colour blue", "length 5"));
}

TEST(TimelineSummary, WhatIsEmptyOrZeroOrATimeIsLeftOut) {
  EXPECT_THAT(told(R"({"time": 1234567, "label": "", "size": 0, "there": false, "ids": [],
                       "at": {"x": 0, "y": 0.0}, "numbers": [0, 0], "nothing": null})"),
              IsEmpty());
}

TEST(TimelineSummary, AHypothesisIsAWordAndHowSureItIs) {
  EXPECT_THAT(told(R"({"color": {"value": "red", "confidence": 0.93456},
                       "shape": {"value": "unknown", "confidence": 0}})"),
              ElementsAre("color red 0.93", "shape unknown"));
  EXPECT_THAT(told(R"({"colours": [{"value": "red", "confidence": 0.9},
                                   {"value": "pink", "confidence": 0.01}]})"),
              ElementsAre("colours red 0.9"));
}

TEST(TimelineSummary, PlacesAreTuples) {
  EXPECT_THAT(told(R"({"position": {"x": 0.1, "y": -0.25, "z": 0}})"),
              ElementsAre("position (0.1, -0.25, 0)"));
}

TEST(TimelineSummary, WhatLeadsToEntriesIsMarked) {
  EXPECT_THAT(told(R"({"object_id": "0:1", "of": {"subarchitecture": "vision", "id": "7"},
                       "roi_ids": ["0:1", "0:2"], "others": ["x", "y"]})"),
              ElementsAre("others x, y", "object id \u2192 0:1", "of \u2192 vision/7",
                          "roi ids \u2192 0:1, 0:2"));
}

TEST(TimelineSummary, WhatIsTrueIsNamed) {
  EXPECT_THAT(told(R"({"changed": true, "processed": false})"), ElementsAre("changed"));
}

TEST(TimelineSummary, LongListsAreCounted) {
  std::string numbers = "[1";
  std::string records = "[{\"x\": \"a\"}";
  for (int i = 1; i < 20; ++i) {
    numbers += ", 1";
    records += ", {\"x\": \"a\"}";
  }
  EXPECT_THAT(told("{\"scores\": " + records + "], \"numbers\": " + numbers + "]}"),
              ElementsAre("20 scores", "20 numbers"));
}

TEST(TimelineSummary, FeaturesAreToldWordsFirstAndWhatIsNotSoLast) {
  EXPECT_THAT(told(R"({"features": [
    {"kind": "other_source", "text": "vision", "numbers": [], "negated": true},
    {"kind": "source_data", "text": "", "numbers": [], "data": {"address":
       {"subarchitecture": "vision", "id": "0:1"}, "type": "SceneObject"}, "negated": false},
    {"kind": "creation_time", "text": "", "numbers": [1234567], "negated": false},
    {"kind": "colour", "text": "blue", "numbers": [], "negated": false}]})"),
              ElementsAre("colour blue", "source data \u2192 vision/0:1 SceneObject",
                          "not other source vision"));
}

TEST(TimelineSummary, PicturesAreForOthersToShow) {
  EXPECT_THAT(
    told(R"({"image": {"width": 3, "height": 4, "channels": 3, "bytes": {"bytes": 36}}})"),
    IsEmpty());
}

TEST(TimelineSummary, WhatIsNoRecordHasNone) {
  EXPECT_THAT(told("[1, 2]"), IsEmpty());
  EXPECT_THAT(told("null"), IsEmpty());
}

} // namespace

} // namespace castor::timeline::test
