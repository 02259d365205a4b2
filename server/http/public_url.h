#pragma once

#include <string>
#include <string_view>

namespace cellcrush::http {

/// The address under which users open the page where a proxy or tunnel stands before it. Empty: none is known.
struct PublicUrl {
  std::string origin;  ///< "https://site.example:8443"
  std::string host;    ///< "site.example:8443"
  std::string path;    ///< "/node/host/8080", without a slash at its end; empty for the top of the site
};

/// Reads "https://HOST[:PORT][/PATH]". Throws ServiceError (invalid) for anything else; nothing for an empty text.
PublicUrl parse_public_url(std::string_view text);

/// What is asked for by a request of a proxy that may pass the public path on.
struct AskedPath {
  std::string target;  ///< without the public path
  std::string root;    ///< of the page, relative to the address in the browser: "./", "../"
};
AskedPath find_asked_path(std::string_view target, const PublicUrl& public_url);

}  // namespace cellcrush::http
