#include "castor/actors/cast/access_rule_parser.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using test::is_clean;
using test::parse;
using test::reports;

const std::string systems = "HOST h\n"
                            "SUBARCHITECTURE vision\nCPP WM W\nCPP TM T\n"
                            "SUBARCHITECTURE binding\nCPP WM W\nCPP TM T\n"
                            "SUBARCHITECTURE speech\nCPP WM W\nCPP TM T\n";

TEST(AccessRuleParser, LetOthersWrite) {
  auto result = parse(systems + "ACCESS vision WRITES binding # proxies\n");
  ASSERT_TRUE(is_clean(result));
  const auto& architecture = *result.architecture;
  ASSERT_EQ(architecture.access_rules.size(), 1U);
  EXPECT_EQ(architecture.access_rules[0].where.line(), 11U);
  EXPECT_TRUE(architecture.may_write("vision", "binding"));
  EXPECT_FALSE(architecture.may_write("binding", "vision"));
  EXPECT_FALSE(architecture.may_write("speech", "binding"));
  EXPECT_TRUE(architecture.may_write("speech", "speech"));
}

TEST(AccessRuleParser, MayNameAll) {
  auto result = parse(systems + "ACCESS * WRITES binding\nACCESS speech WRITES *\n");
  ASSERT_TRUE(is_clean(result));
  EXPECT_TRUE(result.architecture->may_write("vision", "binding"));
  EXPECT_TRUE(result.architecture->may_write("speech", "vision"));
  EXPECT_FALSE(result.architecture->may_write("vision", "speech"));
  EXPECT_TRUE(is_clean(parse(systems + "ACCESS * WRITES *\n")));
}

TEST(AccessRuleParser, MayStandBeforeTheSubarchitectures) {
  EXPECT_TRUE(is_clean(parse("ACCESS vision WRITES binding\n" + systems)));
}

TEST(AccessRuleParser, NeedKnownNames) {
  auto result = parse(systems + "ACCESS visoin WRITES nowhere\n");
  EXPECT_TRUE(
    reports(result, Severity::error, 11, "no subarchitecture 'visoin'", "did you mean 'vision'?"));
  EXPECT_TRUE(reports(result, Severity::error, 11, "no subarchitecture 'nowhere'", "or * for all"));
}

TEST(AccessRuleParser, MustBeWellFormed) {
  for (std::string line : {"ACCESS", "ACCESS vision", "ACCESS vision WRITES", "ACCESS # x",
                           "ACCESS vision reads binding", "ACCESS vision WRITES #binding"})
    EXPECT_TRUE(reports(parse(systems + line), Severity::error, 11, "no access rule",
                        "write ACCESS writer WRITES owner or ACCESS reader READS owner"))
      << line;
  EXPECT_TRUE(reports(parse(systems + "ACCESS vision WRITES binding speech"), Severity::warning, 11,
                      "'speech' is ignored"));
}

TEST(AccessRuleParser, WithoutEffectGetAWarning) {
  EXPECT_TRUE(reports(parse(systems + "ACCESS vision WRITES vision"), Severity::warning, 11,
                      "its own working memory in any case"));
  auto repeated = parse(systems + "ACCESS vision WRITES binding\nACCESS vision WRITES binding");
  EXPECT_TRUE(reports(repeated, Severity::warning, 12, "stands at main.cast:11 already"));
}

TEST(AccessRuleParser, LetOnlySomeRead) {
  auto result = parse(systems + "ACCESS vision READS binding\n");
  ASSERT_TRUE(is_clean(result));
  const auto& architecture = *result.architecture;
  EXPECT_TRUE(architecture.may_read("vision", "binding"));
  EXPECT_TRUE(architecture.may_read("binding", "binding"));
  EXPECT_FALSE(architecture.may_read("speech", "binding"));
  EXPECT_TRUE(architecture.may_read("speech", "vision")) << "no rule names vision";
  EXPECT_FALSE(architecture.readers("vision"));
  auto none = parse(systems + "ACCESS binding READS binding\n");
  ASSERT_TRUE(is_clean(none));
  EXPECT_FALSE(none.architecture->may_read("vision", "binding"));
  auto all = parse(systems + "ACCESS binding READS binding\nACCESS vision READS *\n");
  ASSERT_TRUE(is_clean(all));
  EXPECT_TRUE(all.architecture->may_read("vision", "binding"));
  EXPECT_FALSE(all.architecture->may_read("speech", "binding"));
  EXPECT_TRUE(all.architecture->may_read("speech", "vision")) << "* restricts nobody";
}

