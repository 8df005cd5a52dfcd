#include "castor/tests/actors/link/raw_peer.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <array>
#include <stdexcept>

namespace castor::test {

RawPeer::RawPeer(SecureChannel::Role role, const std::filesystem::path& directory,
                 const std::function<void(SSL_CTX*)>& set_up) {
  std::shared_ptr<SSL_CTX> context{SSL_CTX_new(TLS_method()), SSL_CTX_free};
  auto* x = context.get();
  if (!directory.empty() &&
      (SSL_CTX_use_certificate_chain_file(x, (directory / "node.pem").c_str()) != 1 ||
       SSL_CTX_use_PrivateKey_file(x, (directory / "node.key").c_str(), SSL_FILETYPE_PEM) != 1))
    throw std::runtime_error{"no certificate in " + directory.string()};
  if (set_up)
    set_up(x);
  ssl_.reset(SSL_new(x), SSL_free);
  SSL_set_bio(ssl(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
  if (role == SecureChannel::Role::dials)
    SSL_set_connect_state(ssl());
  else
    SSL_set_accept_state(ssl());
  SSL_do_handshake(ssl());
  ERR_clear_error();
}

void RawPeer::receive(std::span<const std::uint8_t> from_network, Bytes& plain) {
  BIO_write(SSL_get_rbio(ssl()), from_network.data(), static_cast<int>(from_network.size()));
  std::array<std::uint8_t, 4096> buffer{};
  for (std::size_t n = 0; SSL_read_ex(ssl(), buffer.data(), buffer.size(), &n) == 1;)
    plain.insert(plain.end(), buffer.data(), buffer.data() + n);
  ERR_clear_error();
}

void RawPeer::send(std::span<const std::uint8_t> plain) {
  SSL_write(ssl(), plain.data(), static_cast<int>(plain.size()));
  ERR_clear_error();
}

void RawPeer::take_outgoing(std::vector<char>& out) {
  std::array<char, 4096> buffer{};
  for (int n = 0; (n = BIO_read(SSL_get_wbio(ssl()), buffer.data(), buffer.size())) > 0;)
    out.insert(out.end(), buffer.data(), buffer.data() + n);
  ERR_clear_error();
}

} // namespace castor::test
