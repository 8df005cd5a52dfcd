#include "castor/tools/chaos/descriptor_shortages.hpp"

#include "castor/tests/support/process.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace castor::faults {

namespace {

rlim_t limit_of(pid_t process) {
  rlimit result{};
  EXPECT_EQ(prlimit(process, RLIMIT_NOFILE, nullptr, &result), 0);
  return result.rlim_cur;
}

bool can_open() {
  int descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (descriptor >= 0)
    close(descriptor);
  else
    EXPECT_EQ(errno, EMFILE);
  return descriptor >= 0;
}

TEST(DescriptorShortages, KeepThisProcessFromOpeningAnythingUntilTheLastHasEnded) {
  auto before = limit_of(getpid());
  DescriptorShortages shortages;
  shortages.begin(getpid());
  EXPECT_FALSE(can_open());
  shortages.begin(getpid());
  shortages.end(getpid());
  EXPECT_FALSE(can_open());
  shortages.end(getpid());
  EXPECT_TRUE(can_open());
  EXPECT_EQ(limit_of(getpid()), before);
}

TEST(DescriptorShortages, OfThisProcessEndWithTheObject) {
  auto before = limit_of(getpid());
  {
    DescriptorShortages shortages;
    shortages.begin(getpid());
  }
  EXPECT_TRUE(can_open());
  EXPECT_EQ(limit_of(getpid()), before);
}

TEST(DescriptorShortages, LeaveAnotherProcessWhatItHas) {
  test::Process child{{"sleep", "100"}};
  auto before = limit_of(child.pid());
  DescriptorShortages shortages;
  shortages.begin(child.pid());
  EXPECT_LT(limit_of(child.pid()), 32U);
  EXPECT_TRUE(can_open());
  shortages.end(child.pid());
  EXPECT_EQ(limit_of(child.pid()), before);
}

TEST(DescriptorShortages, OfThisProcessAreNotThoseOfItsChildrenForGood) {
  auto before = limit_of(getpid());
  DescriptorShortages shortages;
  test::Process child{{"sleep", "100"}};
  shortages.begin(getpid());
  auto during = limit_of(getpid());
  rlimit inherited{during, before};
  ASSERT_EQ(prlimit(child.pid(), RLIMIT_NOFILE, &inherited, nullptr), 0);
  shortages.end(getpid());
  shortages.raise_inherited(child.pid());
  EXPECT_EQ(limit_of(child.pid()), before);
}

TEST(DescriptorShortages, AreRefusedForProcessesThatAreNotThere) {
  DescriptorShortages shortages;
  EXPECT_THROW(shortages.begin(999'999'999), std::system_error);
  shortages.end(999'999'999);
}

} // namespace

} // namespace castor::faults
