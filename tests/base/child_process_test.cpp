#include "castor/base/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace castor::test {

namespace {

/// A shell that does this.
ChildProgram shell(const std::string& script) {
  return {"/bin/sh", {"sh", "-c", script}};
}

/// What a program prints.
std::string output_of(ChildProgram program) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  program.descriptors.emplace_back(ends[1], STDOUT_FILENO);
  ChildProcess child{std::move(program)};
  close(ends[1]);
  std::string result;
  for (char c = 0; read(ends[0], &c, 1) == 1;)
    result += c;
  close(ends[0]);
  return result;
}

} // namespace

TEST(ChildProcess, TellsWhatTheProgramReturned) {
  ChildProcess child{shell("exit 3")};
  EXPECT_EQ(child.wait(), 3);
  EXPECT_TRUE(child.has_ended());
  EXPECT_EQ(child.status(), 3);
}

TEST(ChildProcess, TellsTheSignalThatEndedIt) {
  ChildProcess child{shell("kill -TERM $$")};
  EXPECT_EQ(child.wait(), 128 + SIGTERM);
}

TEST(ChildProcess, IsGivenDescriptorsAndAnEnvironment) {
  setenv("CASTOR_TEST_SETTING", "old", 1);
  setenv("CASTOR_TEST_KEPT", "kept", 1);
  auto program = shell("printf %s \"$CASTOR_TEST_SETTING $CASTOR_TEST_KEPT\"");
  program.environment = {"CASTOR_TEST_SETTING=new"};
  EXPECT_EQ(output_of(program), "new kept");
}

TEST(ChildProcess, EndsWithItsObject) {
  pid_t id = -1;
  {
    ChildProcess child{shell("exec sleep 1000")};
    id = child.id();
    EXPECT_EQ(getpgid(id), id);
    EXPECT_FALSE(child.has_ended());
  }
  EXPECT_EQ(kill(id, 0), -1);
}

TEST(ChildProcess, IsInTheGroupOfThisProcessIfWanted) {
  auto program = shell("exec sleep 1000");
  program.has_own_group = false;
  ChildProcess child{program};
  EXPECT_EQ(getpgid(child.id()), getpgid(0));
}

TEST(ChildProcess, AProgramThatIsNotThereIsAnError) {
  EXPECT_THROW(ChildProcess({"/no/such/program", {"program"}}), std::system_error);
}

} // namespace castor::test
