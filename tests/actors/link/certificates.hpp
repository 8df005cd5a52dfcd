#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct evp_pkey_st;
struct x509_st;

namespace castor::test {

/// What a certificate says. Times are relative to now.
struct Content {
  std::string common_name;
  std::vector<std::string> dns_names{};
  std::chrono::seconds valid_from = -std::chrono::hours{1};
  std::chrono::seconds valid_until = std::chrono::hours{1};
  std::string purposes = "serverAuth,clientAuth";
  bool is_ca = false;
};

/// A CA that signs whatever a test asks for.
class Authority {
public:
  explicit Authority(Content content = {.common_name = "test CA"});
  /// An intermediate CA: what it issues contains its own certificate, and `parent` as the CA.
  Authority(Content content, const Authority& parent);

  /// Writes ca.pem, node.pem and node.key into the directory, which is made and returned.
  std::filesystem::path issue(const std::filesystem::path& directory, const Content& content) const;

private:
  std::shared_ptr<evp_pkey_st> key_;
  std::shared_ptr<x509_st> certificate_;
  std::shared_ptr<x509_st> root_;
};

} // namespace castor::test
