#pragma once

#include <openssl/x509.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellcrush::access {

/// Files for TLS, as PEM.
struct TlsFiles {
  std::string certificate;       ///< certificate chain of the server
  std::string key;               ///< private key of the certificate
  std::string client_authority;  ///< signs client certificates; empty: no client certificates
  std::string description;       ///< for the log: file, subject and expiry of each certificate
};

/// Reads and checks the files named by --tls-cert, --tls-key and --tls-client-ca; the last may be empty. Throws
/// ServiceError (invalid), naming the option and the file. Causes: a file is unreadable or not PEM, the certificate has
/// expired or is not yet valid, the key does not match, has a password or can be read by others.
TlsFiles read_tls_files(const std::filesystem::path& certificate, const std::filesystem::path& key,
                        const std::filesystem::path& client_authority);

/// Whether the extended key usage includes clientAuth; false for a certificate without an extended key usage. TLS
/// refuses a certificate that excludes clients, but accepts one without that extension, as a server's may be.
bool is_for_clients(const X509& certificate);

/// The same for the first certificate of a PEM text; false if it cannot be read. Takes 0.2 ms, as much as a short call.
bool is_for_clients(std::string_view pem);

}  // namespace cellcrush::access
