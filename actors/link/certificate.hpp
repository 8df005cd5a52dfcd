#pragma once

#include <string>
#include <vector>

struct x509_st;
struct x509_store_ctx_st;

namespace castor {

/// The node names in a certificate: its DNS names, then its common name if that is another.
std::vector<std::string> names_in(const x509_st* certificate);

/// The certificate's subject with unprintable characters escaped, for messages.
std::string subject_of(const x509_st* certificate);

/// Why a certificate is not valid, as a clause that follows "the certificate": "expired on ...".
std::string why_not_valid(x509_store_ctx_st* verification);

} // namespace castor
