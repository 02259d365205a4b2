#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::http {

/// What a link of access::Sessions asks for.
struct SignIn {
  std::string code;
  std::string page;  ///< relative to the root of the site
};

/// Nothing if the target of a request is not that of such a link.
std::optional<SignIn> read_sign_in(std::string_view target);

/// The session that a browser sends in the values of its Cookie headers; empty if none. All ports of a host share their
/// cookies, and tunnels even let servers of several machines share a port: the epoch of the data is part of the name.
std::string session_of(const std::vector<std::string>& cookies, const std::string& epoch);

/// The value of Set-Cookie that gives a browser a session, which pages of other sites and scripts cannot use.
/// `path`: of the page on its site, with a slash at its end.
std::string session_cookie(const std::string& session, const std::string& epoch, const std::string& path,
                           bool is_secure);

}  // namespace cellcrush::http
