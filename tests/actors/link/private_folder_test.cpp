#include "castor/actors/link/private_folder.hpp"

#include "castor/actors/link/local_socket.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace castor {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PrivateFolder : public testing::Test {
protected:
  PrivateFolder() {
    std::string name = "/tmp/castor-private-XXXXXX";
    folder = mkdtemp(name.data());
    if (auto* before = std::getenv("XDG_RUNTIME_DIR"))
      environment = before;
    setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  }

  ~PrivateFolder() override {
    if (environment.empty())
      unsetenv("XDG_RUNTIME_DIR");
    else
      setenv("XDG_RUNTIME_DIR", environment.c_str(), 1);
    fs::remove_all(folder);
  }

  std::vector<std::string> content(const fs::path& of) const {
    std::vector<std::string> result;
    for (auto& x : fs::directory_iterator{of})
      result.push_back(x.path().filename());
    std::sort(result.begin(), result.end());
    return result;
  }

  static fs::path in_tmp() { return "/tmp/castor-" + std::to_string(geteuid()); }

  fs::path folder;
  std::string environment;
};

TEST_F(PrivateFolder, IsMadeForItsUserAlone) {
  EXPECT_EQ(runtime_folder(), folder / "castor");
  struct stat status {};
  ASSERT_EQ(lstat((folder / "castor").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0700u);
  EXPECT_EQ(why_not_private(folder / "castor"), "");
}

TEST_F(PrivateFolder, OneThatIsOpenToOthersIsNotUsed) {
  fs::create_directory(folder / "castor");
  for (mode_t mode : {0701u, 0710u, 0704u, 0777u}) {
    chmod((folder / "castor").c_str(), mode);
    EXPECT_THAT(why_not_private(folder / "castor"), HasSubstr("chmod 700"));
    EXPECT_THROW(runtime_folder(), std::runtime_error) << mode;
  }
}

TEST_F(PrivateFolder, ALinkToAnotherIsNotUsed) {
  fs::create_directory(folder / "mine");
  chmod((folder / "mine").c_str(), 0700);
  fs::create_directory_symlink(folder / "mine", folder / "castor");
  EXPECT_THAT(why_not_private(folder / "castor"), HasSubstr("is no folder"));
  EXPECT_THROW(runtime_folder(), std::runtime_error);
}

TEST_F(PrivateFolder, AFileIsNotUsed) {
  std::ofstream{folder / "castor"} << "";
  EXPECT_THROW(runtime_folder(), std::runtime_error);
}

TEST_F(PrivateFolder, WhereOthersMayReplaceItItIsNotMade) {
  chmod(folder.c_str(), 0777);
  EXPECT_EQ(runtime_folder(), in_tmp());
  fs::create_directory(folder / "castor");
  chmod((folder / "castor").c_str(), 0700);
  EXPECT_THAT(why_not_private(folder / "castor"), HasSubstr("may be replaced"));
  EXPECT_THAT(private_folders(), testing::Not(testing::Contains(folder / "castor")));
  // As in /tmp, where everybody can replace what is theirs.
  chmod(folder.c_str(), 01777);
  EXPECT_EQ(why_not_private(folder / "castor"), "");
}

TEST_F(PrivateFolder, OneOfAnotherUserIsNotUsed) {
  if (geteuid() != 0)
    GTEST_SKIP() << "only root can make files that belong to others";
  fs::create_directory(folder / "castor");
  chmod((folder / "castor").c_str(), 0700);
  ASSERT_EQ(chown((folder / "castor").c_str(), 65534, 65534), 0);
  EXPECT_THAT(why_not_private(folder / "castor"), HasSubstr("belongs to user"));
  EXPECT_THROW(runtime_folder(), std::runtime_error);
  // Whoever became another user may still have the folder of the former one in the environment.
  fs::remove(folder / "castor");
  ASSERT_EQ(chown(folder.c_str(), 65534, 65534), 0);
  EXPECT_EQ(runtime_folder(), in_tmp());
}

TEST_F(PrivateFolder, AnEnvironmentWithALongPathIsNotUsed) {
  auto deep = folder / std::string(70, 'x');
  fs::create_directory(deep);
  setenv("XDG_RUNTIME_DIR", deep.c_str(), 1);
  EXPECT_EQ(runtime_folder(), in_tmp());
}

TEST_F(PrivateFolder, ARunsFolderIsPrivateAndGoesWithIt) {
  fs::path path;
  {
    RunFolder run;
    path = run.path();
    EXPECT_EQ(path.parent_path(), folder / "castor");
    EXPECT_EQ(why_not_private(path), "");
    EXPECT_LT((path / "999").string().size(), longest_socket_path);
    sweep(path.parent_path());
    EXPECT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(PrivateFolder, WhatAKilledProcessLeftIsSweptByTheNext) {
  int made[2];
  ASSERT_EQ(pipe(made), 0);
  auto child = fork();
  if (child == 0) {
    RunFolder run;
    listen_at_path(run.path() / "1");
    listen_at_path(runtime_folder() / "old-1.sock");
    [[maybe_unused]] auto written = write(made[1], "", 1);
    for (;;)
      pause();
  }
  char c = 0;
  ASSERT_EQ(read(made[0], &c, 1), 1);
  auto alive = listen_at_path(runtime_folder() / "alive-1.sock");
  sweep(runtime_folder());
  EXPECT_EQ(content(runtime_folder()).size(), 3u);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  std::string next;
  {
    RunFolder run;
    next = run.path().filename();
    EXPECT_THAT(content(runtime_folder()), ElementsAre("alive-1.sock", next));
  }
  EXPECT_THAT(content(runtime_folder()), ElementsAre("alive-1.sock"));
  close(alive);
  close(made[0]);
  close(made[1]);
}

TEST_F(PrivateFolder, ManyRunsThatBeginAtOnceDoNotSweepEachOther) {
  runtime_folder();
  std::vector<std::thread> threads;
  std::atomic<int> lost{0};
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int n = 0; n < 20; ++n) {
        RunFolder run;
        auto socket = listen_at_path(run.path() / "0");
        sweep(run.path().parent_path());
        lost += is_abandoned(run.path() / "0") || !fs::exists(run.path() / "0");
        close(socket);
      }
    });
  for (auto& x : threads)
    x.join();
  EXPECT_EQ(lost, 0);
  EXPECT_THAT(content(runtime_folder()), IsEmpty());
}

TEST_F(PrivateFolder, OneThatHangsHoldsUpNobodyForLong) {
  auto in = runtime_folder();
  const FolderLock first{in, 0ms};
  EXPECT_TRUE(first.is_held());
  const FolderLock second{in, 10ms};
  EXPECT_FALSE(second.is_held());
  sweep(in);
  RunFolder run{in};
  EXPECT_TRUE(fs::exists(run.path()));
}

} // namespace

} // namespace castor
