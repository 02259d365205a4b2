#include "access/tls_files.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>

#include "access/certificate.h"
#include "access/secret_file.h"

namespace cellcrush::access {
namespace {

struct FreeOpenssl {
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
};
template <class Type>
using Owned = std::unique_ptr<Type, FreeOpenssl>;

// Never asks for the password of a key.
int give_no_password(char*, int, int, void*) { return 0; }

// The first certificate of a text; must be valid now.
Certificate check_certificate(const std::string& text, const std::string& option, const std::filesystem::path& path) {
  auto all = read_certificates(text);
  if (all.empty()) refuse_file(option, path, "contains no valid PEM certificate (-----BEGIN CERTIFICATE-----).");
  const ASN1_TIME* begin = X509_get0_notBefore(all.front().get());
  const ASN1_TIME* end = X509_get0_notAfter(all.front().get());
  if (X509_cmp_current_time(end) < 0)
    refuse_file(option, path, "contains a certificate that expired on " + time_text(end) + ". Renew it.");
  if (X509_cmp_current_time(begin) > 0)
    refuse_file(option, path, "contains a certificate that is not valid before " + time_text(begin) + ".");
  return std::move(all.front());
}

}  // namespace

TlsFiles read_tls_files(const std::filesystem::path& certificate, const std::filesystem::path& key,
                        const std::filesystem::path& client_authority) {
  TlsFiles out;
  out.certificate = read_named_file("--tls-cert", certificate, Secrecy::open);
  const auto of_server = check_certificate(out.certificate, "--tls-cert", certificate);
  out.description = "--tls-cert " + certificate.string() + ": " + describe(*of_server);
  out.key = read_named_file("--tls-key", key, Secrecy::secret);
  const Owned<BIO> reader(BIO_new_mem_buf(out.key.data(), static_cast<int>(out.key.size())));
  const Owned<EVP_PKEY> of_key(PEM_read_bio_PrivateKey(reader.get(), nullptr, give_no_password, nullptr));
  const bool belongs = of_key && X509_check_private_key(of_server.get(), of_key.get()) == 1;
  ERR_clear_error();
  if (!of_key) refuse_file("--tls-key", key, "contains no PEM private key, or one that is protected by a password.");
  if (!belongs) refuse_file("--tls-key", key, "does not match the certificate in " + certificate.string() + ".");
  if (!client_authority.empty()) {
    out.client_authority = read_named_file("--tls-client-ca", client_authority, Secrecy::open);
    const auto of_clients = check_certificate(out.client_authority, "--tls-client-ca", client_authority);
    out.description += "; --tls-client-ca " + client_authority.string() + ": " + describe(*of_clients);
  }
  return out;
}

}  // namespace cellcrush::access
