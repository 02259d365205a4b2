#include "access/certificate.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

namespace cellcrush::access {
namespace {

struct FreeBio {
  void operator()(BIO* bio) const { BIO_free(bio); }
};
using Bio = std::unique_ptr<BIO, FreeBio>;

// Never asks for a password.
int refuse_password(char*, int, int, void*) { return 0; }

// The output of `print`.
template <class Print>
std::string printed(const Print& print) {
  const Bio bio(BIO_new(BIO_s_mem()));
  print(bio.get());
  char* data = nullptr;
  const auto size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

}  // namespace

std::vector<Certificate> read_certificates(std::string_view pem) {
  std::vector<Certificate> out;
  const Bio bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  while (X509* next = PEM_read_bio_X509(bio.get(), nullptr, refuse_password, nullptr)) out.emplace_back(next);
  const bool is_at_end = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
  ERR_clear_error();
  if (!is_at_end) out.clear();
  return out;
}

std::string time_text(const ASN1_TIME* time) {
  return printed([time](BIO* bio) { ASN1_TIME_print(bio, time); });
}

std::string describe(const X509& certificate) {
  const std::string subject = printed([&certificate](BIO* bio) {
    X509_NAME_print_ex(bio, X509_get_subject_name(&certificate), 0,
                       XN_FLAG_ONELINE & ~XN_FLAG_SPC_EQ & ~ASN1_STRFLGS_ESC_MSB);
  });
  return subject + ", valid until " + time_text(X509_get0_notAfter(&certificate));
}

bool is_for_clients(const X509& certificate) {
  // OpenSSL caches properties of a certificate in it.
  auto* const read = const_cast<X509*>(&certificate);
  return (X509_get_extension_flags(read) & EXFLAG_XKUSAGE) != 0 &&
         (X509_get_extended_key_usage(read) & XKU_SSL_CLIENT) != 0;
}

}  // namespace cellcrush::access
