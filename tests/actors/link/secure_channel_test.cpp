#include "castor/actors/link/secure_channel.hpp"
#include "castor/tests/actors/link/certificates.hpp"
#include "castor/tests/actors/link/conversation.hpp"
#include "castor/tests/actors/link/raw_peer.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Role = SecureChannel::Role;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

std::string text(const Bytes& x) {
  return {x.begin(), x.end()};
}

/// How many messages of each kind arrived, other than those that carry data.
using Seen = std::map<int, int>;

/// Makes a raw peer count what it sees.
std::function<void(SSL_CTX*)> watch(Seen& seen) {
  return [&seen](SSL_CTX* context) {
    SSL_CTX_set_msg_callback_arg(context, &seen);
    SSL_CTX_set_msg_callback(context, [](int writes, int, int type, const void* message,
                                         std::size_t size, SSL*, void* sum) {
      if (writes == 0 && type == SSL3_RT_HANDSHAKE && size > 0)
        ++(*static_cast<Seen*>(sum))[*static_cast<const std::uint8_t*>(message)];
    });
  };
}

/// The nodes arm and desk of one CA, and what peers may show that do not belong to them.
class Channels : public testing::Test {
protected:
  std::filesystem::path directory_of(const std::string& node) {
    auto& result = directories[node];
    if (result.empty())
      result = authority.issue(folder / node, {.common_name = node, .dns_names = {node}});
    return result;
  }

  SecureChannel channel(const std::string& node, Role role) {
    return {Credentials::load(directory_of(node)), role};
  }

  Conversation<> arm_dials_desk() {
    Conversation<> result{channel("arm", Role::dials), channel("desk", Role::accepts)};
    result.carry();
    return result;
  }

  std::filesystem::path expired() {
    return authority.issue(folder / "expired",
                           {.common_name = "old arm", .valid_from = -48h, .valid_until = -24h});
  }

  std::filesystem::path of_another_ca() {
    return Authority{{.common_name = "other CA"}}.issue(folder / "stranger",
                                                        {.common_name = "arm"});
  }

  /// A peer without Castor that dials the desk.
  Conversation<RawPeer, SecureChannel>
  dials_desk(const std::filesystem::path& certificate,
             const std::function<void(SSL_CTX*)>& set_up = {}) {
    Conversation<RawPeer, SecureChannel> result{RawPeer{Role::dials, certificate, set_up},
                                                channel("desk", Role::accepts)};
    result.carry();
    return result;
  }

  /// A peer without Castor that the arm dials.
  Conversation<SecureChannel, RawPeer> arm_dials(const std::filesystem::path& certificate,
                                                 const std::function<void(SSL_CTX*)>& set_up = {}) {
    Conversation<SecureChannel, RawPeer> result{channel("arm", Role::dials),
                                                RawPeer{Role::accepts, certificate, set_up}};
    result.carry();
    return result;
  }

  /// What a channel says about a peer that sends this and nothing else.
  std::string complaint(Role role, const Bytes& sent) {
    auto hearing = channel("arm", role);
    Bytes plain;
    try {
      hearing.receive(sent, plain);
    } catch (const SecurityError& error) {
      EXPECT_EQ(ERR_peek_error(), 0u);
      return error.what();
    }
    return "none";
  }

  TemporaryFolder folder;
  Authority authority;
  std::map<std::string, std::filesystem::path> directories;
};

TEST_F(Channels, CarryBothWays) {
  auto talk = arm_dials_desk();
  EXPECT_TRUE(talk.dialer.channel.established());
  EXPECT_TRUE(talk.acceptor.channel.established());
  talk.dialer.channel.send(bytes("lift "));
  talk.dialer.channel.send(bytes("the cup"));
  talk.acceptor.channel.send(bytes("which one?"));
  talk.carry();
  EXPECT_EQ(text(talk.acceptor.heard), "lift the cup");
  EXPECT_EQ(text(talk.dialer.heard), "which one?");
}

