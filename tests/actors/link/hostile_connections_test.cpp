#include "castor/actors/link/channel.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/session.hpp"
#include "castor/actors/node/node.hpp"
#include "castor/base/log.hpp"
#include "castor/tests/actors/link/certificates.hpp"
#include "castor/tests/actors/link/raw_connection.hpp"
#include "castor/tests/actors/link/raw_peer.hpp"
#include "castor/tests/support/eventually.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;
using test::eventually;
using test::open_descriptors;
using test::RawConnection;
using testing::HasSubstr;

/// What a coordinator says first, over the connection that it has made as its n-th.
std::string greeting(const std::string& system, std::uint64_t attempt = 1) {
  std::vector<char> result;
  write_greeting(result, Hello{"run", system, 4711, 0, 1, 0, 0, attempt});
  return {result.begin(), result.end()};
}

/// A frame of `LinkSession`.
std::string frame(std::uint8_t kind, const std::string& content) {
  auto size = static_cast<std::uint32_t>(content.size() + 1);
  std::string result;
  for (int i = 0; i < 4; ++i)
    result += static_cast<char>(size >> (8 * i) & 0xff);
  return result + static_cast<char>(kind) + content;
}

const std::string bad_frame = frame(77, "nonsense");
const std::string goodbye = frame(3, "that was all");

/// The certificates of one CA.
class HostileCertificates : public testing::Test {
protected:
  std::filesystem::path certificate(const std::string& name) {
    return authority.issue(folder / name, {.common_name = name, .dns_names = {name}});
  }

  test::TemporaryFolder folder;
  test::Authority authority;
};

/// A node of this process, and peers that mean no good.
class HostileConnections : public HostileCertificates, public testing::WithParamInterface<bool> {
protected:
  void start() {
    auto socket = listen_at({"127.0.0.1", 0});
    port = port_of(socket);
    NodeOptions options;
    options.name = "robot";
    options.socket = socket;
    options.insecure = !uses_tls();
    if (uses_tls())
      options.credentials = Credentials::load(certificate("robot"));
    node.emplace(options);
    // From now on it has what it needs.
    say_and_wait_for_the_end(greeting("first") + goodbye);
    EXPECT_TRUE(eventually([&] { return node->systems().empty(); }));
  }

  bool uses_tls() const { return GetParam(); }

  /// Says it in one segment, over TLS if the node wants that, and waits until the node ends the
  /// connection.
  void say_and_wait_for_the_end(const std::string& words) {
    ASSERT_TRUE(is_heard_and_ended(words));
  }

  /// False if it was not heard, or the connection goes on.
  bool is_heard_and_ended(const std::string& words) {
    RawConnection connection{port};
    if (!uses_tls()) {
      connection.send(words);
      return connection.is_ended_by_peer();
    }
    test::RawPeer peer{SecureChannel::Role::dials, peers_certificate};
    auto flush = [&] {
      std::vector<char> out;
      peer.take_outgoing(out);
      connection.send({out.data(), out.size()});
    };
    flush();
    Bytes plain;
    while (SSL_is_init_finished(peer.ssl()) == 0) {
      auto heard = connection.receive_some();
      if (heard.empty())
        return false;
      peer.receive(Bytes{heard.begin(), heard.end()}, plain);
    }
    // With the last words of the handshake.
    peer.send(Bytes{words.begin(), words.end()});
    flush();
    return connection.is_ended_by_peer();
  }

  std::filesystem::path peers_certificate = certificate("run");
  std::uint16_t port = 0;
  std::optional<Node> node;
};

