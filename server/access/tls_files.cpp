#include "access/tls_files.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <memory>
#include <utility>
#include <vector>

#include "access/secret_file.h"

namespace cellcrush::access {
namespace {

struct FreeOpenssl {
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(X509* certificate) const { X509_free(certificate); }
};
template <class Type>
using Owned = std::unique_ptr<Type, FreeOpenssl>;

Owned<BIO> reader_of(std::string_view text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

// Never asks for a password.
int give_no_password(char*, int, int, void*) { return 0; }

// The output of `print`.
template <class Print>
std::string printed(const Print& print) {
  const Owned<BIO> bio(BIO_new(BIO_s_mem()));
  print(bio.get());
  char* data = nullptr;
  const auto size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string time_text(const ASN1_TIME* time) {
  return printed([time](BIO* bio) { ASN1_TIME_print(bio, time); });
}

// "CN=server, O=Example, valid until Nov 23 09:00:00 2027 GMT".
std::string describe(const X509& certificate) {
  const std::string subject = printed([&certificate](BIO* bio) {
    X509_NAME_print_ex(bio, X509_get_subject_name(&certificate), 0,
                       XN_FLAG_ONELINE & ~XN_FLAG_SPC_EQ & ~ASN1_STRFLGS_ESC_MSB);
  });
  return subject + ", valid until " + time_text(X509_get0_notAfter(&certificate));
}

// Every certificate in a PEM text, in order. Empty when one of them cannot be read.
std::vector<Owned<X509>> read_certificates(std::string_view pem) {
  std::vector<Owned<X509>> out;
  const auto bio = reader_of(pem);
  while (X509* next = PEM_read_bio_X509(bio.get(), nullptr, give_no_password, nullptr)) out.emplace_back(next);
  const bool is_at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  if (!is_at_end) out.clear();
  return out;
}

// The first certificate of a text; must be valid now.
Owned<X509> check_certificate(const std::string& text, const std::string& option, const std::filesystem::path& path) {
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
  const Owned<EVP_PKEY> of_key(PEM_read_bio_PrivateKey(reader_of(out.key).get(), nullptr, give_no_password, nullptr));
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

bool is_for_clients(const X509& certificate) {
  // OpenSSL caches properties of a certificate in it.
  auto* const read = const_cast<X509*>(&certificate);
  return (X509_get_extension_flags(read) & EXFLAG_XKUSAGE) != 0 &&
         (X509_get_extended_key_usage(read) & XKU_SSL_CLIENT) != 0;
}

bool is_for_clients(std::string_view pem) {
  const auto certificates = read_certificates(pem);
  return !certificates.empty() && is_for_clients(*certificates.front());
}

}  // namespace cellcrush::access
