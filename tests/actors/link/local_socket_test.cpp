#include "castor/actors/link/local_socket.hpp"

#include "castor/actors/link/dial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <variant>

namespace castor {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr uid_t nobody = 65534;

class LocalSocket : public testing::Test {
protected:
  LocalSocket() {
    std::string name = "/tmp/castor-local-XXXXXX";
    folder = mkdtemp(name.data());
  }

  ~LocalSocket() override { fs::remove_all(folder); }

  static std::variant<int, std::string> dial_to(const fs::path& path) {
    return dial({path, 0}, PeerTrust::anybody, 1s, [] { return false; });
  }

  std::string problem_with(const fs::path& path) const {
    try {
      close(listen_at_path(path));
      return {};
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  }

  fs::path folder;
};

TEST_F(LocalSocket, BothSidesKnowWhoseTheOtherIs) {
  int listener = listen_at_path(folder / "s");
  auto dialled = dial_to(folder / "s");
  ASSERT_TRUE(std::holds_alternative<int>(dialled)) << std::get<std::string>(dialled);
  int accepted = accept(listener, nullptr, nullptr);
  for (int x : {std::get<int>(dialled), accepted}) {
    auto peer = local_peer(x);
    ASSERT_TRUE(peer);
    EXPECT_TRUE(peer->is_of_this_user());
    EXPECT_EQ(peer->process, getpid());
    close(x);
  }
  EXPECT_EQ(local_address(listener), folder / "s");
  close(listener);
}

TEST_F(LocalSocket, NobodyElseMayConnect) {
  int listener = listen_at_path(folder / "s");
  struct stat status {};
  ASSERT_EQ(lstat((folder / "s").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  close(listener);
}

TEST_F(LocalSocket, OfSocketsOfOtherKindsNothingIsSaid) {
  int tcp = listen_at({"127.0.0.1", 0});
  EXPECT_FALSE(local_peer(tcp));
  EXPECT_FALSE(local_address(tcp));
  close(tcp);
}

TEST_F(LocalSocket, WhatIsLeftOverIsReplacedAndWhatLivesIsNot) {
  close(listen_at_path(folder / "s"));
  EXPECT_TRUE(is_abandoned(folder / "s"));
  int listener = listen_at_path(folder / "s");
  EXPECT_FALSE(is_abandoned(folder / "s"));
  EXPECT_THAT(problem_with(folder / "s"), HasSubstr("another process listens there"));
  EXPECT_FALSE(is_abandoned(folder / "s"));
  close(listener);
}

TEST_F(LocalSocket, WhatIsNoSocketIsLeftAlone) {
  std::ofstream{folder / "file"} << "precious";
  EXPECT_THAT(problem_with(folder / "file"), HasSubstr("no socket of this user"));
  fs::create_symlink(folder / "file", folder / "link");
  EXPECT_THAT(problem_with(folder / "link"), HasSubstr("no socket of this user"));
  EXPECT_EQ(fs::file_size(folder / "file"), 8u);
  EXPECT_FALSE(is_abandoned(folder / "file"));
  EXPECT_FALSE(is_abandoned(folder / "missing"));
}

TEST_F(LocalSocket, APathThatIsTooLongIsRefused) {
  std::string fits(longest_socket_path - folder.string().size() - 1, 'x');
  EXPECT_EQ(problem_with(folder / fits), "");
  EXPECT_THAT(problem_with(folder / (fits + 'x')), HasSubstr("too long for a socket"));
  EXPECT_TRUE(std::holds_alternative<std::string>(dial_to(folder / (fits + 'x'))));
}

TEST_F(LocalSocket, ABusyListenerIsTriedAgainAndAMissingOneIsNot) {
  EXPECT_THAT(std::get<std::string>(dial_to(folder / "missing")), HasSubstr("No such file"));
  int listener = listen_at_path(folder / "s");
  ASSERT_EQ(listen(listener, 0), 0);
  int first = std::get<int>(dial_to(folder / "s"));
  EXPECT_EQ(connect_to_path(folder / "s"), -1);
  EXPECT_EQ(errno, EAGAIN);
  EXPECT_THAT(std::get<std::string>(dial_to(folder / "s")), HasSubstr("too long"));
  EXPECT_FALSE(is_abandoned(folder / "s"));
  close(first);
  close(listener);
}

TEST_F(LocalSocket, AListenerOfAnotherUserIsNotBelieved) {
  if (geteuid() != 0)
    GTEST_SKIP() << "only root can become another user";
  chmod(folder.c_str(), 0777);
  int listens[2];
  ASSERT_EQ(pipe(listens), 0);
  auto child = fork();
  if (child == 0) {
    if (setresuid(nobody, nobody, nobody) != 0)
      _exit(1);
    int fd = listen_at_path(folder / "s");
    [[maybe_unused]] auto written = write(listens[1], "", 1);
    for (;;)
      close(accept(fd, nullptr, nullptr));
  }
  close(listens[1]);
  char c = 0;
  EXPECT_EQ(read(listens[0], &c, 1), 1);
  EXPECT_THAT(std::get<std::string>(dial_to(folder / "s")),
              HasSubstr("process " + std::to_string(child) + " of user"));
  // Nor is its socket taken away, as long as it lives or afterwards.
  EXPECT_THAT(problem_with(folder / "s"), HasSubstr("no socket of this user"));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_THAT(problem_with(folder / "s"), HasSubstr("no socket of this user"));
  close(listens[0]);
}

} // namespace

} // namespace castor
