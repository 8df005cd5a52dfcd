#include "castor/actors/link/credentials.hpp"
#include "castor/tests/actors/link/certificates.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <unistd.h>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

class CredentialsOfANode : public testing::Test {
protected:
  std::filesystem::path arm() const { return authority.issue(folder / "arm", arm_content); }

  /// What loading the directory says is wrong.
  static std::string problem_of(const std::filesystem::path& directory) {
    try {
      Credentials::load(directory);
    } catch (const SecurityError& error) {
      EXPECT_EQ(ERR_peek_error(), 0u);
      return error.what();
    }
    return "nothing";
  }

  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream{file} << text;
  }

  static void encrypt(const std::filesystem::path& file) {
    std::unique_ptr<BIO, decltype(&BIO_free)> in{BIO_new_file(file.c_str(), "r"), BIO_free};
    std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key{
      PEM_read_bio_PrivateKey(in.get(), nullptr, nullptr, nullptr), EVP_PKEY_free};
    std::unique_ptr<BIO, decltype(&BIO_free)> out{BIO_new_file(file.c_str(), "w"), BIO_free};
    unsigned char passphrase[] = "secret";
    ASSERT_EQ(PEM_write_bio_PrivateKey(out.get(), key.get(), EVP_aes_128_cbc(), passphrase, 6,
                                       nullptr, nullptr),
              1);
  }

  TemporaryFolder folder;
  Authority authority;
  Content arm_content{.common_name = "arm", .dns_names = {"arm"}};
};

TEST_F(CredentialsOfANode, NameTheNode) {
  EXPECT_THAT(Credentials::load(arm()).names(), ElementsAre("arm"));
  EXPECT_EQ(ERR_peek_error(), 0u);
}

TEST_F(CredentialsOfANode, HaveAllDnsNamesAndThenTheCommonName) {
  auto directory = authority.issue(
    folder / "arm", {.common_name = "the arm", .dns_names = {"arm", "arm.lab", "arm"}});
  EXPECT_THAT(Credentials::load(directory).names(), ElementsAre("arm", "arm.lab", "the arm"));
}

TEST_F(CredentialsOfANode, AreFineWithACommonNameOnly) {
  EXPECT_THAT(Credentials::load(authority.issue(folder / "arm", {.common_name = "arm"})).names(),
              ElementsAre("arm"));
}

TEST_F(CredentialsOfANode, MayBeSignedByAnIntermediateCa) {
  Authority between{{.common_name = "lab CA"}, authority};
  EXPECT_THAT(Credentials::load(between.issue(folder / "arm", arm_content)).names(),
              ElementsAre("arm"));
}

TEST_F(CredentialsOfANode, AreRefusedWithoutTheDirectory) {
  EXPECT_THAT(problem_of(folder / "nowhere"),
              HasSubstr("nowhere/ca.pem: there is no such file; scripts/make-certs"));
}

TEST_F(CredentialsOfANode, AreRefusedWithoutOneOfTheFiles) {
  for (auto file : {"ca.pem", "node.pem", "node.key"}) {
    auto directory = arm();
    std::filesystem::remove(directory / file);
    EXPECT_THAT(problem_of(directory), HasSubstr(std::string{"arm/"} + file +
                                                 ": there is no such file; scripts/make-certs"));
  }
}

TEST_F(CredentialsOfANode, AreRefusedIfAFileIsADirectory) {
  for (auto file : {"ca.pem", "node.pem", "node.key"}) {
    auto directory = arm();
    std::filesystem::remove(directory / file);
    std::filesystem::create_directory(directory / file);
    EXPECT_THAT(problem_of(directory), HasSubstr(std::string{file} + ": this is not a file"));
    std::filesystem::remove(directory / file);
  }
}

TEST_F(CredentialsOfANode, AreRefusedIfAFileCannotBeRead) {
  if (geteuid() == 0)
    GTEST_SKIP() << "root may read every file";
  auto directory = arm();
  std::filesystem::permissions(directory / "node.key", std::filesystem::perms::none);
  EXPECT_THAT(problem_of(directory), HasSubstr("node.key: cannot be read: Permission denied"));
}

