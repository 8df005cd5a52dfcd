#pragma once

#include "castor/actors/link/secure_channel.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

struct ssl_ctx_st;
struct ssl_st;

namespace castor::test {

/// A peer that is no Castor node: OpenSSL as it comes, which believes everybody. Its own errors are
/// of no interest.
class RawPeer {
public:
  /// Shows the certificate in `directory`, or none if that is empty.
  RawPeer(SecureChannel::Role role, const std::filesystem::path& directory,
          const std::function<void(ssl_ctx_st*)>& set_up = {});

  ssl_st* ssl() { return ssl_.get(); }

  void receive(std::span<const std::uint8_t> from_network, Bytes& plain);
  void send(std::span<const std::uint8_t> plain);
  void take_outgoing(std::vector<char>& out);

private:
  std::shared_ptr<ssl_st> ssl_;
};

} // namespace castor::test
