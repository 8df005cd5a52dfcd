#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace castor::cast {

namespace {

/// All that could be understood.
std::set<std::string> names_in(const ParseResult& x) {
  std::set<std::string> result;
  for_each_component(x.understood.architecture,
                     [&](const ComponentDescription& y) { result.insert(y.name); });
  return result;
}

TEST(FilesWithErrors, LeaveTheLinesThatWereUnderstood) {
  auto result = test::parse(test::system_with("CPP UM first A\nCPP UMM second B\nCPP UM third C\n"
                                              "COMPONENT CPP fourth D\n"));
  EXPECT_FALSE(result.ok());
  auto names = names_in(result);
  for (auto* x : {"first", "third", "fourth"})
    EXPECT_EQ(names.count(x), 1U) << x;
  EXPECT_EQ(names.count("second"), 0U);
  EXPECT_EQ(result.understood.doubtful.count("second"), 1U);
  EXPECT_FALSE(result.understood.is_incomplete);
}

TEST(FilesWithErrors, LeaveLinesOfSectionsThatAreOutOfPlaceOrTwice) {
  auto result = test::parse("CPP UM outside A\n" + test::system_with("CPP UM first A\n") +
                            "SUBARCHITECTURE sa\nCPP UM twice A\n");
  EXPECT_FALSE(result.ok());
  auto names = names_in(result);
  for (auto* x : {"outside", "first", "twice"})
    EXPECT_EQ(names.count(x), 1U) << x;
}

TEST(FilesWithErrors, SayThatLinesAreMissing) {
  EXPECT_TRUE(test::parse("INCLUDE nowhere.cast\n").understood.is_incomplete);
}

TEST(Findings, AreSortedByTheLinesThatTheyAreAbout) {
  auto result = test::parse("INCLUDE part.cast\n" + test::system_with("CPP UM x A\n"),
                            {{{"part.cast", "VARDEFALT a=1\n"}}, {}});
  auto findings = result.diagnostics;
  for_each_component(result.understood.architecture, [&](const ComponentDescription& x) {
    if (x.name == "x")
      findings.insert(findings.begin(), {Severity::error, x.where, x.line, {}, "late", {}});
  });
  ASSERT_EQ(findings.size(), 2U);
  sort_by_line(findings);
  EXPECT_EQ(findings.back().message, "late");
  EXPECT_EQ(findings.front().where.file(), "part.cast");
}

} // namespace

} // namespace castor::cast
