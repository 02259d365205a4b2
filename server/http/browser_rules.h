#pragma once

#include <optional>
#include <string>
#include <string_view>

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

/// Refuses requests that a page of another site makes through the user's browser, on a loopback port. A foreign name
/// that resolves to loopback (DNS rebinding) gives 421, a foreign origin 403.
std::optional<HttpRefusal> check_browser(const BrowserHeaders& headers, int port);

}  // namespace cellcrush::http
