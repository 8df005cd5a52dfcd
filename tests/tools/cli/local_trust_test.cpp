#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// Who may run programs as whom, on one machine: attacks by a second user, with the castor
/// executable itself.
namespace castor::test {

namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class LocalTrust : public Nodes {
protected:
  void SetUp() override {
    Nodes::SetUp();
    if (geteuid() != 0)
      GTEST_SKIP() << "only root can try what another user could do";
    if (!getpwnam("nobody"))
      GTEST_SKIP() << "there is no user nobody";
    // What the attacker needs, and nothing of what the victim has.
    attackers_ = folder / "attacker";
    std::filesystem::create_directory(attackers_);
    std::filesystem::permissions(folder, std::filesystem::perms{0755});
    auto* nobody = getpwnam("nobody");
    ASSERT_EQ(chown(attackers_.c_str(), nobody->pw_uid, nobody->pw_gid), 0);
    if (as_nobody({CASTOR_EXECUTABLE, "--version"}).status != 0)
      GTEST_SKIP() << "the user nobody cannot run " << CASTOR_EXECUTABLE;
  }

  void TearDown() override {
    // The folder of the sockets of the attacker's nodes, if nothing else is in it.
    if (auto* nobody = getpwnam("nobody"))
      rmdir(("/tmp/castor-" + std::to_string(nobody->pw_uid)).c_str());
    Nodes::TearDown();
  }

  static std::vector<std::string> for_nobody(std::vector<std::string> arguments) {
    std::vector<std::string> result{"setpriv",
                                    "--reuid=nobody",
                                    "--clear-groups",
                                    "--regid=" + std::to_string(getpwnam("nobody")->pw_gid),
                                    "env",
                                    "-u",
                                    "XDG_RUNTIME_DIR"};
    result.insert(result.end(), arguments.begin(), arguments.end());
    return result;
  }

  static Answer as_nobody(std::vector<std::string> arguments) {
    Process castor{for_nobody(std::move(arguments))};
    auto status = castor.wait();
    return {status, castor.output(), castor.errors()};
  }

  /// A system that runs a program where the node at an address lives; it says whose it is.
  std::vector<std::string> attack(const std::string& address,
                                  const std::vector<std::string>& more = {}) {
    auto file = write("attack.cast", "HOSTNAME prey prey.test\nSUBARCHITECTURE x [prey]\n"
                                     "CPP WM SubarchitectureWorkingMemory\n"
                                     "CPP TM AlwaysPositiveTaskManager\n"
                                     "CPP UM trespasser Trespasser --file " +
                                       trace().string() + '\n');
    std::vector<std::string> result{"run", file, "--node", "prey=" + address, "--for", "2s"};
    result.insert(result.end(), more.begin(), more.end());
    return command(result);
  }

  std::filesystem::path trace() const { return attackers_ / "trace"; }

  /// The user that the program ran as; empty if it did not.
  std::string ran_as() const {
    std::ifstream in{trace()};
    std::string result;
    std::getline(in, result);
    return result;
  }

  /// Sockets at which children of a process listen, in the kernel's table of one protocol: TCP
  /// ports in the form of the table, or paths.
  static std::set<std::string> listening_children(pid_t parent, const std::string& protocol) {
    std::set<std::string> inodes;
    for (auto& process : std::filesystem::directory_iterator{"/proc"}) {
      std::ifstream status{process.path() / "status"};
      std::string text{std::istreambuf_iterator<char>{status}, {}};
      std::error_code error;
      if (text.find("\nPPid:\t" + std::to_string(parent) + '\n') != text.npos)
        for (std::filesystem::directory_iterator i{process.path() / "fd", error}, end;
             !error && i != end; i.increment(error)) {
          auto to = std::filesystem::read_symlink(i->path(), error).string();
          if (to.starts_with("socket:["))
            inodes.insert(to.substr(8, to.size() - 9));
        }
    }
    std::set<std::string> result;
    std::ifstream table{"/proc/net/" + protocol};
    for (std::string line; std::getline(table, line);) {
      std::istringstream in{line};
      std::vector<std::string> words{std::istream_iterator<std::string>{in}, {}};
      bool is_unix = protocol == "unix";
      if (is_unix && words.size() > 7 && words[3] == "00010000" && inodes.contains(words[6]))
        result.insert(words[7]);
      if (!is_unix && words.size() > 9 && words[3] == "0A" && inodes.contains(words[9]))
        result.insert(words[1]);
    }
    return result;
  }

  std::string isolated_system() const {
    return system("CPP UM ticker Ticker\nCPP UM listener Listener --count 1000000 --isolate\n");
  }

private:
  std::filesystem::path attackers_;
};

TEST_F(LocalTrust, ChildrenOfARunListenWhereNobodyElseComes) {
  Process castor{command({"run", isolated_system()})};
  ASSERT_TRUE(castor.wait_for_output("hears ticks")) << castor.errors();
  EXPECT_THAT(listening_children(castor.pid(), "tcp"), IsEmpty());
  EXPECT_THAT(listening_children(castor.pid(), "tcp6"), IsEmpty());
  auto sockets = listening_children(castor.pid(), "unix");
  ASSERT_THAT(sockets, SizeIs(1));
  auto path = std::filesystem::path{*sockets.begin()};
  struct stat status {};
  ASSERT_EQ(lstat(path.parent_path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0700u);
  EXPECT_EQ(status.st_uid, geteuid());

  auto answer = as_nobody(attack("unix:" + path.string()));
  EXPECT_EQ(answer.status, 2) << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("Permission denied"));
  // Even if the folders were open, the kernel would say whose process it is.
  for (auto& x : {path.parent_path(), path.parent_path().parent_path()})
    chmod(x.c_str(), 0755);
  chmod(path.c_str(), 0777);
  answer = as_nobody(attack("unix:" + path.string()));
  EXPECT_EQ(answer.status, 2) << answer.errors;
  EXPECT_TRUE(castor.wait_for_output("it belongs to another user")) << castor.errors();
  EXPECT_EQ(ran_as(), "");

  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_FALSE(std::filesystem::exists(path.parent_path()));
}

TEST_F(LocalTrust, SocketsOfAKilledRunAreSweptByTheNext) {
  std::filesystem::path left;
  {
    Process castor{command({"run", isolated_system()})};
    ASSERT_TRUE(castor.wait_for_output("hears ticks")) << castor.errors();
    left = std::filesystem::path{*listening_children(castor.pid(), "unix").begin()}.parent_path();
    castor.send_signal(SIGKILL);
    castor.wait();
  }
  EXPECT_TRUE(std::filesystem::exists(left));
  EXPECT_EQ(ask({"run", isolated_system(), "--for", "1s"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::is_empty(left.parent_path()));
}

TEST_F(LocalTrust, APlainNodeTakesSystemsOfItsOwnUserAlone) {
  auto node = start_node("prey");
  for (auto& more : {std::vector<std::string>{}, {"--insecure"}}) {
    auto answer = as_nobody(attack(node.address, more));
    EXPECT_EQ(answer.status, 2) << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("--tls DIR"));
    EXPECT_THAT(answer.errors, HasSubstr("user root (0)"));
  }
  EXPECT_EQ(ran_as(), "");
  for (auto& more : {std::vector<std::string>{}, {"--insecure"}}) {
    Process own{attack(node.address, more)};
    EXPECT_EQ(own.wait(), 0) << own.errors();
    EXPECT_EQ(ran_as(), "0");
    std::filesystem::remove(trace());
  }
}

TEST_F(LocalTrust, AnInsecureNodeTakesThoseOfEverybodyWhoSaysSoToo) {
  auto node = start_node("prey", {"--insecure"});
  EXPECT_TRUE(node.process->wait_for_output("every user of this machine"));
  auto answer = as_nobody(attack(node.address));
  EXPECT_EQ(answer.status, 2) << answer.errors;
  EXPECT_EQ(ran_as(), "");
  answer = as_nobody(attack(node.address, {"--insecure"}));
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_EQ(ran_as(), "0");
}

TEST_F(LocalTrust, ANodeOfAnotherUserIsNotTalkedTo) {
  auto arguments = for_nobody(command({"node", "--name", "prey", "--listen", "127.0.0.1:0"}));
  Process impostor{arguments};
  ASSERT_TRUE(impostor.wait_for_output("listens at 127.0.0.1:")) << impostor.errors();
  auto output = impostor.output();
  auto begin = output.find("127.0.0.1:");
  auto address = output.substr(begin, output.find('\n', begin) - begin);
  Process own{attack(address)};
  EXPECT_EQ(own.wait(), 2);
  EXPECT_THAT(own.errors(), HasSubstr("belongs to user nobody"));
  EXPECT_THAT(own.errors(), HasSubstr("--tls DIR"));
  // Nothing was said to it.
  EXPECT_THAT(impostor.errors(), Not(AnyOf(HasSubstr("takes part"), HasSubstr("turned away"),
                                           HasSubstr("without a word"))));
  EXPECT_EQ(ran_as(), "");
  impostor.send_signal(SIGTERM);
  EXPECT_EQ(impostor.wait(), 0) << impostor.errors();
}

} // namespace

} // namespace castor::test
