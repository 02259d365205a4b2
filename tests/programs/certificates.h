#pragma once

#include <filesystem>
#include <string>

#include "programs/temporary_folder.h"

namespace cellcrush::testing {

/// A certificate and its key, as PEM files in a folder.
struct CertificateFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/// What a certificate is to say.
struct CertificateRequest {
  std::string common_name = "server";
  std::string subject_names = "DNS:localhost,IP:127.0.0.1";  ///< empty: none
  long valid_from_seconds = -3600;                           ///< from now
  long valid_to_seconds = 3600;
  std::string extended_key_usage = {};  ///< "clientAuth", "serverAuth"; empty: none
};

/// One for a client of that name.
CertificateRequest client_request(const std::string& common_name);

/// An authority of the tests' own, that signs certificates. Its files are NAME.pem and NAME-key.pem.
class Authority {
 public:
  Authority(std::filesystem::path folder, const std::string& name);

  [[nodiscard]] const std::filesystem::path& certificate() const { return files_.certificate; }

  /// A certificate that this authority has signed, in files of that name.
  [[nodiscard]] CertificateFiles sign(const std::string& name, const CertificateRequest& request = {}) const;

 private:
  std::filesystem::path folder_;
  CertificateFiles files_;
};

/// Writes a file that its owner alone can read.
void write_secret(const std::filesystem::path& path, const std::string& text);

}  // namespace cellcrush::testing
