#include "programs/certificates.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

namespace cellcrush::testing {
namespace {

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using File = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

void require(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("OpenSSL cannot ") + what);
}

File open_file(const std::filesystem::path& path, const char* mode) {
  File out(std::fopen(path.c_str(), mode), &std::fclose);
  require(out != nullptr, "open a file");
  return out;
}

void add_extension(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  require(extension != nullptr && X509_add_ext(certificate, extension, -1) == 1, "add an extension");
  X509_EXTENSION_free(extension);
}

Certificate make_certificate(const CertificateRequest& request, EVP_PKEY* key, X509* issuer, EVP_PKEY* issuer_key) {
  static long serial = 1;
  Certificate out(X509_new(), &X509_free);
  X509_set_version(out.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(out.get()), ++serial);
  X509_gmtime_adj(X509_getm_notBefore(out.get()), request.valid_from_seconds);
  X509_gmtime_adj(X509_getm_notAfter(out.get()), request.valid_to_seconds);
  X509_NAME* name = X509_get_subject_name(out.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(request.common_name.c_str()), -1, -1, 0);
  X509_set_issuer_name(out.get(), issuer == nullptr ? name : X509_get_subject_name(issuer));
  X509_set_pubkey(out.get(), key);
  add_extension(out.get(), issuer == nullptr ? out.get() : issuer, NID_basic_constraints,
                issuer == nullptr ? "critical,CA:TRUE" : "critical,CA:FALSE");
  if (issuer != nullptr && !request.subject_names.empty())
    add_extension(out.get(), issuer, NID_subject_alt_name, request.subject_names);
  if (!request.extended_key_usage.empty())
    add_extension(out.get(), issuer, NID_ext_key_usage, request.extended_key_usage);
  require(X509_sign(out.get(), issuer_key, EVP_sha256()) > 0, "sign");
  return out;
}

CertificateFiles write_files(const std::filesystem::path& folder, const std::string& name, X509* certificate,
                             EVP_PKEY* key) {
  CertificateFiles out{folder / (name + ".pem"), folder / (name + "-key.pem")};
  require(PEM_write_X509(open_file(out.certificate, "w").get(), certificate) == 1, "write a certificate");
  write_secret(out.key, "");
  require(PEM_write_PrivateKey(open_file(out.key, "w").get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
          "write a key");
  return out;
}

Key make_key() {
  Key out(EVP_EC_gen("P-256"), &EVP_PKEY_free);
  require(out != nullptr, "make a key");
  return out;
}

}  // namespace

Authority::Authority(std::filesystem::path folder, const std::string& name) : folder_(std::move(folder)) {
  const Key key = make_key();
  CertificateRequest request;
  request.common_name = name;
  files_ = write_files(folder_, name, make_certificate(request, key.get(), nullptr, key.get()).get(), key.get());
}

CertificateFiles Authority::sign(const std::string& name, const CertificateRequest& request) const {
  const Certificate issuer(PEM_read_X509(open_file(files_.certificate, "r").get(), nullptr, nullptr, nullptr),
                           &X509_free);
  const Key issuer_key(PEM_read_PrivateKey(open_file(files_.key, "r").get(), nullptr, nullptr, nullptr),
                       &EVP_PKEY_free);
  const Key key = make_key();
  const Certificate made = make_certificate(request, key.get(), issuer.get(), issuer_key.get());
  return write_files(folder_, name, made.get(), key.get());
}

CertificateRequest client_request(const std::string& common_name) {
  CertificateRequest out;
  out.common_name = common_name;
  out.extended_key_usage = "clientAuth";
  return out;
}

void write_secret(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  chmod(path.c_str(), 0600);
}

}  // namespace cellcrush::testing
