#include <castor/tools/testing/test_system.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

using castor::TestSystem;

std::string hall(const std::string& working_memory_options = {}) {
  return "SUBARCHITECTURE hall\n"
         "CPP WM SubarchitectureWorkingMemory " +
         working_memory_options +
         "\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP MG counter Counter\n"
         "CPP UM door Door\n";
}

TEST(Guests, AreCountedEvenIfTheCounterCrashes) {
  TestSystem system{hall()};
  system.inject("crash counter");
  system.expect_back("counter");
  system.expect_nobody_else_down({"counter"});
  system.expect_entry("Count in hall where guests == 10");
}

TEST(Guests, AreCountedEvenIfACallbackThrows) {
  TestSystem system{hall()};
  system.inject("throw in callback 2 of counter");
  auto down = system.expect_down("counter");
  EXPECT_TRUE(down.will_restart) << down.reason;
  auto up = system.expect_back("counter");
  EXPECT_LT(up.down_us, 5'000'000);
  system.expect_entry("Count in hall where guests == 10");
}

TEST(Guests, OutliveTheirWorkingMemory) {
  auto journals = std::filesystem::path{testing::TempDir()} / "guests";
  std::filesystem::remove_all(journals);
  TestSystem system{hall("--journal full --journal-dir " + journals.string())};
  system.expect_entry("Guest where number == 3");
  system.inject("fail journal of hall");
  system.expect_back("hall_wm");
  system.expect_entry("Guest where number == 3");
  system.expect_back("counter");
}

TEST(Guests, AreGivenUpWhenTheCounterNeverWorks) {
  TestSystem system{"SUPERVISE hall RESTARTS 1 IN 1min\n"
                    "SUPERVISE SYSTEM RESTARTS 0 IN 1min\n" +
                    hall()};
  system.inject("crash counter");
  system.expect_back("counter");
  system.inject("crash counter");
  system.expect_end(1, "hall has failed as a whole");
}
