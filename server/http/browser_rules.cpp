#include "http/browser_rules.h"

#include <algorithm>
#include <array>

namespace cellcrush::http {

std::optional<HttpRefusal> check_browser(const BrowserHeaders& headers, const HttpPort& port) {
  constexpr std::array<std::string_view, 3> kNames = {"localhost", "127.0.0.1", "[::1]"};
  const std::string suffix = ":" + std::to_string(port.number);
  const bool is_own_host = std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return headers.host == std::string(name) + suffix || (port.number == 80 && headers.host == name);
  });
  if (!port.has_tls && !is_own_host)
    return HttpRefusal{421,
                       "The Host header must be localhost, 127.0.0.1 or [::1], with port " + suffix.substr(1) + "."};
  const std::string own_origin = (port.has_tls ? "https://" : "http://") + std::string(headers.host);
  const bool is_own_origin = headers.origin.empty() || headers.origin == own_origin;
  if (!is_own_origin || headers.fetch_site == "cross-site")
    return HttpRefusal{403,
                       "Pages of other sites may not call this server. cellcrushd's --allow-framing names those that "
                       "may show its page in a frame."};
  return std::nullopt;
}

}  // namespace cellcrush::http
