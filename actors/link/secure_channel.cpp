#include "castor/actors/link/secure_channel.hpp"

#include "castor/actors/link/certificate.hpp"
#include "castor/actors/link/error_queue.hpp"

#include <openssl/bio.h>
#include <openssl/ssl.h>
#include <openssl/sslerr.h>
#include <openssl/x509_vfy.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <stdexcept>

namespace castor {

namespace {

constexpr std::size_t record_size = SSL3_RT_MAX_PLAIN_LENGTH;

std::string explain_alert(int alert) {
  switch (alert) {
    case SSL_AD_UNKNOWN_CA:
      return "the peer refuses our certificate, which is not signed by its CA; the certificates of "
             "a "
             "system come from one DIR of scripts/make-certs";
    case SSL_AD_CERTIFICATE_EXPIRED:
      return "the peer refuses our certificate, which has expired by its clock";
    case SSL_AD_BAD_CERTIFICATE:
    case SSL_AD_UNSUPPORTED_CERTIFICATE:
    case SSL_AD_CERTIFICATE_REVOKED:
    case SSL_AD_CERTIFICATE_UNKNOWN:
      return std::string{"the peer refuses our certificate: "} + SSL_alert_desc_string_long(alert);
    case SSL_AD_USER_CANCELLED:
      return "the peer has too many unauthenticated connections; the connection is tried again";
    case SSL_AD_PROTOCOL_VERSION:
      return "the peer does not speak TLS 1.3";
    default:
      return std::string{"the peer gave up: "} + SSL_alert_desc_string_long(alert);
  }
}

std::string explain(const ErrorQueue& errors, bool established) {
  auto reason = errors.ssl_reason();
  if (reason >= SSL_AD_REASON_OFFSET)
    return explain_alert(reason - SSL_AD_REASON_OFFSET);
  if (established)
    return "what arrived from the peer was damaged on the way: " + errors.text();
  switch (reason) {
    case SSL_R_WRONG_VERSION_NUMBER:
    case SSL_R_HTTP_REQUEST:
    case SSL_R_HTTPS_PROXY_REQUEST:
      return "the peer speaks no TLS; is it a Castor node, and started with --tls?";
    case SSL_R_UNSUPPORTED_PROTOCOL:
      return "the peer does not speak TLS 1.3";
    case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
      return "the peer shows no certificate; is it a Castor node?";
    default:
      return "the TLS handshake with the peer failed: " + errors.text();
  }
}

} // namespace

std::vector<char> busy_alert() {
  // A record of TLS 1.2, as TLS 1.3 has it, with a fatal alert.
  return {SSL3_RT_ALERT, 3, 3, 0, 2, SSL3_AL_FATAL, SSL_AD_USER_CANCELLED};
}

struct SecureChannel::State {
  State(SSL_CTX* context, Role role);

  void require_health() const;
  void shake_hands(const ErrorQueue& errors);
  /// Whether an operation that returned `result` has only run out of bytes from the network.
  bool wants_more(int result) const;
  [[noreturn]] void fail(int result, const ErrorQueue& errors);

  // What OpenSSL calls.
  static BIO_METHOD* network();
  static int read(BIO* bio, char* to, int size) noexcept;
  static int write(BIO* bio, const char* from, int size) noexcept;
  static long control(BIO* bio, int command, long number, void* pointer) noexcept;
  static int on_verified(int valid, X509_STORE_CTX* verification) noexcept;

  std::unique_ptr<SSL, void (*)(SSL*)> ssl;
  /// What is left of the bytes from the network, during `receive`.
  std::span<const std::uint8_t> incoming;
  std::vector<char> outgoing;
  bool established = false;
  std::vector<std::string> peer_names;
  /// Why the peer's certificate was refused.
  std::string refusal;
  /// Why nothing works any more.
  std::string failure;
  std::uint64_t records_per_key = 0;
  /// How many records the present key has encrypted, not counting handshakes.
  std::uint64_t records = 0;
};

SecureChannel::State::State(SSL_CTX* context, Role role) : ssl(SSL_new(context), SSL_free) {
  auto* bio = BIO_new(network());
  if (!ssl || !bio)
    throw std::bad_alloc{};
  BIO_set_data(bio, this);
  BIO_set_init(bio, 1);
  SSL_set_bio(ssl.get(), bio, bio);
  SSL_set_app_data(ssl.get(), this);
  SSL_set_verify(ssl.get(), SSL_get_verify_mode(ssl.get()), on_verified);
  if (role == Role::dials)
    SSL_set_connect_state(ssl.get());
  else
    SSL_set_accept_state(ssl.get());
}

void SecureChannel::State::require_health() const {
  if (!failure.empty())
    throw SecurityError{failure};
}

void SecureChannel::State::shake_hands(const ErrorQueue& errors) {
  auto result = SSL_do_handshake(ssl.get());
  if (result == 1) {
    peer_names = names_in(SSL_get0_peer_certificate(ssl.get()));
    established = true;
  } else if (!wants_more(result))
    fail(result, errors);
}

bool SecureChannel::State::wants_more(int result) const {
  return SSL_get_error(ssl.get(), result) == SSL_ERROR_WANT_READ;
}

void SecureChannel::State::fail(int result, const ErrorQueue& errors) {
  if (SSL_get_error(ssl.get(), result) == SSL_ERROR_ZERO_RETURN)
    failure = "the peer has ended the connection";
  else
    failure = refusal.empty() ? explain(errors, established) : refusal;
  incoming = {};
  if (!established && errors.ssl_reason() == SSL_AD_REASON_OFFSET + SSL_AD_USER_CANCELLED)
    throw BusyPeerError{failure};
  throw SecurityError{failure};
}

BIO_METHOD* SecureChannel::State::network() {
  static BIO_METHOD* const method = [] {
    auto* x = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "castor link");
    BIO_meth_set_read(x, read);
    BIO_meth_set_write(x, write);
    BIO_meth_set_ctrl(x, control);
    return x;
  }();
  return method;
}

