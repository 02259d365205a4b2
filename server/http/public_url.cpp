#include "http/public_url.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace cellcrush::http {

PublicUrl parse_public_url(std::string_view text) {
  if (text.empty()) return {};
  constexpr std::string_view kOfHost = "abcdefghijklmnopqrstuvwxyz0123456789.-:[]";
  const std::size_t scheme = text.starts_with("https://") ? 8 : text.starts_with("http://") ? 7 : 0;
  const std::size_t end = std::min(text.find('/', scheme), text.size());
  const std::string_view host = text.substr(scheme, end - scheme);
  std::string_view path = text.substr(end);
  const bool is_url = scheme > 0 && !host.empty() && host.find_first_not_of(kOfHost) == std::string_view::npos &&
                      path.find_first_of("?#\\ \"<>") == std::string_view::npos &&
                      path.find("//") == std::string_view::npos;
  if (!is_url) {
    throw ServiceError(ServiceError::Kind::invalid,
                       fmt::format("\"{}\" is not the address of a page. Write it as https://HOST/PATH/, "
                                   "with the host in lower case.",
                                   text));
  }
  while (path.ends_with('/')) path.remove_suffix(1);
  return {std::string(text.substr(0, end)), std::string(host), std::string(path)};
}

AskedPath find_asked_path(std::string_view target, const PublicUrl& public_url) {
  const std::string_view path = target.substr(0, target.find('?'));
  const std::string_view prefix = public_url.path;
  const bool has_prefix =
      !prefix.empty() && path.starts_with(prefix) && (path.size() == prefix.size() || path[prefix.size()] == '/');
  if (has_prefix && path.size() == prefix.size())
    return {"/" + std::string(target.substr(path.size())), std::string(prefix.substr(prefix.rfind('/') + 1)) + "/"};
  const std::string_view below = has_prefix ? path.substr(prefix.size()) : path;
  const auto slashes = std::count(below.begin(), below.end(), '/');
  std::string root = slashes <= 1 ? "./" : "";
  for (auto i = slashes; i > 1; --i) root += "../";
  return {std::string(has_prefix ? target.substr(prefix.size()) : target), std::move(root)};
}

}  // namespace cellcrush::http
