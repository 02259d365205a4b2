#include "http/browser_rules.h"

#include <absl/strings/match.h>
#include <arpa/inet.h>

#include <algorithm>

namespace cellcrush::http {
namespace {

// "localhost", "[::1]" or an address of 127.0.0.0/8, with or without a port.
bool is_loopback(std::string_view host) {
  const auto colon = host.find(':', host.starts_with('[') ? std::min(host.find(']'), host.size()) : 0);
  if (colon != std::string_view::npos) {
    const std::string_view port = host.substr(colon + 1);
    if (port.empty() || port.find_first_not_of("0123456789") != std::string_view::npos) return false;
    host = host.substr(0, colon);
  }
  in_addr address{};
  return absl::EqualsIgnoreCase(std::string(host), "localhost") || host == "[::1]" ||
         (host.starts_with("127.") && inet_pton(AF_INET, std::string(host).c_str(), &address) == 1);
}

}  // namespace

std::optional<HttpRefusal> check_browser(const BrowserHeaders& headers, bool has_tls, const PublicUrl& public_url) {
  const bool is_public = !public_url.host.empty() && absl::EqualsIgnoreCase(std::string(headers.host), public_url.host);
  if (!has_tls && !is_public && !is_loopback(headers.host)) {
    return HttpRefusal{421,
                       "The Host header must be localhost, 127.0.0.1 or [::1], with any port. If a proxy or tunnel "
                       "passes another one, start cellcrushd with --public-url and the address that users open."};
  }
  const std::string own_origin = (has_tls ? "https://" : "http://") + std::string(headers.host);
  const bool is_own_origin =
      headers.origin.empty() || headers.origin == own_origin || headers.origin == public_url.origin;
  if (!is_own_origin || headers.fetch_site == "cross-site")
    return HttpRefusal{403,
                       "Pages of other sites may not call this server. cellcrushd's --public-url names the address of "
                       "the page behind a proxy, --allow-framing the sites that may show it in a frame."};
  return std::nullopt;
}

}  // namespace cellcrush::http
