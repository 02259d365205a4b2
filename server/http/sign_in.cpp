#include "http/sign_in.h"

#include <algorithm>
#include <chrono>

#include "access/sessions.h"
#include "store/resource_name.h"

namespace cellcrush::http {
namespace {

bool is_page(const std::string& text) { return store::number_of(text) || store::sweep_number_of(text); }

std::string cookie_name(const std::string& epoch) { return "cellcrush-" + epoch; }

// What follows "NAME=" in one of the fields between the separators; empty if none does.
std::string value_of(std::string_view fields, char separator, const std::string& name) {
  while (!fields.empty()) {
    std::string_view field = fields.substr(0, fields.find(separator));
    fields.remove_prefix(std::min(fields.size(), field.size() + 1));
    while (field.starts_with(' ')) field.remove_prefix(1);
    if (field.starts_with(name + "=")) return std::string(field.substr(name.size() + 1));
  }
  return {};
}

}  // namespace

std::optional<SignIn> read_sign_in(std::string_view target) {
  constexpr std::string_view kPath = "/sign-in?";
  if (!target.starts_with(kPath)) return std::nullopt;
  const std::string_view fields = target.substr(kPath.size());
  SignIn out{value_of(fields, '&', "code"), value_of(fields, '&', "page")};
  // A link leads to no other site.
  if (!is_page(out.page)) out.page.clear();
  return out;
}

std::string session_of(const std::vector<std::string>& cookies, const std::string& epoch) {
  for (const auto& header : cookies) {
    if (auto session = value_of(header, ';', cookie_name(epoch)); !session.empty()) return session;
  }
  return {};
}

std::string session_cookie(const std::string& session, const std::string& epoch, const std::string& path,
                           bool is_secure) {
  const auto age = std::chrono::duration_cast<std::chrono::seconds>(access::Sessions::kSessionLasts).count();
  return cookie_name(epoch) + "=" + session + "; Path=" + path + "; HttpOnly; SameSite=Strict; Max-Age=" +
         std::to_string(age) + (is_secure ? "; Secure" : "");
}

}  // namespace cellcrush::http
