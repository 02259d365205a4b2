#pragma once

#include <openssl/x509.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::access {

struct FreeCertificate {
  void operator()(X509* certificate) const { X509_free(certificate); }
};
using Certificate = std::unique_ptr<X509, FreeCertificate>;

/// Every certificate in a PEM text, in order. Empty when one of them cannot be read.
std::vector<Certificate> read_certificates(std::string_view pem);

/// "CN=server, O=Example, valid until Nov 23 09:00:00 2027 GMT".
std::string describe(const X509& certificate);

std::string time_text(const ASN1_TIME* time);

/// Whether the extended key usage includes clientAuth; false for a certificate without an extended key usage.
bool is_for_clients(const X509& certificate);

}  // namespace cellcrush::access
