#include "castor/actors/link/node_socket.hpp"

#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/private_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <variant>

namespace castor {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr uid_t other_user = 65534;

sockaddr_storage address_of(const char* ip, std::uint16_t port) {
  sockaddr_storage result{};
  auto& v4 = reinterpret_cast<sockaddr_in&>(result);
  auto& v6 = reinterpret_cast<sockaddr_in6&>(result);
  if (inet_pton(AF_INET, ip, &v4.sin_addr) == 1) {
    v4.sin_family = AF_INET;
    v4.sin_port = htons(port);
  } else {
    inet_pton(AF_INET6, ip, &v6.sin6_addr);
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(port);
  }
  return result;
}

const sockaddr& plain(const sockaddr_storage& x) {
  return reinterpret_cast<const sockaddr&>(x);
}

std::variant<int, std::string> dial_port(std::uint16_t port, PeerTrust trust) {
  return dial({"127.0.0.1", port}, trust, 2s, [] { return false; });
}

std::string problem_at(std::uint16_t port) {
  auto result = dial_port(port, PeerTrust::same_user);
  if (auto* fd = std::get_if<int>(&result)) {
    close(*fd);
    return {};
  }
  return std::get<std::string>(result);
}

TEST(NodeSocket, IsNamedForTheAddressAndFoundFromIt) {
  EXPECT_THAT(node_socket_names(plain(address_of("127.0.0.1", 7117))),
              ElementsAre("127.0.0.1:7117.node", "0.0.0.0:7117.node", "[::]:7117.node"));
  EXPECT_THAT(node_socket_names(plain(address_of("::1", 80))),
              ElementsAre("[::1]:80.node", "[::]:80.node"));
}

TEST(NodeSocket, LeadsWhoeverDialsTheAddressToTheNodeAndNotToThePort) {
  for (auto* host : {"127.0.0.1", "0.0.0.0"}) {
    int tcp = listen_at({host, 0});
    auto port = port_of(tcp);
    auto beside = listen_beside(tcp);
    EXPECT_EQ(why_not_private(beside.file.parent_path()), "");
    for (auto trust : {PeerTrust::same_user, PeerTrust::anybody}) {
      auto dialled = dial_port(port, trust);
      ASSERT_TRUE(std::holds_alternative<int>(dialled)) << std::get<std::string>(dialled);
      EXPECT_TRUE(local_peer(std::get<int>(dialled)));
      close(std::get<int>(dialled));
    }
    // Certificates are for TCP.
    auto certified = std::get<int>(dial_port(port, PeerTrust::certified));
    EXPECT_FALSE(local_peer(certified));
    close(certified);
    close(tcp);
    close(beside.socket);
    std::filesystem::remove(beside.file);
  }
}

TEST(NodeSocket, OneThatAKilledNodeLeftLeadsNowhere) {
  int tcp = listen_at({"127.0.0.1", 0});
  auto left = listen_beside(tcp);
  close(left.socket);
  EXPECT_THAT(problem_at(port_of(tcp)),
              HasSubstr("is yours, but no node for systems of its own user"));
  auto next = listen_beside(tcp);
  EXPECT_EQ(next.file, left.file);
  EXPECT_EQ(problem_at(port_of(tcp)), "");
  close(next.socket);
  close(tcp);
  std::filesystem::remove(next.file);
}

TEST(NodeSocket, WhereNobodyListensTheConnectionIsRefused) {
  int tcp = listen_at({"127.0.0.1", 0});
  auto port = port_of(tcp);
  close(tcp);
  EXPECT_EQ(problem_at(port), "Connection refused");
}

TEST(NodeSocket, APortOfAnotherUserIsNotTalkedTo) {
  if (geteuid() != 0)
    GTEST_SKIP() << "only root can become another user";
  int tcp = listen_at({"127.0.0.1", 0});
  auto port = port_of(tcp);
  close(tcp);
  int listens[2];
  ASSERT_EQ(pipe(listens), 0);
  auto child = fork();
  if (child == 0) {
    if (setresuid(other_user, other_user, other_user) != 0)
      _exit(1);
    int fd = listen_at({"127.0.0.1", port});
    [[maybe_unused]] auto written = write(listens[1], "", 1);
    // Whoever connects is told of.
    for (pollfd x{fd, POLLIN, 0}; poll(&x, 1, -1) > 0;)
      if (accept(fd, nullptr, nullptr) >= 0)
        written = write(listens[1], "", 1);
    _exit(1);
  }
  close(listens[1]);
  char c = 0;
  EXPECT_EQ(read(listens[0], &c, 1), 1);
  EXPECT_THAT(problem_at(port), testing::AllOf(HasSubstr("belongs to user"), HasSubstr("--tls DIR"),
                                               HasSubstr("--insecure")));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(read(listens[0], &c, 1), 0) << "it was connected with";
  close(listens[0]);
}

TEST(NodeSocket, TheKernelsTableSaysWhoListens) {
  const std::string head = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when "
                           "retrnsmt   uid  timeout inode\n";
  const std::string rest = " 00000000:00000000 00:00000000 00000000 ";
  auto tcp = head + "   0: 0100007F:1BCD 00000000:0000 0A" + rest + " 1000        0 100 1\n" +
             "   1: 0100007F:0050 0100007F:9999 01" + rest + " 7        0 100 1\n" +
             "   2: 00000000:0050 00000000:0000 0A" + rest + "    33        0 100 1\n";
  auto tcp6 = head + "   0: 00000000000000000000000001000000:1BCD " + std::string(32, '0') +
              ":0000 0A" + rest + "  1001        0 1 1\n" + "   1: " + std::string(32, '0') +
              ":1F90 " + std::string(32, '0') + ":0000 0A" + rest + "  1002        0 1 1\n" +
              "short line\n";
  auto user = [&](const char* ip, std::uint16_t port) {
    return listening_user(tcp, tcp6, plain(address_of(ip, port)));
  };
  EXPECT_EQ(user("127.0.0.1", 7117), 1000u);
  EXPECT_EQ(user("127.0.0.2", 7117), std::nullopt);
  EXPECT_EQ(user("::1", 7117), 1001u);
  // A connection is no listener, but all addresses hold this one, too.
  EXPECT_EQ(user("127.0.0.1", 80), 33u);
  EXPECT_EQ(user("::1", 80), std::nullopt);
  EXPECT_EQ(user("127.0.0.1", 8080), 1002u);
  EXPECT_EQ(listening_user("", "", plain(address_of("127.0.0.1", 80))), std::nullopt);
}

} // namespace

} // namespace castor
