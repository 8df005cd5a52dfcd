#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

struct ssl_ctx_st;

namespace castor {

/// Why a link is not or no longer secure; `what()` says what to do about it.
class SecurityError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// TLS identity of a node: its certificate and key, and the CA that signs the certificates of all
/// its peers. Copies share one state, and may be used in several threads.
///
/// There is no revocation: after the theft of a key, a new CA is necessary.
class Credentials {
public:
  /// Reads `ca.pem`, `node.pem` (the certificate, and those between it and the CA if there are any)
  /// and `node.key` of the directory. Throws a SecurityError if one of them is missing or unusable,
  /// if they do not belong together, if the certificate is not valid now, or if others than the
  /// owner may read the key.
  static Credentials load(const std::filesystem::path& directory);

  /// The names that the own certificate proves: its DNS names, and its common name.
  const std::vector<std::string>& names() const { return names_; }

private:
  friend class SecureChannel;

  Credentials(std::shared_ptr<ssl_ctx_st> context, std::vector<std::string> names)
    : context_(std::move(context)), names_(std::move(names)) {}

  std::shared_ptr<ssl_ctx_st> context_;
  std::vector<std::string> names_;
};

} // namespace castor
