#pragma once

#include <filesystem>
#include <string>

namespace cellcrush::access {

/// What TLS takes, as PEM.
struct TlsFiles {
  std::string certificate;       ///< the server's, and what leads from it to its authority
  std::string key;               ///< of the certificate
  std::string client_authority;  ///< who signs clients' certificates; empty: clients show none
  std::string description;       ///< of the certificates, for the log: their files, subjects and ends
};

/// Reads and checks what --tls-cert, --tls-key and --tls-client-ca name; the last may be empty. Throws ServiceError
/// (invalid), which names the option and the file: it cannot be read or is not PEM, the certificate has expired or is
/// not valid yet, the key is that of another one, needs a password, or can be read by others.
TlsFiles read_tls_files(const std::filesystem::path& certificate, const std::filesystem::path& key,
                        const std::filesystem::path& client_authority);

}  // namespace cellcrush::access
