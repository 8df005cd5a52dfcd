#include "castor/actors/cast/option_flags.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::cast {

namespace {

using test::values;
using Values = std::vector<std::string>;

TEST(OptionFlags, AreUnsetByAnOddNumberOfMarks) {
  auto flags = parse_flags(" a !b\t!!c !!!d ! !! e!");
  ASSERT_EQ(flags.size(), 5U);
  EXPECT_TRUE(flags[0].set);
  EXPECT_FALSE(flags[1].set);
  EXPECT_TRUE(flags[2].set);
  EXPECT_FALSE(flags[3].set);
  EXPECT_EQ(flags[4].name, "e!");
}

TEST(OptionFlags, AreReplacedInTheirPlace) {
  EXPECT_EQ(merge_flags("a b c", "!c d", Merge::replace), "a b !c d ");
  EXPECT_EQ(merge_flags("a !b a", "!a b", Merge::replace), "!a b !a ");
}

TEST(OptionFlags, AreOnlyAddedByDefaults) {
  EXPECT_EQ(merge_flags("a b !c d ", "!a !b !c !d !e", Merge::keep), "a b !c d !e ");
}

TEST(OptionFlags, EndWithABlankOnceTheyAreMerged) {
  EXPECT_EQ(merge_flags("", "", Merge::replace), "");
  EXPECT_EQ(merge_flags("a", "", Merge::replace), "a ");
  EXPECT_EQ(merge_flags("", "a", Merge::keep), "a ");
  EXPECT_EQ(merge_flags(" a  b ", "!", Merge::replace), "a b ");
}

TEST(OptionFlags, TakeTheLastOfRepeatedChanges) {
  EXPECT_EQ(merge_flags("a", "!a a !a", Merge::replace), "!a ");
}

TEST(OptionFlags, MatchIfAnyOrAllHaveTheirState) {
  EXPECT_TRUE(matches_any_flag("a b c", "x a"));
  EXPECT_FALSE(matches_any_flag("a b c", "x y"));
  EXPECT_TRUE(matches_all_flags("a b c", "c a"));
  EXPECT_FALSE(matches_all_flags("a b c", "a x"));
}

TEST(OptionFlags, ThatAreAbsentAreUnset) {
  EXPECT_TRUE(matches_all_flags("a", "a !b"));
  EXPECT_TRUE(matches_all_flags("a !b", "!b"));
  EXPECT_FALSE(matches_any_flag("a !b", "b !a"));
  EXPECT_TRUE(matches_any_flag("", "!a"));
}

TEST(OptionFlags, OfAnEmptyListMatchAllButNotAny) {
  EXPECT_TRUE(matches_all_flags("a", ""));
  EXPECT_FALSE(matches_any_flag("a", ""));
  EXPECT_FALSE(matches_any_flag("a", "!"));
}

TEST(OptionFlags, ThatOccurTwiceCountFirst) {
  EXPECT_TRUE(matches_all_flags("a !a", "a"));
  EXPECT_FALSE(matches_all_flags("!a a", "a"));
}

TEST(OptionCommands, MergeIntoVariables) {
  EXPECT_EQ(values("SETVAR o=a b c\nSETOPT o=!c d\n#EXPAND <%(o)>\n"
                   "OPTDEFAULT o=!a !b !c !d !e\n#EXPAND <%(o)>"),
            (Values{"<a b !c d >", "<a b !c d !e >"}));
}

TEST(OptionCommands, AssignUndefinedVariables) {
  EXPECT_EQ(values("SETOPT o=a  b\n#EXPAND <%(o)>"), Values{"<a  b>"});
  EXPECT_EQ(values("OPTDEFAULT o=!a\n#EXPAND <%(o)>"), Values{"<!a>"});
}

TEST(OptionCommands, ExpandTheirFlags) {
  EXPECT_EQ(values("SETVAR f=b c\nSETVAR o=a\nSETOPT o=%(f) d\n#EXPAND <%(o)>"),
            Values{"<a b c d >"});
}

} // namespace

} // namespace castor::cast
