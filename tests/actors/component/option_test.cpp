#include "castor/actors/component/option.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

enum class Side { left, right };
CASTOR_REFLECT_ENUM(Side, left, right)

struct Options : testing::Test {
  OptionList list;
  Option<bool> flag{list, "flag", false, "a flag"};
  Option<int> count{list, "count", 3, "a count"};
  Option<std::uint8_t> small{list, "small", std::uint8_t{7}, "a small number"};
  Option<double> ratio{list, "ratio", 0.5, "a ratio"};
  Option<std::string> name{list, "name", "nobody", "a name"};
  Option<std::chrono::milliseconds> period{list, "period", 250ms, "a period"};
  Option<std::vector<std::string>> friends{list, "friends", {}, "some names"};
  Option<Side> side{list, "side", Side::left, "a side"};
};

TEST_F(Options, SayWhatTheyAreNamesOf) {
  Option<StandaloneName> camera{list, "camera", "camera", "a camera"};
  EXPECT_EQ(camera.reference(), Reference::standalone);
  EXPECT_EQ(camera.kind(), "name of a stand-alone component");
  EXPECT_EQ(camera.text(), "camera");
  EXPECT_EQ(list.set("camera", "other"), std::nullopt);
  const std::string& name_of_it = camera;
  EXPECT_EQ(name_of_it, "other");
  EXPECT_EQ(name.reference(), Reference::none);
}

TEST_F(Options, HaveTheirDefaults) {
  EXPECT_FALSE(flag);
  EXPECT_EQ(count, 3);
  EXPECT_EQ(ratio, 0.5);
  EXPECT_EQ(name.get(), "nobody");
  EXPECT_EQ(period.get(), 250ms);
  EXPECT_EQ(side, Side::left);
}

TEST_F(Options, TakeWhatUsersWrite) {
  for (auto& [key, value] : std::vector<std::pair<std::string, std::string>>{{"flag", "true"},
                                                                             {"count", "-12"},
                                                                             {"small", "255"},
                                                                             {"ratio", "1e-3"},
                                                                             {"name", "the box"},
                                                                             {"period", "1.5s"},
                                                                             {"friends", "a,b,,c"},
                                                                             {"side", "right"}})
    EXPECT_EQ(list.set(key, value), std::nullopt) << key;
  EXPECT_TRUE(flag);
  EXPECT_EQ(count, -12);
  EXPECT_EQ(small, 255);
  EXPECT_EQ(ratio, 1e-3);
  EXPECT_EQ(name.get(), "the box");
  EXPECT_EQ(period.get(), 1500ms);
  EXPECT_EQ(friends.get(), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(side, Side::right);
}

TEST_F(Options, RefuseWhatIsNoSuchValueAndKeepTheOld) {
  for (auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"flag", "maybe"},
                                                        {"count", "3.5"},
                                                        {"count", "99999999999"},
                                                        {"count", ""},
                                                        {"small", "256"},
                                                        {"small", "-1"},
                                                        {"ratio", "inf"},
                                                        {"ratio", "0.5x"},
                                                        {"period", "10"},
                                                        {"period", "10 s"},
                                                        {"period", "-1s"},
                                                        {"period", "s"},
                                                        {"side", "up"}}) {
    auto problem = list.set(key, value);
    ASSERT_TRUE(problem) << key << " " << value;
    EXPECT_NE(problem->find("--" + key + " takes a"), std::string::npos) << *problem;
    EXPECT_NE(problem->find('"' + value + '"'), std::string::npos) << *problem;
  }
  EXPECT_EQ(count, 3);
  EXPECT_EQ(small, 7);
  EXPECT_EQ(period.get(), 250ms);
}

TEST_F(Options, GuessMisspeltNames) {
  auto problem = list.set("perod", "1s");
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->find("no option --perod"), std::string::npos) << *problem;
  EXPECT_NE(problem->find("did you mean 'period'?"), std::string::npos) << *problem;
  EXPECT_NE(list.set("xyzzyx", "1")->find("castor components"), std::string::npos);
}

TEST_F(Options, PrintWhatTheyParse) {
  for (auto* option : list.all()) {
    auto text = option->text();
    EXPECT_TRUE(option->parse(text)) << option->name() << " " << text;
    EXPECT_EQ(option->text(), text);
  }
  list.set("period", "90s");
  EXPECT_EQ(period.text(), "90s");
  EXPECT_EQ(side.kind(), "left|right");
}

} // namespace

} // namespace castor
