#include "access/scope.h"

#include <algorithm>

namespace cellcrush::access {

std::string name_of(Scope scope) {
  switch (scope) {
    case Scope::read: return "read";
    case Scope::submit: return "submit";
    case Scope::admin: break;
  }
  return "admin";
}

std::optional<Scope> parse_scope(std::string_view name) {
  for (const Scope scope : {Scope::read, Scope::submit, Scope::admin}) {
    if (name == name_of(scope)) return scope;
  }
  return std::nullopt;
}

bool is_caller_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  const auto belongs = [](char character) {
    return character > ' ' && character <= '~' && character != '"' && character != '\\' && character != '#';
  };
  return !name.empty() && name.size() <= kLongest && name != kLocal && std::all_of(name.begin(), name.end(), belongs);
}

}  // namespace cellcrush::access