TEST_P(HostileConnections, DescriptorsAreReleasedWhateverFollowsAGreeting) {
  start();
  auto leaves_nothing = [&](const std::string& what) {
    SCOPED_TRACE(what);
    // The first may make something that stays.
    say_and_wait_for_the_end(greeting("system 0") + what);
    ASSERT_TRUE(eventually([&] { return node->systems().empty(); }));
    auto before = open_descriptors();
    for (int i = 1; i <= 20; ++i)
      say_and_wait_for_the_end(greeting("system " + std::to_string(i)) + what);
    EXPECT_TRUE(eventually([&] { return open_descriptors() <= before; }))
      << open_descriptors() << " descriptors, after " << before;
  };
  leaves_nothing(bad_frame);
  leaves_nothing(goodbye);
  leaves_nothing(frame(0, "a part that ends too early"));
  leaves_nothing(std::string(100'000, '\xff'));
}

TEST_P(HostileConnections, ConnectionsThatReplaceEachOtherLeaveNothing) {
  start();
  // The links of a system take one connection after the other, often several at once.
  auto before = open_descriptors();
  for (int round = 0; round < 5 && !uses_tls(); ++round) {
    std::vector<std::unique_ptr<RawConnection>> connections;
    for (std::uint64_t i = 0; i < 40; ++i) {
      connections.push_back(std::make_unique<RawConnection>(port));
      connections.back()->send(greeting("system", round * 100 + i + 1));
    }
    connections.clear();
  }
  EXPECT_TRUE(eventually([&] { return open_descriptors() <= before + 1; }))
    << open_descriptors() << " descriptors, after " << before;
}

TEST_P(HostileConnections, HalfGreetingsAndResetsLeaveNothing) {
  start();
  auto whole = uses_tls() ? std::string("\x16\x03\x01\x02\x00\x01", 6) : greeting("system");
  auto before = open_descriptors();
  for (std::size_t i = 0; i < 60; ++i) {
    RawConnection connection{port};
    connection.send(whole.substr(0, 1 + i % (whole.size() - 1)));
    if (i % 2 == 0)
      connection.reset();
  }
  EXPECT_TRUE(eventually([&] { return open_descriptors() <= before; }))
    << open_descriptors() << " descriptors, after " << before;
}

/// Uses up all file descriptors of this process but one, until it is destroyed.
class OneDescriptor {
public:
  OneDescriptor() {
    getrlimit(RLIMIT_NOFILE, &before_);
    auto low = before_;
    low.rlim_cur = std::min<rlim_t>(before_.rlim_cur, open_descriptors() + 100);
    setrlimit(RLIMIT_NOFILE, &low);
    use_up();
  }
  OneDescriptor(const OneDescriptor&) = delete;
  OneDescriptor& operator=(const OneDescriptor&) = delete;
  ~OneDescriptor() {
    for (int x : used_)
      close(x);
    setrlimit(RLIMIT_NOFILE, &before_);
  }

  /// Those too that were released meanwhile.
  void use_up() {
    for (int x = dup(0); x >= 0; x = dup(0))
      used_.push_back(x);
    close(used_.back());
    used_.pop_back();
  }

private:
  rlimit before_{};
  std::vector<int> used_;
};

double seconds_of_cpu() {
  rusage x{};
  getrusage(RUSAGE_SELF, &x);
  return static_cast<double>(x.ru_utime.tv_sec + x.ru_stime.tv_sec) +
         static_cast<double>(x.ru_utime.tv_usec + x.ru_stime.tv_usec) * 1e-6;
}

TEST_P(HostileConnections, WithoutDescriptorsConnectionsAreTurnedAwayAndNothingSpins) {
  start();
  // What other tests have caused of the same kind is not to be counted with it.
  flush_log();
  testing::internal::CaptureStderr();
  {
    // One descriptor for a peer, and none for the node.
    OneDescriptor one;
    // The node may have let go of others only now.
    EXPECT_TRUE(eventually([&] {
      one.use_up();
      auto asked = std::chrono::steady_clock::now();
      RawConnection{port}.receive_all();
      return std::chrono::steady_clock::now() - asked < 1s;
    }));
    auto begin = std::chrono::steady_clock::now();
    auto cpu = seconds_of_cpu();
    for (int i = 0; i < 10; ++i)
      EXPECT_THAT(RawConnection{port}.receive_all(),
                  HasSubstr(uses_tls() ? "" : "no file descriptors left"));
    auto took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(seconds_of_cpu() - cpu, 0.1 + 0.5 * took);
  }
  // There are descriptors again, as the node sees when somebody comes.
  EXPECT_TRUE(eventually([&] { return is_heard_and_ended(greeting("system") + goodbye); }));
  // By then the node has logged whom it had turned away, which a peer may know of earlier.
  flush_log();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("ulimit -n"));
}

TEST_P(HostileConnections, IdleStrangersKeepNobodyOut) {
  start();
  std::vector<std::unique_ptr<RawConnection>> idle;
  for (int i = 0; i < 40; ++i)
    idle.push_back(std::make_unique<RawConnection>(port));
  // There is room for 32 from one address: the first have to go, and are told why.
  auto said = idle.front()->receive_all();
  if (uses_tls()) {
    auto alert = busy_alert();
    EXPECT_EQ(said, std::string(alert.begin(), alert.end()));
  } else {
    EXPECT_THAT(said, HasSubstr("too many unauthenticated connections"));
  }
  say_and_wait_for_the_end(greeting("system") + goodbye);
  // The others are there no longer than silence is borne.
  for (auto& x : idle)
    EXPECT_TRUE(x->is_ended_by_peer());
}

TEST_P(HostileConnections, WhoeverComesWithOrWithoutTlsByMistakeIsTold) {
  start();
  RawConnection connection{port};
  connection.send(uses_tls() ? greeting("system") : std::string("\x16\x03\x01\x02\x00\x01", 6));
  auto said = connection.receive_all();
  EXPECT_THAT(said, HasSubstr("CASTOR"));
  EXPECT_THAT(said, HasSubstr(uses_tls() ? "encrypted connections only" : "no encrypted"));
}

TEST_P(HostileConnections, AFloodIsCountedInTheLog) {
  start();
  testing::internal::CaptureStderr();
  for (int i = 0; i < 300; ++i) {
    RawConnection connection{port};
    connection.send("GET / HTTP/1.1\r\n\r\n");
    ASSERT_TRUE(connection.is_ended_by_peer());
  }
  auto log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("turned away 127.0.0.1"));
  EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 30);
}

TEST_F(HostileCertificates, WhoeverDialsIsToldWhatIsWrong) {
  auto problem = [&](const std::string& said) -> std::string {
    Channel channel{Credentials::load(certificate("run")), SecureChannel::Role::dials};
    try {
      channel.receive({reinterpret_cast<const std::uint8_t*>(said.data()), said.size()});
    } catch (const BusyPeerError& e) {
      return std::string{"busy: "} + e.what();
    } catch (const SecurityError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(problem(greeting("system")), HasSubstr("both sides need --tls"));
  auto alert = busy_alert();
  EXPECT_THAT(problem({alert.begin(), alert.end()}), HasSubstr("busy: the peer has too many"));
  // Who expects no encryption.
  Bytes handshake{0x16, 3, 1};
  try {
    read_greeting(handshake);
    ADD_FAILURE();
  } catch (const LinkError& e) {
    EXPECT_THAT(e.what(), HasSubstr("uses TLS"));
  }
}

INSTANTIATE_TEST_SUITE_P(Channels, HostileConnections, testing::Bool(),
                         [](auto& x) { return x.param ? "Tls" : "Plain"; });

} // namespace

} // namespace castor