TEST_F(CredentialsOfANode, AreRefusedIfAFileHoldsSomethingElse) {
  for (auto text : {"", "certificate\n", "-----BEGIN CERTIFICATE-----\n"}) {
    for (auto file : {"ca.pem", "node.pem"}) {
      auto directory = arm();
      write(directory / file, text);
      EXPECT_THAT(problem_of(directory), MatchesRegex(std::string{".*/"} + file +
                                                      ": holds (no|a damaged) certificate.*; "
                                                      "scripts/make-certs.*"));
    }
    auto directory = arm();
    write(directory / "node.key", text);
    EXPECT_THAT(problem_of(directory),
                HasSubstr("node.key: holds no private key in PEM form; scripts/make-certs"));
  }
}

TEST_F(CredentialsOfANode, AreRefusedIfACertificateIsDamaged) {
  auto directory = arm();
  write(directory / "node.pem", "-----BEGIN CERTIFICATE-----\nMIIB\n-----END CERTIFICATE-----\n");
  EXPECT_THAT(problem_of(directory), HasSubstr("node.pem: holds a damaged certificate ("));
}

TEST_F(CredentialsOfANode, AreRefusedIfOthersMayReadTheKey) {
  using std::filesystem::perms;
  for (auto more : {perms::group_read, perms::others_read, perms::others_write}) {
    auto key = arm() / "node.key";
    std::filesystem::permissions(key, more, std::filesystem::perm_options::add);
    EXPECT_THAT(problem_of(folder / "arm"), AllOf(HasSubstr("node.key: others than its owner"),
                                                  HasSubstr("; chmod 600 " + key.string())));
  }
}

TEST_F(CredentialsOfANode, AreRefusedIfTheKeyIsThatOfAnotherNode) {
  auto directory = arm();
  auto other = authority.issue(folder / "desk", {.common_name = "desk"});
  std::filesystem::copy_file(other / "node.key", directory / "node.key",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(
    problem_of(directory),
    MatchesRegex(".*/node.key: the key is not that of the certificate in .*/node.pem; .*"));
}

TEST_F(CredentialsOfANode, AreRefusedIfTheKeyIsEncrypted) {
  auto directory = arm();
  encrypt(directory / "node.key");
  EXPECT_THAT(problem_of(directory),
              HasSubstr("node.key: the key is encrypted, and a node cannot ask for a passphrase"));
}

TEST_F(CredentialsOfANode, AreRefusedIfTheCertificateIsOfAnotherCa) {
  // Of the same name: it is the key that counts.
  for (auto name : {"test CA", "other CA"}) {
    auto directory = arm();
    auto other = Authority{{.common_name = name}}.issue(folder / "other", arm_content);
    std::filesystem::copy_file(other / "ca.pem", directory / "ca.pem",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THAT(problem_of(directory),
                HasSubstr("node.pem: the certificate is not signed by our CA; scripts/make-certs"));
  }
}

TEST_F(CredentialsOfANode, AreRefusedIfTheCaIsNone) {
  auto directory = arm();
  std::filesystem::copy_file(directory / "node.pem", directory / "ca.pem",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(problem_of(directory),
              HasSubstr("ca.pem: the certificate of /CN=arm is not that of a CA"));
}

TEST_F(CredentialsOfANode, AreRefusedOutsideTheirTime) {
  arm_content.valid_from = -48h;
  arm_content.valid_until = -24h;
  EXPECT_THAT(problem_of(arm()),
              MatchesRegex(".*/node.pem: the certificate expired on "
                           "[0-9]+-[0-9]+-[0-9]+ [0-9]+:[0-9]+ UTC; scripts/make-certs --force.*"));
  arm_content.valid_from = 24h;
  arm_content.valid_until = 48h;
  EXPECT_THAT(problem_of(arm()), MatchesRegex(".*/node.pem: the certificate is valid from "
                                              ".* UTC on, .*by the clock of this host; .*"));
}

TEST_F(CredentialsOfANode, AreRefusedIfTheirCaHasExpired) {
  Authority old{{.common_name = "old CA", .valid_from = -48h, .valid_until = -24h}};
  EXPECT_THAT(problem_of(old.issue(folder / "arm", arm_content)),
              HasSubstr("signed by /CN=old CA, whose own certificate expired on "));
}

TEST_F(CredentialsOfANode, AreRefusedIfMadeForOneEndOnly) {
  for (auto purposes : {"serverAuth", "clientAuth"}) {
    arm_content.purposes = purposes;
    EXPECT_THAT(problem_of(arm()), HasSubstr("is not made for both ends of a TLS connection"));
  }
}

TEST_F(CredentialsOfANode, AreRefusedWithoutAName) {
  EXPECT_THAT(problem_of(authority.issue(folder / "arm", {})),
              HasSubstr("node.pem: the certificate names no node"));
}

} // namespace

} // namespace castor::test
