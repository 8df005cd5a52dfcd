#include "castor/wm/filters/change_filter_parser.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor {

namespace {

std::string why_not(const std::string& text) {
  try {
    parse_change_filter(text);
  } catch (const ChangeFilterError& e) {
    return e.what();
  }
  return {};
}

TEST(ParseChangeFilter, NothingIsEveryChangeAnywhere) {
  EXPECT_EQ(parse_change_filter(""), any_change().anywhere());
  EXPECT_EQ(parse_change_filter("  changed "), any_change().anywhere());
}

TEST(ParseChangeFilter, OperationsAreCalledAsInCodeOrAsInTraces) {
  for (auto text : {"added", "ADD"})
    EXPECT_EQ(parse_change_filter(text).operation, Operation::add);
  for (auto text : {"overwritten", "OVERWRITE"})
    EXPECT_EQ(parse_change_filter(text).operation, Operation::overwrite);
  for (auto text : {"deleted", "DELETE"})
    EXPECT_EQ(parse_change_filter(text).operation, Operation::remove);
  EXPECT_EQ(parse_change_filter("changed Ball").operation, std::nullopt);
}

TEST(ParseChangeFilter, ReadsAllThereIs) {
  auto x = parse_change_filter("overwritten SceneObject in vision from tracker at 0:3 "
                               "changing pose,label where confidence > 0.8 && label == \"in box\"");
  ChangeFilter expected;
  expected.operation = Operation::overwrite;
  expected.type = "SceneObject";
  expected.subarchitecture = "vision";
  expected.source = "tracker";
  expected.id = "0:3";
  expected =
    expected.changing_any({"pose", "label"}).where("confidence > 0.8 && label == \"in box\"");
  EXPECT_EQ(x, expected);
}

TEST(ChangeFilterText, IsReadAsTheSameFilter) {
  for (auto text : {"changed", "added Ball", "changed Ball", "deleted", "changed in vision",
                    "changed at 0:3", "changed at \"tile 3 -1\" where x > 1",
                    "changed at \"a \\\"b\\\" \\\\ c\"", "changed where x > 1",
                    "overwritten SceneObject in vision from tracker at 0:3 changing label,pose "
                    "where confidence > 0.8 && label == \"in box\""})
    EXPECT_EQ(change_filter_text(parse_change_filter(text)), text);
}

TEST(ParseChangeFilter, EverythingMayBeMissing) {
  EXPECT_EQ(parse_change_filter("Ball").type, "Ball");
  EXPECT_EQ(parse_change_filter("in vision").subarchitecture, "vision");
  EXPECT_TRUE(parse_change_filter("in vision").type.empty());
  EXPECT_EQ(parse_change_filter("where x > 1").predicate, Predicate::parse("x > 1"));
}

TEST(ParseChangeFilter, HasIdsWithBlanksInQuotes) {
  EXPECT_EQ(parse_change_filter("at \"tile 3 -1\" where x > 1").id, "tile 3 -1");
  EXPECT_EQ(parse_change_filter("Tile at \"say \\\"in\\\" here\" in maps").id, "say \"in\" here");
  EXPECT_EQ(parse_change_filter("at tile").id, "tile");
  EXPECT_NE(why_not("at \"tile 3").find("no quote at the end of \"tile 3"), std::string::npos);
  EXPECT_NE(why_not("at \"\"").find("nothing behind \"at\""), std::string::npos);
}

TEST(ChangeFilterText, IsOfArgumentsOfWhichOneIsAnId) {
  const auto id = [](const std::vector<std::string>& arguments) {
    return parse_change_filter(change_filter_text(arguments)).id;
  };
  EXPECT_EQ(id({"Tile", "at", "tile 3 -1", "where", "x > 1"}), "tile 3 -1");
  EXPECT_EQ(id({"Tile", "at", "\"tile 3 -1\""}), "tile 3 -1");
  EXPECT_EQ(id({"Tile at \"tile 3 -1\" in maps"}), "tile 3 -1");
  EXPECT_EQ(id({"Tile", "at", "0:3"}), "0:3");
  EXPECT_EQ(parse_change_filter(change_filter_text({"added", "Ball", "where", "x > 1"})),
            parse_change_filter("added Ball where x > 1"));
}

TEST(ParseChangeFilter, SaysWhatIsWrong) {
  EXPECT_NE(why_not("added Ball Box").find("do not know what to do with \"Box\""),
            std::string::npos);
  EXPECT_NE(why_not("Ball in").find("nothing behind \"in\""), std::string::npos);
  EXPECT_FALSE(why_not("Ball where x >").empty());
}

} // namespace

} // namespace castor
