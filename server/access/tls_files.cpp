#include "access/tls_files.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>

#include "access/secret_file.h"

namespace cellcrush::access {
namespace {

struct FreeOpenssl {
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(X509* certificate) const { X509_free(certificate); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(char* text) const { OPENSSL_free(text); }
};
template <class Type>
using Owned = std::unique_ptr<Type, FreeOpenssl>;

// Nobody is asked for the password of a key.
int give_no_password(char*, int, int, void*) { return 0; }

Owned<BIO> reader_of(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

std::string time_text(const ASN1_TIME* time) {
  const Owned<BIO> bio(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(bio.get(), time);
  char* data = nullptr;
  const auto size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

// The first certificate of a text, which is valid now.
Owned<X509> check_certificate(const std::string& text, const std::string& option, const std::filesystem::path& path) {
  const auto reader = reader_of(text);
  Owned<X509> out(PEM_read_bio_X509(reader.get(), nullptr, give_no_password, nullptr));
  ERR_clear_error();
  if (!out) refuse_file(option, path, "holds no certificate in PEM (-----BEGIN CERTIFICATE-----).");
  const ASN1_TIME* begin = X509_get0_notBefore(out.get());
  const ASN1_TIME* end = X509_get0_notAfter(out.get());
  if (X509_cmp_current_time(end) < 0)
    refuse_file(option, path, "holds a certificate that expired on " + time_text(end) + ". Use a new one.");
  if (X509_cmp_current_time(begin) > 0)
    refuse_file(option, path, "holds a certificate that is not valid before " + time_text(begin) + ".");
  return out;
}

}  // namespace

TlsFiles read_tls_files(const std::filesystem::path& certificate, const std::filesystem::path& key,
                        const std::filesystem::path& client_authority) {
  TlsFiles out;
  out.certificate = read_named_file("--tls-cert", certificate, Secrecy::open);
  const auto of_server = check_certificate(out.certificate, "--tls-cert", certificate);
  out.key = read_named_file("--tls-key", key, Secrecy::secret);
  const auto reader = reader_of(out.key);
  const Owned<EVP_PKEY> of_key(PEM_read_bio_PrivateKey(reader.get(), nullptr, give_no_password, nullptr));
  const bool belongs = of_key && X509_check_private_key(of_server.get(), of_key.get()) == 1;
  ERR_clear_error();
  if (!of_key) refuse_file("--tls-key", key, "holds no private key in PEM, or one that needs a password.");
  if (!belongs) refuse_file("--tls-key", key, "is not the key of the certificate in " + certificate.string() + ".");
  if (!client_authority.empty()) {
    out.client_authority = read_named_file("--tls-client-ca", client_authority, Secrecy::open);
    check_certificate(out.client_authority, "--tls-client-ca", client_authority);
  }
  return out;
}

}  // namespace cellcrush::access