TEST_F(Channels, ShowNothingReadableOnTheWire) {
  // Long enough for random bytes not to say it by chance.
  Conversation<> talk{channel("the_left_arm", Role::dials), channel("desk", Role::accepts)};
  talk.carry();
  talk.dialer.channel.send(bytes("lift the cup"));
  talk.carry();
  EXPECT_EQ(text(talk.acceptor.heard), "lift the cup");
  EXPECT_THAT(text(talk.acceptor.wire), Not(HasSubstr("the cup")));
  EXPECT_THAT(text(talk.acceptor.wire), Not(HasSubstr("the_left_arm"))) << "nor who speaks";
}

TEST_F(Channels, KnowWhomTheySpeakTo) {
  auto talk = arm_dials_desk();
  EXPECT_THAT(talk.dialer.channel.peer_names(), ElementsAre("desk"));
  EXPECT_THAT(talk.acceptor.channel.peer_names(), ElementsAre("arm"));
  EXPECT_TRUE(talk.dialer.channel.peer_has_name("desk"));
}

TEST_F(Channels, TellANodeFromAnotherOfTheSameCa) {
  Conversation<> talk{channel("arm", Role::dials), channel("hand", Role::accepts)};
  talk.carry();
  EXPECT_TRUE(talk.dialer.channel.established());
  EXPECT_FALSE(talk.dialer.channel.peer_has_name("desk"));
  for (auto similar : {"", "han", "hands", "Hand", "*"})
    EXPECT_FALSE(talk.dialer.channel.peer_has_name(similar)) << similar;
}

TEST_F(Channels, AreNotDeceivedByZeroBytesInNames) {
  using namespace std::string_literals;
  auto sly =
    authority.issue(folder / "sly", {.common_name = "desk\0.evil"s, .dns_names = {"desk\0"s}});
  auto talk = arm_dials(sly);
  EXPECT_TRUE(talk.dialer.channel.established());
  EXPECT_FALSE(talk.dialer.channel.peer_has_name("desk"));
}

TEST_F(Channels, TakeWildcardsForWhatTheyAre) {
  auto talk = arm_dials(authority.issue(folder / "any", {.common_name = "*", .dns_names = {"*"}}));
  EXPECT_FALSE(talk.dialer.channel.peer_has_name("desk"));
}

TEST_F(Channels, AcceptAnIntermediateCa) {
  Authority lab{{.common_name = "lab CA"}, authority};
  auto talk = dials_desk(lab.issue(folder / "lab", {.common_name = "cart"}));
  EXPECT_TRUE(talk.acceptor.channel.peer_has_name("cart"));
}

TEST_F(Channels, AreNotEstablishedBeforeTheEnd) {
  auto dialer = channel("arm", Role::dials);
  EXPECT_FALSE(dialer.established());
  EXPECT_THAT(dialer.peer_names(), IsEmpty());
  EXPECT_FALSE(dialer.peer_has_name(""));
  EXPECT_THROW(dialer.send(bytes("too early")), std::logic_error);
  std::vector<char> hello;
  dialer.take_outgoing(hello);
  EXPECT_FALSE(hello.empty()) << "it is the dialling side that begins";
}

TEST_F(Channels, AppendToWhatIsToBeWritten) {
  auto dialer = channel("arm", Role::dials);
  std::vector<char> out{'x'};
  dialer.take_outgoing(out);
  EXPECT_GT(out.size(), 100u);
  EXPECT_EQ(out.front(), 'x');
  auto size = out.size();
  dialer.take_outgoing(out);
  EXPECT_EQ(out.size(), size) << "nothing is given twice";
}

TEST_F(Channels, RefuseADialledPeerOfAnotherCa) {
  auto talk = arm_dials(of_another_ca());
  EXPECT_THAT(talk.dialer.failure,
              StartsWith("the peer's certificate (/CN=arm) is not signed by our CA"));
  EXPECT_THAT(talk.dialer.failure, HasSubstr("scripts/make-certs"));
  EXPECT_FALSE(talk.dialer.channel.established());
}

