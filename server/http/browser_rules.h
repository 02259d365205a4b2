#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "http/public_url.h"

namespace cellcrush::http {

/// Headers by which a browser says for whom it asks. Empty: absent.
struct BrowserHeaders {
  std::string_view host;
  std::string_view origin;
  std::string_view fetch_site;  ///< Sec-Fetch-Site
};

struct HttpRefusal {
  unsigned status = 0;
  std::string why;
};

/// Refuses requests that a page of another site makes through the user's browser. A foreign origin gives 403. On a port
/// in plain text, which is on loopback, a foreign name that resolves to loopback (DNS rebinding) gives 421: the name
/// must be loopback's, with any port because of tunnels, or that of the public URL. With TLS the certificate has the
/// names.
std::optional<HttpRefusal> check_browser(const BrowserHeaders& headers, bool has_tls, const PublicUrl& public_url);

}  // namespace cellcrush::http
