#include "web/exported_page.h"

#include <absl/strings/escaping.h>
#include <absl/strings/str_replace.h>
#include <openssl/sha.h>

#include <array>

#include "log_format.h"
#include "revision.h"
#include "web/page_files.h"
#include "zlib_bytes.h"

namespace cellcrush::web {
namespace {

std::string_view bytes_of_file(std::string_view path) {
  const PageFile* file = find_page_file(path);
  return file == nullptr ? std::string_view() : file->bytes;
}

// A source of a content policy that permits this inline script or style and no other.
std::string policy_hash(std::string_view text) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  return "'sha256-" + absl::Base64Escape({reinterpret_cast<const char*>(digest.data()), digest.size()}) + "'";
}

}  // namespace

std::string exported_head(std::string_view title) {
  const std::string_view script = bytes_of_file("/app.js");
  const std::string_view style = bytes_of_file("/app.css");
  std::string out =
      "<!doctype html>\n<!-- cellcrush export -->\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src " +
         policy_hash(script) + "; style-src " + policy_hash(style) +
         "; img-src data: blob:; media-src blob:; base-uri 'none'; form-action 'none'\">\n";
  out +=
      "<title>" + absl::StrReplaceAll(printable(title), {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}}) + "</title>\n";
  out +=
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n";
  out += "<meta name=\"generator\" content=\"cellcrush " + std::string(kVersion) + "\">\n";
  out += "<link rel=\"icon\" href=\"data:image/svg+xml;base64," +
         absl::Base64Escape(std::string(bytes_of_file("/icon.svg"))) + "\">\n";
  out.append("<style>").append(style).append("</style>\n");
  out.append("<script type=\"module\">").append(script).append("</script>\n");
  out += "</head>\n<body>\n<noscript>This page needs JavaScript, which the browser has switched off.</noscript>\n";
  return out;
}

std::string exported_block(std::string_view call, const google::protobuf::Message& message, Compression compression) {
  std::string bytes = message.SerializeAsString();
  const bool is_small = compression == Compression::zlib;
  if (is_small) bytes = zlib_of(bytes);
  std::string out = "<script type=\"application/x-protobuf\" data-call=\"" + std::string(call) + "\"";
  out += is_small ? " data-zlib>" : ">";
  return out.append(absl::Base64Escape(bytes)).append("</script>\n");
}

std::string_view exported_end() { return "</body>\n</html>\n"; }

}  // namespace cellcrush::web
