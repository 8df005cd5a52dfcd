#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Systems with components that cannot be configured.
class WrongConfiguration : public Castor {
protected:
  static std::size_t times(const std::string& what, const std::string& text) {
    std::size_t result = 0;
    for (auto i = text.find(what); i != text.npos; i = text.find(what, i + 1))
      ++result;
    return result;
  }
};

TEST_F(WrongConfiguration, IsReportedOnceAndNothingIsStarted) {
  auto file = system("CPP UM good Talker\nCPP UM bad Misconfigured\n");
  auto x = ask({"run", file});
  EXPECT_EQ(x.status, 2);
  EXPECT_THAT(x.output, IsEmpty());
  EXPECT_THAT(x.errors, AllOf(HasSubstr(file + ":6: error: bad cannot be configured: there is no "
                                               "such thing\n"),
                              HasSubstr("CPP UM bad Misconfigured"), Not(HasSubstr("is started")),
                              Not(HasSubstr("is stopped"))));
  EXPECT_EQ(times("there is no such thing", x.errors), 1u);
}

TEST_F(WrongConfiguration, OfSeveralComponentsIsReportedAtOnce) {
  auto x = ask({"run", system("CPP UM b1 Misconfigured --message first\n"
                              "CPP UM b2 Misconfigured --message second --restart temporary\n")});
  EXPECT_EQ(x.status, 2);
  EXPECT_EQ(times("first\n", x.errors), 2u) << x.errors; // the message and the line
  EXPECT_THAT(x.errors, AllOf(HasSubstr(":5: error: b1 cannot be configured: first"),
                              HasSubstr(":6: error: b2 cannot be configured: second")));
}

TEST_F(WrongConfiguration, OfIsolatedComponentsAndOfThoseOnNodesIsTheSame) {
  for (std::string line :
       {"CPP UM bad Misconfigured --isolate\n", "arm CPP UM bad Misconfigured\n"}) {
    auto x = ask({"run", "--local-nodes", system("CPP UM good Talker\n" + line)});
    EXPECT_EQ(x.status, 2) << line;
    EXPECT_THAT(x.output, IsEmpty());
    EXPECT_THAT(x.errors, AllOf(HasSubstr(":6: error: bad cannot be configured: there is no such "
                                          "thing\n"),
                                Not(HasSubstr("is started"))));
    EXPECT_EQ(times("there is no such thing", x.errors), 1u) << x.errors;
  }
}

TEST_F(WrongConfiguration, RefusesAnAdditionAndLeavesTheSystemAsItWas) {
  Process castor{command({"run", system("CPP UM good Talker\n")})};
  ASSERT_TRUE(castor.wait_for_output("runs"));
  auto added = write("more.cast", "SUBARCHITECTURE a\nCPP UM more Talker\n"
                                  "CPP UM bad Misconfigured\n");
  auto x = ask({"add", added});
  EXPECT_EQ(x.status, 2);
  EXPECT_THAT(x.errors, HasSubstr(added + ":3: error: bad cannot be configured: there is no such "
                                          "thing\n"));
  auto listed = ask({"ps", "--json"});
  EXPECT_THAT(listed.output,
              AllOf(HasSubstr("good"), Not(HasSubstr("more")), Not(HasSubstr("bad"))));
  // The names are free again.
  auto again = ask({"add", write("again.cast", "SUBARCHITECTURE a\nCPP UM more Talker\n"
                                               "CPP UM bad Talker\n")});
  EXPECT_EQ(again.status, 0) << again.errors;
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_THAT(castor.errors(), Not(HasSubstr("there is no such thing")));
}

} // namespace

} // namespace castor::test
