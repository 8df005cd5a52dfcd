#include "castor/planning/motivation/occasions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::planning {
namespace {

using namespace std::chrono_literals;

class OccasionsTest : public testing::Test {
protected:
  std::vector<std::string> look(const std::vector<std::string>& facts, bool is_idle,
                                Timestamp now) {
    std::vector<std::string> result;
    for (const auto& x : occasions.look(facts, is_idle, now))
      result.push_back(x.words);
    return result;
  }

  const std::vector<MotiveTemplate> templates =
    parse_motives("m", "motive charge\n  when (battery-low ?r)\n"
                       "  goal (charged {r})\n  words charge {r}\n"
                       "motive explore\n  when idle 30s\n"
                       "  goal (explored)\n  words explore\n"
                       "motive find\n  on Find\n"
                       "  goal (found)\n  words find\n")
      .templates;
  Occasions occasions{templates};
};

using Words = std::vector<std::string>;

TEST_F(OccasionsTest, OccasionAMotiveOnceUntilTheFactWasFalse) {
  EXPECT_EQ(look({"(battery-low robby)"}, false, 0s), Words{"charge robby"});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 1s), Words{});
  EXPECT_EQ(look({"(battery-low robby)", "(battery-low bob)"}, false, 2s), Words{"charge bob"});
  EXPECT_EQ(look({}, false, 3s), Words{});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 4s), Words{"charge robby"});
}

TEST_F(OccasionsTest, OccasionAMotiveAgainWhileItsFactStaysTrue) {
  occasions = Occasions(templates, 1min);
  EXPECT_EQ(look({"(battery-low robby)"}, false, 0s), Words{"charge robby"});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 59s), Words{});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 60s), Words{"charge robby"});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 61s), Words{});
  EXPECT_EQ(look({"(battery-low robby)"}, false, 120s), Words{"charge robby"});
}

TEST_F(OccasionsTest, OccasionAMotiveAfterIdleness) {
  EXPECT_EQ(look({}, true, 100s), Words{});
  EXPECT_EQ(look({}, true, 129s), Words{});
  EXPECT_EQ(look({}, true, 130s), Words{"explore"});
  EXPECT_EQ(look({}, false, 131s), Words{});
  EXPECT_EQ(look({}, true, 140s), Words{});
  EXPECT_EQ(look({}, true, 169s), Words{});
  EXPECT_EQ(look({}, true, 170s), Words{"explore"});
}

} // namespace
} // namespace castor::planning
