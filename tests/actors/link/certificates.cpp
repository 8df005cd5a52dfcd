#include "castor/tests/actors/link/certificates.hpp"

#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <cstdint>
#include <initializer_list>
#include <stdexcept>

namespace castor::test {

namespace {

using Key = std::shared_ptr<EVP_PKEY>;
using Certificate = std::shared_ptr<X509>;

void require(bool success) {
  if (!success)
    throw std::runtime_error{std::string{"making a certificate failed: "} +
                             ERR_error_string(ERR_get_error(), nullptr)};
}

Key make_key() {
  Key result{EVP_EC_gen("P-256"), EVP_PKEY_free};
  require(result != nullptr);
  return result;
}

void extend(X509* certificate, X509* issuer, int extension, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  auto* x = X509V3_EXT_conf_nid(nullptr, &context, extension, value.c_str());
  require(x && X509_add_ext(certificate, x, -1) == 1);
  X509_EXTENSION_free(x);
}

/// Not by OpenSSL's configuration syntax, which knows no zero bytes in names.
void add_dns_names(X509* certificate, const std::vector<std::string>& names) {
  auto* list = GENERAL_NAMES_new();
  for (auto& name : names) {
    auto* text = ASN1_IA5STRING_new();
    ASN1_STRING_set(text, name.data(), static_cast<int>(name.size()));
    auto* entry = GENERAL_NAME_new();
    GENERAL_NAME_set0_value(entry, GEN_DNS, text);
    sk_GENERAL_NAME_push(list, entry);
  }
  require(X509_add1_ext_i2d(certificate, NID_subject_alt_name, list, 0, 0) == 1);
  GENERAL_NAMES_free(list);
}

/// Signs itself without an issuer.
Certificate make_certificate(const Content& content, const Key& key, X509* issuer,
                             const Key& issuer_key) {
  Certificate result{X509_new(), X509_free};
  auto* x = result.get();
  X509_set_version(x, X509_VERSION_3);
  std::uint32_t serial = 0;
  RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof(serial));
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(x), serial);
  X509_gmtime_adj(X509_getm_notBefore(x), content.valid_from.count());
  X509_gmtime_adj(X509_getm_notAfter(x), content.valid_until.count());
  X509_set_pubkey(x, key.get());
  if (!content.common_name.empty())
    X509_NAME_add_entry_by_NID(X509_get_subject_name(x), NID_commonName, MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>(content.common_name.data()),
                               static_cast<int>(content.common_name.size()), -1, 0);
  if (!issuer)
    issuer = x;
  X509_set_issuer_name(x, X509_get_subject_name(issuer));
  extend(x, issuer, NID_basic_constraints,
         content.is_ca ? "critical,CA:true" : "critical,CA:false");
  extend(x, issuer, NID_subject_key_identifier, "hash");
  if (!content.is_ca)
    extend(x, issuer, NID_ext_key_usage, content.purposes);
  if (!content.dns_names.empty())
    add_dns_names(x, content.dns_names);
  require(X509_sign(x, issuer_key.get(), EVP_sha256()) > 0);
  return result;
}

void write(const std::filesystem::path& file, std::initializer_list<const X509*> certificates) {
  std::unique_ptr<BIO, decltype(&BIO_free)> out{BIO_new_file(file.c_str(), "w"), BIO_free};
  for (auto* x : certificates)
    require(out && PEM_write_bio_X509(out.get(), x) == 1);
}

void write(const std::filesystem::path& file, EVP_PKEY* key) {
  std::unique_ptr<BIO, decltype(&BIO_free)> out{BIO_new_file(file.c_str(), "w"), BIO_free};
  require(out &&
          PEM_write_bio_PrivateKey(out.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1);
  using std::filesystem::perms;
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
}

} // namespace

Authority::Authority(Content content) : key_(make_key()) {
  content.is_ca = true;
  certificate_ = make_certificate(content, key_, nullptr, key_);
  root_ = certificate_;
}

Authority::Authority(Content content, const Authority& parent)
  : key_(make_key()), root_(parent.root_) {
  content.is_ca = true;
  certificate_ = make_certificate(content, key_, parent.certificate_.get(), parent.key_);
}

std::filesystem::path Authority::issue(const std::filesystem::path& directory,
                                       const Content& content) const {
  auto key = make_key();
  auto certificate = make_certificate(content, key, certificate_.get(), key_);
  std::filesystem::create_directories(directory);
  write(directory / "ca.pem", {root_.get()});
  if (certificate_ == root_)
    write(directory / "node.pem", {certificate.get()});
  else
    write(directory / "node.pem", {certificate.get(), certificate_.get()});
  write(directory / "node.key", key.get());
  return directory;
}

} // namespace castor::test