TEST(AccessRuleParser, CheckRulesForReading) {
  EXPECT_TRUE(reports(parse(systems + "ACCESS visoin READS binding\n"), Severity::error, 11,
                      "no subarchitecture 'visoin'", "did you mean 'vision'?"));
  EXPECT_TRUE(reports(parse(systems + "ACCESS operator READS binding\n"), Severity::error, 11,
                      "operators may read everywhere", "remove the line"));
  EXPECT_TRUE(reports(parse(systems + "ACCESS vision READS *\n"), Severity::warning, 11,
                      "everybody may read everywhere in any case"));
  EXPECT_TRUE(reports(parse(systems + "ACCESS vision READS binding\nACCESS vision READS binding\n"),
                      Severity::warning, 12, "stands at main.cast:11 already"));
  EXPECT_TRUE(
    reports(parse(systems + "ACCESS speech WRITES binding\nACCESS vision READS binding\n"),
            Severity::warning, 11, "but not read there", "add ACCESS speech READS binding"));
}

TEST(AccessRuleParser, LetOperatorsWriteEverywhereUnlessTheySayOtherwise) {
  auto may = [](const std::string& rules, const char* owner) {
    auto result = parse(systems + rules);
    EXPECT_TRUE(is_clean(result)) << rules;
    return result.architecture->may_write("operator", owner);
  };
  EXPECT_TRUE(may("", "vision"));
  EXPECT_TRUE(may("ACCESS * WRITES binding\n", "vision"));
  EXPECT_FALSE(may("", "castor"));
  EXPECT_FALSE(may("ACCESS operator WRITES nothing\n", "vision"));
  EXPECT_FALSE(may("ACCESS * WRITES *\nACCESS operator WRITES nothing\n", "vision"));
  EXPECT_TRUE(may("ACCESS operator WRITES vision\n", "vision"));
  EXPECT_FALSE(may("ACCESS operator WRITES vision\n", "binding"));
  EXPECT_TRUE(may("ACCESS operator WRITES *\n", "binding"));
}

TEST(AccessRuleParser, OfOperatorsAreCheckedToo) {
  EXPECT_TRUE(reports(parse(systems + "ACCESS operater WRITES vision\n"), Severity::error, 11,
                      "no subarchitecture 'operater'", "did you mean 'operator'?"));
  EXPECT_TRUE(reports(parse(systems + "ACCESS operator WRITES notihng\n"), Severity::error, 11,
                      "no subarchitecture 'notihng'", "did you mean 'nothing'?"));
  EXPECT_TRUE(reports(parse(systems + "ACCESS vision WRITES nothing\n"), Severity::error, 11,
                      "no subarchitecture 'nothing'"));
  EXPECT_TRUE(
    reports(parse(systems + "ACCESS operator WRITES nothing\nACCESS operator WRITES vision\n"),
            Severity::error, 11, "another line lets them write", "remove one"));
  EXPECT_TRUE(reports(parse("SUBARCHITECTURE operator\nCPP WM W\nCPP TM T\n"), Severity::error, 1,
                      "is a keyword of ACCESS lines"));
}

TEST(AccessRuleParser, DoNotHideHostsOfThatName) {
  auto result = parse("HOST h\nSUBARCHITECTURE s\nCPP WM W\nCPP TM T\nACCESS CPP MG a A\n"
                      "ACCESSORY CPP MG b B\n");
  ASSERT_TRUE(is_clean(result));
  EXPECT_EQ(result.architecture->component("a")->host, "ACCESS");
  EXPECT_EQ(result.architecture->component("b")->host, "ACCESSORY");
}

} // namespace

} // namespace castor::cast
