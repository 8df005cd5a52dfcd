#include "castor/actors/cast/hosts.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using test::is_clean;
using test::parse;
using test::reports;
using test::values;

std::string component_host(const std::string& text) {
  auto result = parse(text + "\nCOMPONENT CPP a A");
  return result.ok() ? result.architecture->standalone.at(0).host : render(result.diagnostics);
}

TEST(HostTable, ReplacesNamesInBracketsOnly) {
  HostTable hosts;
  hosts.define("Main", "10.0.0.1");
  EXPECT_EQ(hosts.resolve("[Main]").host, "10.0.0.1");
  EXPECT_EQ(hosts.resolve("Main").host, "Main");
  EXPECT_EQ(hosts.resolve("[Main").host, "[Main");
  EXPECT_EQ(hosts.resolve("[]").host, "[]");
}

TEST(HostTable, MapsLocalhost) {
  HostTable hosts;
  EXPECT_EQ(hosts.resolve("127.0.0.1").host, "localhost");
  hosts.define("localhost", "10.0.0.9");
  EXPECT_EQ(hosts.resolve("localhost").host, "10.0.0.9");
  EXPECT_EQ(hosts.resolve("127.0.0.1").host, "10.0.0.9");
  EXPECT_EQ(hosts.resolve("[localhost]").host, "10.0.0.9");
}

TEST(HostTable, TurnsUndefinedNamesIntoLocalhost) {
  HostTable hosts;
  hosts.define("localhost", "10.0.0.9");
  auto resolved = hosts.use("[Main]");
  EXPECT_FALSE(resolved.defined);
  EXPECT_EQ(resolved.host, "10.0.0.9");
  EXPECT_EQ(hosts.define("Main", "x"), HostTable::Outcome::used_before);
  EXPECT_EQ(hosts.resolve("[Main]").host, "10.0.0.9");
}

TEST(HostTable, ListsExplicitDefinitions) {
  HostTable hosts;
  hosts.define("A", "x");
  hosts.use("[B]");
  EXPECT_EQ(hosts.definitions(), (std::map<std::string, std::string>{{"A", "x"}}));
  EXPECT_EQ(hosts.names(10), std::vector<std::string_view>{"A"});
}

TEST(HostNames, StandForHosts) {
  EXPECT_EQ(component_host("HOSTNAME Main 10.0.0.1\nHOST [Main]"), "10.0.0.1");
  EXPECT_EQ(values("HOSTNAME Main 10.0.0.1\n#EXPAND %(host:Main)").at(0), "10.0.0.1");
}

TEST(HostNames, KeepTheirFirstDefinition) {
  auto text = "HOSTNAME Main 10.0.0.1\nHOSTNAME Main 10.0.0.2\nHOST [Main]\nCOMPONENT CPP a A";
  auto result = parse(text);
  EXPECT_TRUE(is_clean(result));
  EXPECT_EQ(result.architecture->standalone.at(0).host, "10.0.0.1");
  EXPECT_EQ(result.architecture->host_names.at("Main"), "10.0.0.1");
}

TEST(HostNames, MayReferToOthersAndToVariables) {
  EXPECT_EQ(component_host("HOSTNAME A 10.0.0.1\nHOSTNAME B [A]\nHOST [B]"), "10.0.0.1");
  EXPECT_EQ(component_host("SETVAR n=7\nHOSTNAME A 10.0.0.%(n)\nHOST [A]"), "10.0.0.7");
}

TEST(HostNames, MapLocalhostToAnAddress) {
  EXPECT_EQ(component_host("HOSTNAME localhost 10.0.0.9\nHOST localhost"), "10.0.0.9");
  EXPECT_EQ(component_host("HOSTNAME localhost 10.0.0.9\nHOST 127.0.0.1"), "10.0.0.9");
  EXPECT_EQ(component_host("HOSTNAME localhost 10.0.0.9\nHOSTNAME A localhost\nHOST [A]"),
            "10.0.0.9");
  EXPECT_EQ(component_host("HOSTNAME localhost localhost\nHOST localhost"), "localhost");
}

