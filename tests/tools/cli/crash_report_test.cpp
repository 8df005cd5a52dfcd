#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CASTOR_SKIP_UNDER_SANITIZERS GTEST_SKIP() << "sanitizers report crashes themselves"
#else
#define CASTOR_SKIP_UNDER_SANITIZERS static_cast<void>(0)
#endif

/// Systems of which one component ends the process.
class CrashReport : public Castor {
protected:
  void SetUp() override {
    Castor::SetUp();
    CASTOR_SKIP_UNDER_SANITIZERS;
  }

  Answer crash(const std::string& options) const {
    return ask({"run", "--for", "30s", system("CPP MG wild Crasher " + options + "\n")});
  }

  static constexpr const char* who = "in component a.wild (class Crasher, ";
};

TEST_F(CrashReport, NamesTheComponentTheLineAndTheRemedy) {
  auto x = crash("--place run");
  EXPECT_EQ(x.status, 128 + SIGSEGV);
  EXPECT_THAT(x.errors,
              AllOf(HasSubstr("castor: segmentation fault (SIGSEGV), null pointer (address 0x0), "),
                    HasSubstr(who), HasSubstr("system.cast:5), in run()\n"),
                    HasSubstr("--isolate")));
}

TEST_F(CrashReport, SaysInWhichPhaseOfLife) {
  for (std::string place : {"configure", "start"}) {
    auto x = crash("--place " + place);
    EXPECT_EQ(x.status, 128 + SIGSEGV);
    EXPECT_THAT(x.errors, AllOf(HasSubstr(who), HasSubstr("), in " + place + "()\n")));
  }
}

TEST_F(CrashReport, NamesTheEventOfTheCallback) {
  auto x = crash("--place callback");
  EXPECT_EQ(x.status, 128 + SIGSEGV);
  EXPECT_THAT(x.errors, AllOf(HasSubstr(who),
                              HasSubstr("), in the callback for ADD Tick a/tick v0 by wild\n")));
}

TEST_F(CrashReport, TellsAnAddressThatIsNotNull) {
  auto x = crash("--how dangling");
  EXPECT_EQ(x.status, 128 + SIGSEGV);
  EXPECT_THAT(x.errors, AllOf(HasSubstr("address 0x123456789000"), HasSubstr(who)));
}

TEST_F(CrashReport, KnowsAnOverflowOfTheStack) {
  for (std::string place : {"run", "callback", "configure"}) {
    auto x = crash("--how overflow --place " + place);
    EXPECT_EQ(x.status, 128 + SIGSEGV);
    EXPECT_THAT(x.errors,
                AllOf(HasSubstr("segmentation fault (SIGSEGV), stack overflow, "), HasSubstr(who)));
  }
}

TEST_F(CrashReport, TellsOtherSignals) {
  auto divided = crash("--how divide");
  EXPECT_EQ(divided.status, 128 + SIGFPE);
  EXPECT_THAT(divided.errors, AllOf(HasSubstr("division by zero"), HasSubstr(who)));
  auto aborted = crash("--how abort");
  EXPECT_EQ(aborted.status, 128 + SIGABRT);
  EXPECT_THAT(aborted.errors,
              AllOf(HasSubstr("abort (SIGABRT) in component a.wild"), Not(HasSubstr("uncaught"))));
}

TEST_F(CrashReport, ShowsTheExceptionThatNobodyCaught) {
  auto x = crash("--how terminate");
  EXPECT_EQ(x.status, 128 + SIGABRT);
  EXPECT_THAT(x.errors, AllOf(HasSubstr("abort (SIGABRT), uncaught exception std::runtime_error: "
                                        "nobody catches this, in component a.wild"),
                              Not(HasSubstr("terminate called"))));
}

TEST_F(CrashReport, DoesNotBlameAComponentForAnotherThread) {
  for (auto [how, signal] : {std::pair{"null", SIGSEGV}, std::pair{"terminate", SIGABRT}}) {
    auto x = crash(std::string{"--place thread --how "} + how);
    EXPECT_EQ(x.status, 128 + signal);
    EXPECT_THAT(x.errors, AllOf(HasSubstr("which is not that of a component"),
                                Not(HasSubstr("a.wild")), Not(HasSubstr("--isolate"))));
  }
}

TEST_F(CrashReport, SaysWhoHasSentTheSignal) {
  Process castor{command({"run", system("CPP UM calm Talker\n")})};
  ASSERT_TRUE(castor.wait_for_output("runs"));
  castor.send_signal(SIGSEGV);
  EXPECT_EQ(castor.wait(), 128 + SIGSEGV);
  EXPECT_THAT(castor.errors(), AllOf(HasSubstr("segmentation fault (SIGSEGV), sent by process " +
                                               std::to_string(getpid())),
                                     Not(HasSubstr("--isolate"))));
}

TEST_F(CrashReport, IsolatedComponentsAreNamedToo) {
  auto x = ask({"run", "--for", "30s", "--until-quiet", "1s",
                system("CPP MG wild Crasher --isolate --restart temporary\n")});
  EXPECT_EQ(x.status, 1);
  EXPECT_THAT(x.errors,
              AllOf(HasSubstr("segmentation fault (SIGSEGV), null pointer"), HasSubstr(who),
                    HasSubstr("), in run()\n"), Not(HasSubstr("With --isolate")),
                    HasSubstr("the process of wild was killed by signal 11")));
}

TEST_F(CrashReport, NodesReportToo) {
  Process castor{command({"run", "--local-nodes",
                          write("nodes.cast", "HOST localhost\nSUBARCHITECTURE a\n"
                                              "CPP WM SubarchitectureWorkingMemory\n"
                                              "CPP TM AlwaysPositiveTaskManager\n"
                                              "arm CPP MG wild Crasher\n")})};
  EXPECT_TRUE(castor.wait_for_output("the process of arm was killed by signal 11"));
  EXPECT_THAT(castor.errors(), AllOf(HasSubstr(who), HasSubstr("nodes.cast:5), in run()")));
}

} // namespace

} // namespace castor::test
