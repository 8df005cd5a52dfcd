#include "castor/actors/link/credentials.hpp"

#include "castor/actors/link/certificate.hpp"
#include "castor/actors/link/error_queue.hpp"
#include "castor/base/input_file.hpp"

#include <openssl/pem.h>
#include <openssl/pemerr.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>

#include <iterator>
#include <system_error>

namespace castor {

namespace {

using std::filesystem::path;

template <auto Free>
struct Deleter {
  template <class T>
  void operator()(T* x) const {
    Free(x);
  }
};

using Bio = std::unique_ptr<BIO, Deleter<BIO_free>>;
using Certificate = std::unique_ptr<X509, Deleter<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Deleter<EVP_PKEY_free>>;
using Verification = std::unique_ptr<X509_STORE_CTX, Deleter<X509_STORE_CTX_free>>;

constexpr auto make_certs = "scripts/make-certs makes ca.pem, node.pem and node.key for each node";
constexpr auto make_anew = "scripts/make-certs --force makes a new one";

/// Bytes of a file with certificates: some thousands of them.
constexpr std::size_t longest_pem = std::size_t{4} << 20;

[[noreturn]] void refuse(const path& file, const std::string& problem, const std::string& remedy) {
  throw SecurityError{file.string() + ": " + problem + "; " + remedy};
}

std::string text_of(const path& file) {
  try {
    return read_input_file(file, longest_pem);
  } catch (const InputFileError& e) {
    switch (e.reason()) {
      case InputFileError::Reason::missing:
        refuse(file, e.what(), make_certs);
      case InputFileError::Reason::folder:
      case InputFileError::Reason::special:
        refuse(file, std::string{"this is not a file: "} + e.what(), make_certs);
      case InputFileError::Reason::too_long:
        refuse(file, e.what(), make_certs);
      case InputFileError::Reason::unreadable:
        break;
    }
    refuse(file, std::string{"cannot be read: "} + e.what(),
           "it must be readable for the user that runs the node");
  }
}

Bio reader_of(const std::string& text) {
  return Bio{BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))};
}

std::vector<Certificate> certificates_in(const path& file) {
  ErrorQueue errors;
  auto text = text_of(file);
  auto reader = reader_of(text);
  std::vector<Certificate> result;
  while (auto* x = PEM_read_bio_X509(reader.get(), nullptr, nullptr, nullptr))
    result.emplace_back(x);
  // The end of the file is reported as an error too.
  if (errors.pem_reason() != PEM_R_NO_START_LINE)
    refuse(file, "holds a damaged certificate (" + errors.text() + ")", make_anew);
  if (result.empty())
    refuse(file, "holds no certificate in PEM form", make_certs);
  return result;
}

/// OpenSSL would ask for it on the terminal.
int refuse_passphrase(char*, int, int, void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

Key key_in(const path& file) {
  using std::filesystem::perms;
  ErrorQueue errors;
  auto text = text_of(file);
  std::error_code error;
  auto permissions = std::filesystem::status(file, error).permissions();
  if ((permissions & (perms::group_all | perms::others_all)) != perms::none)
    refuse(file, "others than its owner have access to the key, so it proves nothing",
           "chmod 600 " + file.string() + ", or make a new one if somebody may have read it");
  auto reader = reader_of(text);
  bool asked = false;
  Key result{PEM_read_bio_PrivateKey(reader.get(), nullptr, refuse_passphrase, &asked)};
  if (asked)
    refuse(file, "the key is encrypted, and a node cannot ask for a passphrase",
           "openssl pkey -in FILE -out FILE removes it");
  if (!result)
    refuse(file, "holds no private key in PEM form", make_anew);
  return result;
}

/// What every connection of the node is made from.
std::shared_ptr<SSL_CTX> make_context() {
  ErrorQueue errors;
  std::shared_ptr<SSL_CTX> result{SSL_CTX_new(TLS_method()), SSL_CTX_free};
  if (!result)
    throw SecurityError{"OpenSSL cannot be used: " + errors.text()};
  SSL_CTX_set_min_proto_version(result.get(), TLS1_3_VERSION);
  SSL_CTX_set_max_proto_version(result.get(), TLS1_3_VERSION);
  SSL_CTX_set_verify(result.get(), SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  // A resumed session would not show its certificate again.
  SSL_CTX_set_session_cache_mode(result.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(result.get(), SSL_OP_NO_TICKET);
  SSL_CTX_set_num_tickets(result.get(), 0);
  return result;
}

void trust(SSL_CTX* context, const path& file) {
  for (auto& x : certificates_in(file)) {
    if (X509_check_ca(x.get()) == 0)
      refuse(file, "the certificate of " + subject_of(x.get()) + " is not that of a CA",
             make_certs);
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context), x.get());
  }
}

/// Checks our own certificate as every peer will.
void verify(SSL_CTX* context, const path& file) {
  ErrorQueue errors;
  STACK_OF(X509)* chain = nullptr;
  SSL_CTX_get0_chain_certs(context, &chain);
  for (int purpose : {X509_PURPOSE_SSL_SERVER, X509_PURPOSE_SSL_CLIENT}) {
    Verification verification{X509_STORE_CTX_new()};
    X509_STORE_CTX_init(verification.get(), SSL_CTX_get_cert_store(context),
                        SSL_CTX_get0_certificate(context), chain);
    X509_STORE_CTX_set_purpose(verification.get(), purpose);
    if (X509_verify_cert(verification.get()) != 1)
      refuse(file, "the certificate " + why_not_valid(verification.get()), make_anew);
  }
}

} // namespace

Credentials Credentials::load(const path& directory) {
  auto certificate_file = directory / "node.pem";
  auto key_file = directory / "node.key";
  auto context = make_context();
  trust(context.get(), directory / "ca.pem");
  auto certificates = certificates_in(certificate_file);
  auto key = key_in(key_file);

  ErrorQueue errors;
  auto* own = certificates.front().get();
  if (X509_check_private_key(own, key.get()) != 1)
    refuse(key_file, "the key is not that of the certificate in " + certificate_file.string(),
           make_anew);
  auto names = names_in(own);
  if (names.empty())
    refuse(certificate_file, "the certificate names no node", make_anew);
  if (SSL_CTX_use_certificate(context.get(), own) != 1 ||
      SSL_CTX_use_PrivateKey(context.get(), key.get()) != 1)
    refuse(certificate_file, "OpenSSL refuses the certificate or its key: " + errors.text(),
           make_anew);
  for (auto x = certificates.begin() + 1; x != certificates.end(); ++x)
    SSL_CTX_add1_chain_cert(context.get(), x->get());
  verify(context.get(), certificate_file);
  return {std::move(context), std::move(names)};
}

} // namespace castor
