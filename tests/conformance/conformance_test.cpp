#include "castor/tests/support/process.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using Path = std::filesystem::path;

const Path folder = CASTOR_CONFORMANCE_FILES;

std::vector<Path> systems_in(const Path& where) {
  std::vector<Path> result;
  for (auto& x : std::filesystem::directory_iterator{where})
    if (x.path().extension() == ".cast")
      result.push_back(x.path());
  std::sort(result.begin(), result.end());
  return result;
}

/// "lock-and-overwrite" as a test's name: "LockAndOverwrite".
std::string test_name(const testing::TestParamInfo<Path>& info) {
  std::string result;
  bool upper = true;
  for (unsigned char c : info.param.stem().string()) {
    if (std::isalnum(c))
      result += static_cast<char>(upper ? std::toupper(c) : c);
    upper = !std::isalnum(c);
  }
  return result;
}

std::vector<std::string> run(const Path& file, const std::vector<std::string>& flags = {}) {
  // Files of the original take options from there.
  setenv("TEST_LOG_OUTPUT", "true", 1);
  std::vector<std::string> result{
    CASTOR_EXECUTABLE, "--plugin",     CASTOR_CONFORMANCE_PLUGIN, "run",
    file.string(),     "--no-restarts"};
  result.insert(result.end(), flags.begin(), flags.end());
  return result;
}

class Conformance : public testing::TestWithParam<Path> {};

TEST_P(Conformance, Passes) {
  Process castor{run(GetParam())};
  EXPECT_EQ(castor.wait(), 29) << castor.errors();
}

TEST_P(Conformance, PassesOverThreeNodes) {
  Process castor{run(GetParam(), {"--spread", "3"})};
  EXPECT_EQ(castor.wait(), 29) << castor.errors();
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::ValuesIn(systems_in(folder)), test_name);

/// Tests that cannot fail would say nothing.
class ConformanceFailing : public testing::TestWithParam<Path> {};

TEST_P(ConformanceFailing, Fails) {
  Process castor{run(GetParam())};
  EXPECT_EQ(castor.wait(), 30) << castor.errors();
}

INSTANTIATE_TEST_SUITE_P(Files, ConformanceFailing,
                         testing::ValuesIn(systems_in(folder / "failing")), test_name);

TEST(ConformanceTester, NamesTheTestsThatThereAre) {
  Process castor{run(folder / "misconfigured/unknown-test.cast")};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("there is no test single-wirte; the tests are: copy, count-10"),
            std::string::npos)
    << castor.errors();
}

TEST(ConformanceTester, SaysWhatItWaitedFor) {
  Process castor{run(folder / "failing/nobody-deletes.cast")};
  castor.wait();
  EXPECT_NE(castor.errors().find("after 500ms it still waits for events of its own additions"),
            std::string::npos)
    << castor.errors();
}

TEST(ConformanceTester, OpenAccessNeedsNoAccessLine) {
  auto command = run(folder / "failing/no-access.cast");
  command.emplace_back("--open-access");
  Process castor{command};
  EXPECT_EQ(castor.wait(), 29) << castor.errors();
}

TEST(ConformanceTester, TheReaderSaysOnceASecondThatAllIsWell) {
  auto command = run(folder / "endless/local-write.cast");
  command.insert(command.end(), {"--for", "10s"});
  Process castor{command};
  EXPECT_TRUE(castor.wait_for_output("[test.reader] fine"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

} // namespace

} // namespace castor::test