int SecureChannel::State::read(BIO* bio, char* to, int size) noexcept {
  auto& incoming = static_cast<State*>(BIO_get_data(bio))->incoming;
  BIO_clear_retry_flags(bio);
  if (incoming.empty()) {
    BIO_set_retry_read(bio);
    return -1;
  }
  auto n = std::min(incoming.size(), static_cast<std::size_t>(size));
  std::memcpy(to, incoming.data(), n);
  incoming = incoming.subspan(n);
  return static_cast<int>(n);
}

int SecureChannel::State::write(BIO* bio, const char* from, int size) noexcept {
  auto& outgoing = static_cast<State*>(BIO_get_data(bio))->outgoing;
  BIO_clear_retry_flags(bio);
  outgoing.insert(outgoing.end(), from, from + size);
  return size;
}

long SecureChannel::State::control(BIO*, int command, long, void*) noexcept {
  return command == BIO_CTRL_FLUSH ? 1 : 0;
}

int SecureChannel::State::on_verified(int valid, X509_STORE_CTX* verification) noexcept {
  if (valid == 1)
    return 1;
  auto* ssl = static_cast<SSL*>(
    X509_STORE_CTX_get_ex_data(verification, SSL_get_ex_data_X509_STORE_CTX_idx()));
  static_cast<State*>(SSL_get_app_data(ssl))->refusal =
    "the peer's certificate (" + subject_of(X509_STORE_CTX_get0_cert(verification)) + ") " +
    why_not_valid(verification) +
    "; the certificates of a system come from one DIR of scripts/make-certs";
  return 0;
}

SecureChannel::SecureChannel(const Credentials& credentials, Role role,
                             std::uint64_t records_per_key) {
  ErrorQueue errors;
  state_ = std::make_unique<State>(credentials.context_.get(), role);
  state_->records_per_key = records_per_key;
  if (role == Role::dials)
    state_->shake_hands(errors);
}

SecureChannel::SecureChannel(SecureChannel&&) noexcept = default;

SecureChannel& SecureChannel::operator=(SecureChannel&&) noexcept = default;

SecureChannel::~SecureChannel() = default;

void SecureChannel::receive(std::span<const std::uint8_t> from_network, Bytes& plain) {
  state_->require_health();
  ErrorQueue errors;
  state_->incoming = from_network;
  if (!state_->established)
    state_->shake_hands(errors);
  if (!state_->established)
    return;
  std::array<std::uint8_t, record_size> buffer;
  auto* ssl = state_->ssl.get();
  std::size_t n = 0;
  int result = 0;
  while ((result = SSL_read_ex(ssl, buffer.data(), buffer.size(), &n)) == 1)
    plain.insert(plain.end(), buffer.data(), buffer.data() + n);
  if (!state_->wants_more(result))
    state_->fail(result, errors);
}

void SecureChannel::send(std::span<const std::uint8_t> plain) {
  state_->require_health();
  if (!state_->established)
    throw std::logic_error{"a secure channel sends only once it is established"};
  if (plain.empty())
    return;
  ErrorQueue errors;
  auto* ssl = state_->ssl.get();
  // OpenSSL does not do this by itself.
  if (state_->records >= state_->records_per_key &&
      SSL_key_update(ssl, SSL_KEY_UPDATE_NOT_REQUESTED) == 1)
    state_->records = 0;
  state_->records += (plain.size() + record_size - 1) / record_size;
  std::size_t written = 0;
  if (SSL_write_ex(ssl, plain.data(), plain.size(), &written) != 1)
    state_->fail(0, errors);
}

void SecureChannel::take_outgoing(std::vector<char>& out) {
  auto& outgoing = state_->outgoing;
  if (out.empty())
    out.swap(outgoing);
  else
    out.insert(out.end(), outgoing.begin(), outgoing.end());
  outgoing.clear();
}

bool SecureChannel::established() const {
  return state_->established;
}

const std::vector<std::string>& SecureChannel::peer_names() const {
  return state_->peer_names;
}

bool SecureChannel::peer_has_name(std::string_view name) const {
  auto& names = state_->peer_names;
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace castor