TEST_F(Channels, RefuseADiallingPeerOfAnotherCa) {
  auto talk = dials_desk(of_another_ca());
  EXPECT_THAT(talk.acceptor.failure,
              StartsWith("the peer's certificate (/CN=arm) is not signed by our CA"));
  EXPECT_FALSE(talk.acceptor.channel.established());
}

TEST_F(Channels, RefuseACaOfTheSameName) {
  auto talk = dials_desk(Authority{}.issue(folder / "double", {.common_name = "arm"}));
  EXPECT_THAT(talk.acceptor.failure, HasSubstr("is not signed by our CA"));
}

TEST_F(Channels, OfDifferentSystemsBothLearnWhy) {
  Conversation<> talk{channel("arm", Role::dials),
                      SecureChannel{Credentials::load(of_another_ca()), Role::accepts}};
  talk.carry();
  EXPECT_THAT(talk.dialer.failure, HasSubstr("is not signed by our CA"));
  EXPECT_THAT(talk.acceptor.failure,
              StartsWith("the peer refuses our certificate, which is not signed by its CA"));
}

TEST_F(Channels, LearnAfterDiallingThatTheyAreRefused) {
  auto talk = arm_dials(directory_of("desk"), [](SSL_CTX* x) {
    SSL_CTX_set_verify(x, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  });
  EXPECT_THAT(talk.dialer.failure,
              StartsWith("the peer refuses our certificate, which is not signed by its CA"));
}

TEST_F(Channels, RefuseADiallingPeerWithoutCertificate) {
  auto talk = dials_desk({});
  EXPECT_THAT(talk.acceptor.failure, StartsWith("the peer shows no certificate"));
  EXPECT_FALSE(talk.acceptor.channel.established());
}

TEST_F(Channels, RefuseAnExpiredCertificate) {
  auto pattern = "the peer's certificate \\(/CN=old arm\\) expired on [0-9-]+ [0-9:]+ UTC; .*";
  EXPECT_THAT(dials_desk(expired()).acceptor.failure, MatchesRegex(pattern));
  EXPECT_THAT(arm_dials(expired()).dialer.failure, MatchesRegex(pattern));
}

TEST_F(Channels, RefuseACertificateThatIsMadeForTheOtherEnd) {
  auto server =
    authority.issue(folder / "server", {.common_name = "arm", .purposes = "serverAuth"});
  EXPECT_THAT(dials_desk(server).acceptor.failure,
              HasSubstr("(/CN=arm) is not made for both ends"));
  auto client =
    authority.issue(folder / "client", {.common_name = "desk", .purposes = "clientAuth"});
  EXPECT_THAT(arm_dials(client).dialer.failure, HasSubstr("(/CN=desk) is not made for both ends"));
}

TEST_F(Channels, RefuseOlderVersionsOfTls) {
  auto older = [](SSL_CTX* x) { SSL_CTX_set_max_proto_version(x, TLS1_2_VERSION); };
  EXPECT_EQ(dials_desk(directory_of("arm"), older).acceptor.failure,
            "the peer does not speak TLS 1.3");
  EXPECT_EQ(arm_dials(directory_of("desk"), older).dialer.failure,
            "the peer does not speak TLS 1.3");
}

TEST_F(Channels, DoNotResumeSessions) {
  Seen seen;
  auto talk = dials_desk(directory_of("arm"), watch(seen));
  talk.acceptor.channel.send(bytes("welcome"));
  talk.carry();
  EXPECT_EQ(text(talk.dialer.heard), "welcome");
  EXPECT_EQ(seen[SSL3_MT_NEWSESSION_TICKET], 0);
  EXPECT_EQ(seen[SSL3_MT_FINISHED], 1) << "it is seen what else was sent";
}

TEST_F(Channels, NoticeAPeerWithoutTls) {
  for (auto role : {Role::dials, Role::accepts})
    for (auto sent : {"GET / HTTP/1.1\r\n\r\n", "CONNECT arm:80 HTTP/1.1\r\n",
                      "SSH-2.0-OpenSSH_9.2\r\n", "\1\0\0\0\0\0\0\7"})
      EXPECT_THAT(complaint(role, bytes({sent, 8})), StartsWith("the peer speaks no TLS")) << sent;
}

TEST_F(Channels, RefuseAnEndlessHandshake) {
  auto desk = channel("desk", Role::accepts);
  // One record of a greeting of 16 MB after the other.
  Bytes record{0x16, 0x03, 0x03, 0x40, 0x00, 0x01, 0xff, 0xff, 0xff};
  record.resize(5 + 0x4000);
  Bytes plain;
  auto flood = [&] {
    for (int i = 0; i < 20; ++i)
      desk.receive(record, plain);
  };
  EXPECT_THROW(flood(), SecurityError);
}

TEST_F(Channels, StayFailed) {
  auto talk = arm_dials_desk();
  talk.dialer.channel.send(bytes("lift the cup"));
  std::vector<char> sent;
  talk.dialer.channel.take_outgoing(sent);
  Bytes damaged{sent.begin(), sent.end()};
  damaged.back() ^= 1;
  auto& desk = talk.acceptor.channel;
  Bytes plain;
  std::string failure;
  try {
    desk.receive(damaged, plain);
  } catch (const SecurityError& error) {
    failure = error.what();
  }
  EXPECT_THAT(failure, StartsWith("what arrived from the peer was damaged on the way"));
  for (auto attempt : {0, 1}) {
    try {
      if (attempt == 0)
        desk.receive({}, plain);
      else
        desk.send(bytes("yes"));
      ADD_FAILURE() << attempt;
    } catch (const SecurityError& error) {
      EXPECT_EQ(error.what(), failure);
    }
  }
  EXPECT_THAT(plain, IsEmpty());
  talk.carry();
  EXPECT_THAT(talk.dialer.failure, StartsWith("the peer gave up: ")) << "it was told";
}

TEST_F(Channels, RefuseWhatWasHeardBefore) {
  auto talk = arm_dials_desk();
  talk.dialer.channel.send(bytes("one step forward"));
  std::vector<char> sent;
  talk.dialer.channel.take_outgoing(sent);
  Bytes again{sent.begin(), sent.end()};
  Bytes plain;
  talk.acceptor.channel.receive(again, plain);
  EXPECT_THROW(talk.acceptor.channel.receive(again, plain), SecurityError);
  EXPECT_EQ(text(plain), "one step forward");
}

TEST_F(Channels, SayWhenThePeerEndsTheConnection) {
  auto talk = dials_desk(directory_of("arm"));
  talk.dialer.channel.send(bytes("farewell"));
  SSL_shutdown(talk.dialer.channel.ssl());
  talk.carry();
  EXPECT_EQ(text(talk.acceptor.heard), "farewell");
  EXPECT_EQ(talk.acceptor.failure, "the peer has ended the connection");
}

TEST_F(Channels, DoNotDisturbEachOtherOnOneThread) {
  auto healthy = arm_dials_desk();
  auto stranger = of_another_ca();
  auto noise = [&](int kind) {
    switch (kind) {
      case 0:
        return complaint(Role::accepts, bytes("GET / HTTP/1.1\r\n"));
      case 1:
        return dials_desk(stranger).acceptor.failure;
      case 2:
        return dials_desk({}).acceptor.failure;
      default:
        return arm_dials(stranger).dialer.failure;
    }
  };
  for (int i = 0; i < 40; ++i) {
    EXPECT_NE(noise(i % 4), "");
    healthy.dialer.channel.send(bytes("still"));
    EXPECT_NE(noise((i + 1) % 4), "");
    healthy.carry();
    healthy.acceptor.channel.send(bytes("here"));
    EXPECT_NE(noise((i + 2) % 4), "");
    healthy.carry();
  }
  EXPECT_EQ(healthy.acceptor.heard.size(), 40u * 5);
  EXPECT_EQ(healthy.dialer.heard.size(), 40u * 4);
  EXPECT_EQ(healthy.dialer.failure + healthy.acceptor.failure, "");
}

TEST_F(Channels, AreNotDisturbedByWhatOthersLeaveInTheErrorQueue) {
  auto junk = [] { ERR_raise(ERR_LIB_SSL, SSL_R_BAD_LENGTH); };
  junk();
  auto credentials = Credentials::load(directory_of("arm"));
  junk();
  SecureChannel dialer{credentials, Role::dials};
  junk();
  SecureChannel acceptor{credentials, Role::accepts};
  Bytes heard;
  auto pass = [&](SecureChannel& from, SecureChannel& to) {
    std::vector<char> out;
    from.take_outgoing(out);
    // A byte alone, so that the channel waits for the rest.
    junk();
    to.receive(Bytes(out.begin(), out.begin() + 1), heard);
    junk();
    to.receive(Bytes(out.begin() + 1, out.end()), heard);
  };
  pass(dialer, acceptor);
  pass(acceptor, dialer);
  pass(dialer, acceptor);
  ASSERT_TRUE(acceptor.established());
  junk();
  dialer.send(bytes("lift the cup"));
  pass(dialer, acceptor);
  EXPECT_EQ(text(heard), "lift the cup");
  EXPECT_EQ(ERR_peek_error(), 0u);
}

TEST_F(Channels, CarryMegabytes) {
  auto talk = arm_dials_desk();
  Bytes piece(64 << 10);
  std::iota(piece.begin(), piece.end(), std::uint8_t{0});
  constexpr std::size_t pieces = 160;
  for (std::size_t i = 0; i < pieces; ++i) {
    piece[0] = static_cast<std::uint8_t>(i);
    talk.dialer.channel.send(piece);
    if (i % 7 == 0)
      talk.carry();
  }
  talk.carry();
  ASSERT_EQ(talk.acceptor.heard.size(), pieces * piece.size());
  for (std::size_t i = 0; i < pieces; ++i) {
    piece[0] = static_cast<std::uint8_t>(i);
    EXPECT_TRUE(
      std::equal(piece.begin(), piece.end(),
                 talk.acceptor.heard.begin() + static_cast<std::ptrdiff_t>(i * piece.size())))
      << i;
  }
}

TEST_F(Channels, ChangeTheirKeysInTime) {
  Seen seen;
  Conversation<SecureChannel, RawPeer> talk{
    SecureChannel{Credentials::load(directory_of("arm")), Role::dials, 10},
    RawPeer{Role::accepts, directory_of("desk"), watch(seen)}};
  talk.carry();
  for (int i = 0; i < 1000; ++i)
    talk.dialer.channel.send(bytes("tick"));
  talk.carry();
  EXPECT_EQ(talk.acceptor.heard.size(), 4000u);
  EXPECT_EQ(seen[SSL3_MT_KEY_UPDATE], 99);
  // Ten records, or a little more.
  talk.dialer.channel.send(Bytes(163'840));
  talk.dialer.channel.send(Bytes(163'841));
  talk.dialer.channel.send(bytes("tick"));
  talk.carry();
  EXPECT_EQ(talk.acceptor.heard.size(), 4004u + 163'840 + 163'841);
  EXPECT_EQ(seen[SSL3_MT_KEY_UPDATE], 102);
}

TEST_F(Channels, OfSeveralThreadsShareCredentials) {
  auto arm = Credentials::load(directory_of("arm"));
  auto desk = Credentials::load(directory_of("desk"));
  std::atomic<int> established = 0;
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int j = 0; j < 20; ++j) {
          Conversation<> talk{SecureChannel{arm, Role::dials}, SecureChannel{desk, Role::accepts}};
          talk.carry();
          established += talk.acceptor.channel.peer_has_name("arm") ? 1 : 0;
        }
      });
  }
  EXPECT_EQ(established, 80);
}

} // namespace

} // namespace castor::test
