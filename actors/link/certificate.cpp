#include "castor/actors/link/certificate.hpp"

#include "castor/actors/link/error_queue.hpp"

#include <openssl/x509.h>
#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>

namespace castor {

namespace {

/// The whole of it, zero bytes too: what ends early at one could pass for another name.
std::string text_of(const ASN1_STRING* text) {
  unsigned char* utf8 = nullptr;
  auto size = ASN1_STRING_to_UTF8(&utf8, text);
  if (size < 0)
    return {};
  std::string result{reinterpret_cast<const char*>(utf8), static_cast<std::size_t>(size)};
  OPENSSL_free(utf8);
  return result;
}

std::string date_of(const ASN1_TIME* time) {
  std::tm utc{};
  if (ASN1_TIME_to_tm(time, &utc) != 1)
    return "an unreadable date";
  std::array<char, 32> buffer{};
  auto size = std::strftime(buffer.data(), buffer.size(), "%Y-%m-%d %H:%M UTC", &utc);
  return {buffer.data(), size};
}

std::string issue(int error, const X509* certificate) {
  switch (error) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return "expired on " + date_of(X509_get0_notAfter(certificate));
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return "is valid from " + date_of(X509_get0_notBefore(certificate)) +
             " on, which is still to come by the clock of this host";
    case X509_V_ERR_INVALID_PURPOSE:
      return "is not made for both ends of a TLS connection";
    default:
      return std::string{"is not valid: "} + X509_verify_cert_error_string(error);
  }
}

} // namespace

std::vector<std::string> names_in(const X509* certificate) {
  // A malformed extension is reported there, and names nobody.
  ErrorQueue errors;
  std::vector<std::string> result;
  auto add = [&](const ASN1_STRING* text) {
    auto name = text_of(text);
    if (!name.empty() && std::find(result.begin(), result.end(), name) == result.end())
      result.push_back(std::move(name));
  };
  std::unique_ptr<GENERAL_NAMES, void (*)(GENERAL_NAMES*)> alternatives{
    static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)),
    GENERAL_NAMES_free};
  for (int i = 0; i < sk_GENERAL_NAME_num(alternatives.get()); ++i)
    if (auto* x = sk_GENERAL_NAME_value(alternatives.get(), i); x->type == GEN_DNS)
      add(x->d.dNSName);
  auto* subject = X509_get_subject_name(certificate);
  for (int at = -1; (at = X509_NAME_get_index_by_NID(subject, NID_commonName, at)) >= 0;)
    add(X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at)));
  return result;
}

std::string subject_of(const X509* certificate) {
  std::array<char, 200> buffer{};
  X509_NAME_oneline(X509_get_subject_name(certificate), buffer.data(), buffer.size());
  return buffer.data();
}

std::string why_not_valid(X509_STORE_CTX* verification) {
  auto error = X509_STORE_CTX_get_error(verification);
  auto* certificate = X509_STORE_CTX_get_current_cert(verification);
  switch (error) {
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return "is not signed by our CA";
    default:
      break;
  }
  if (X509_STORE_CTX_get_error_depth(verification) == 0)
    return issue(error, certificate);
  return "is signed by " + subject_of(certificate) + ", whose own certificate " +
         issue(error, certificate);
}

} // namespace castor
