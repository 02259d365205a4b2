#pragma once

#include <filesystem>
#include <string>

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

}  // namespace cellcrush::access