TEST(HostNames, ThatAreUndefinedMeanLocalhost) {
  auto result = parse("HOSTNAME Main 10.0.0.1\nHOST [Mian]\nCOMPONENT CPP a A");
  EXPECT_TRUE(reports(result, Severity::warning, 2, "host 'Mian' is not defined; localhost is used",
                      "did you mean 'Main'?"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->standalone.at(0).host, "localhost");
}

TEST(HostNames, ThatAreUndefinedAreReportedOnce) {
  auto result = parse("HOST [Other]\nCOMPONENT CPP a A\nCOMPONENT [Other] CPP b B");
  EXPECT_EQ(test::count(result, Severity::warning), 1U);
  EXPECT_TRUE(reports(result, Severity::warning, 1, "'Other'", "HOSTNAME Other address"));
}

TEST(HostNames, AreReplacedWhereverAHostIsAccepted) {
  auto result = parse("HOSTNAME A 10.0.0.1\nHOSTNAME B 10.0.0.2\nHOSTNAME C 10.0.0.3\n"
                      "SUBARCHITECTURE sa [A]\n[B] CPP WM W\nCPP TM T\nCOMPONENT [C] CPP x X");
  ASSERT_TRUE(is_clean(result));
  const auto& sa = result.architecture->subarchitectures.at(0);
  EXPECT_EQ(sa.host, "10.0.0.1");
  EXPECT_EQ(sa.working_memory.host, "10.0.0.2");
  EXPECT_EQ(sa.task_manager.host, "10.0.0.1");
  EXPECT_EQ(result.architecture->standalone.at(0).host, "10.0.0.3");
}

TEST(HostNames, MustBeWellFormed) {
  for (auto line : {"HOSTNAME", "HOSTNAME A", "HOSTNAME 1 x", "HOSTNAME A b c", "HOSTNAMES A x"})
    EXPECT_TRUE(reports(parse(line), Severity::error, 1, "no definition of a host",
                        "write HOSTNAME Name address"))
      << line;
  EXPECT_TRUE(reports(parse("HOSTNAME A x # comment"), Severity::error, 1, "no definition",
                      "comment on a line of its own"));
  EXPECT_TRUE(reports(parse("HOSTNAME A x#y"), Severity::error, 1, "no definition"));
}

TEST(HostNames, MustBeOneWordAfterExpansion) {
  EXPECT_TRUE(reports(parse("SETVAR v=a b\nHOSTNAME A %(v)"), Severity::error, 2,
                      "'a b' is not the address of a host"));
  EXPECT_TRUE(reports(parse("SETVAR v=\nHOSTNAME A %(v)"), Severity::error, 2, "'' is not"));
}

TEST(HostNames, KnowNoEnvironmentVariables) {
  EXPECT_TRUE(reports(parse("HOSTNAME A $ROBOT", {{}, {{"ROBOT", "x"}}}), Severity::error, 1,
                      "environment variables are not replaced", "write the address, or $ROBOT"));
}

TEST(HostNames, MustComeBeforeTheFirstSection) {
  for (std::string section :
       {"HOST x", "SUBARCHITECTURE s x", "COMPONENT x CPP a A", "CONNECTION", "ARCHITECTURE"})
    EXPECT_TRUE(reports(parse(section + "\nHOSTNAME A x"), Severity::error, 2,
                        "too late, behind main.cast:1", "above the first section"))
      << section;
  auto repeated = parse("HOSTNAME A x\nHOST [A]\nHOSTNAME A y\nCOMPONENT CPP a A");
  EXPECT_TRUE(reports(repeated, Severity::warning, 3, "too late"));
  EXPECT_TRUE(repeated.ok()) << "a second definition would have had no effect anyway";
}

TEST(HostNames, AreNotReadInDisabledBlocks) {
  EXPECT_EQ(component_host("IFTRUE(no)\nHOSTNAME A x\nENDIF\nHOSTNAME A y\nHOST [A]"), "y");
}

TEST(HostNames, ThatWereUsedBeforeTheirDefinitionStayLocalhost) {
  auto result = parse("HOSTNAME A [B]\nHOSTNAME B 10.0.0.1\nHOST [B]\nCOMPONENT CPP a A");
  EXPECT_TRUE(reports(result, Severity::warning, 1, "'B' is not defined"));
  EXPECT_TRUE(reports(result, Severity::warning, 2, "no effect: 'B' was used above", "move"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->standalone.at(0).host, "localhost");
  auto localhost = parse("HOSTNAME A localhost\nHOSTNAME localhost 10.0.0.1\nHOST [A]");
  EXPECT_TRUE(reports(localhost, Severity::warning, 2, "no effect: 'localhost' was used above"));
  auto variable = parse("SETVAR x=%(host:B)\nHOSTNAME B 10.0.0.1");
  EXPECT_TRUE(reports(variable, Severity::warning, 1, "host 'B' is not defined"));
  EXPECT_TRUE(reports(variable, Severity::warning, 2, "no effect: 'B'"));
}

TEST(Localhost, NeedsNoAddress) {
  EXPECT_TRUE(is_clean(parse("HOST localhost\nCOMPONENT CPP a A\nCOMPONENT 10.0.0.2 CPP b B")));
}

} // namespace

} // namespace castor::cast
