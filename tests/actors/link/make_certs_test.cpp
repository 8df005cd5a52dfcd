#include "castor/actors/link/credentials.hpp"
#include "castor/tests/actors/link/certificates.hpp"
#include "castor/tests/actors/link/conversation.hpp"
#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

bool has_openssl() {
  try {
    return Process{{"openssl", "version"}}.wait() == 0;
  } catch (const std::runtime_error&) {
    return false;
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in{file};
  return {std::istreambuf_iterator<char>{in}, {}};
}

class MakeCerts : public testing::Test {
protected:
  void SetUp() override {
    if (!has_openssl())
      GTEST_SKIP() << "there is no openssl command";
  }

  /// The exit status; what the script says goes to `said`.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), CASTOR_MAKE_CERTS);
    Process script{arguments};
    auto status = script.wait();
    said = script.output() + script.errors();
    return status;
  }

  TemporaryFolder folder;
  std::string directory = folder / "certs";
  std::string said;
};

TEST_F(MakeCerts, MakesNodesThatKnowEachOther) {
  ASSERT_EQ(run({directory, "arm", "desk"}), 0) << said;
  auto arm = Credentials::load(directory + "/arm");
  EXPECT_THAT(arm.names(), ElementsAre("arm"));
  Conversation talk{
    SecureChannel{arm, SecureChannel::Role::dials},
    SecureChannel{Credentials::load(directory + "/desk"), SecureChannel::Role::accepts}};
  talk.carry();
  EXPECT_TRUE(talk.dialer.channel.peer_has_name("desk"));
  EXPECT_TRUE(talk.acceptor.channel.peer_has_name("arm"));
}

TEST_F(MakeCerts, AddsNodesToTheCaThatIsThere) {
  ASSERT_EQ(run({directory, "arm"}), 0) << said;
  auto ca = text_of(directory + "/ca.pem");
  ASSERT_EQ(run({"--days", "2", directory, "desk"}), 0) << said;
  EXPECT_EQ(text_of(directory + "/desk/ca.pem"), ca);
  EXPECT_EQ(text_of(directory + "/arm/ca.pem"), ca);
  Credentials::load(directory + "/desk");
}

TEST_F(MakeCerts, KeepsKeysFromOthers) {
  ASSERT_EQ(run({directory, "arm"}), 0) << said;
  using std::filesystem::perms;
  for (auto file : {"/ca.key", "/arm/node.key"})
    EXPECT_EQ(std::filesystem::status(directory + file).permissions(),
              perms::owner_read | perms::owner_write)
      << file;
}

TEST_F(MakeCerts, OverwritesAKeyOnlyIfForced) {
  ASSERT_EQ(run({directory, "arm"}), 0) << said;
  auto key = text_of(directory + "/arm/node.key");
  EXPECT_EQ(run({directory, "desk", "arm"}), 1);
  EXPECT_THAT(said, HasSubstr("arm/node.key is there already. --force makes a new one"));
  EXPECT_EQ(text_of(directory + "/arm/node.key"), key);
  EXPECT_FALSE(std::filesystem::exists(directory + "/desk")) << "all or nothing";
  auto ca = text_of(directory + "/ca.pem");
  EXPECT_EQ(run({"--force", directory, "arm"}), 0) << said;
  EXPECT_NE(text_of(directory + "/arm/node.key"), key);
  EXPECT_EQ(text_of(directory + "/ca.pem"), ca);
  Credentials::load(directory + "/arm");
}

TEST_F(MakeCerts, NeedsTheKeyOfTheCa) {
  ASSERT_EQ(run({directory, "arm"}), 0) << said;
  std::filesystem::remove(directory + "/ca.key");
  EXPECT_EQ(run({directory, "desk"}), 1);
  EXPECT_THAT(said, HasSubstr("ca.key is missing"));
}

TEST_F(MakeCerts, LeavesNothingElseBehind) {
  ASSERT_EQ(run({directory, "arm"}), 0) << said;
  std::vector<std::string> names;
  for (auto& x : std::filesystem::directory_iterator{directory})
    names.push_back(x.path().filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre("ca.pem", "ca.key", "arm"));
}

TEST_F(MakeCerts, RefusesWhatItDoesNotUnderstand) {
  EXPECT_EQ(run({directory}), 2);
  EXPECT_THAT(said, HasSubstr("scripts/make-certs DIR NAME..."));
  for (auto name : {"a b", "../arm", "arm/left", "a,DNS:desk"}) {
    EXPECT_EQ(run({directory, name}), 1) << name;
    EXPECT_THAT(said, HasSubstr("is no name for a node"));
  }
  for (auto days : {"0", "many", "99999", ""}) {
    EXPECT_EQ(run({"--days", days, directory, "arm"}), 1) << days;
    EXPECT_THAT(said, HasSubstr("--days takes"));
  }
  EXPECT_EQ(run({"--frce", directory, "arm"}), 1);
  EXPECT_THAT(said, HasSubstr("'--frce'"));
  EXPECT_FALSE(std::filesystem::exists(directory));
}

TEST_F(MakeCerts, ExplainsItself) {
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(said, HasSubstr("scripts/make-certs DIR NAME..."));
}

} // namespace

} // namespace castor::test
