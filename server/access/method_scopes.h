#pragma once

#include <optional>
#include <string_view>

#include "access/scope.h"

namespace cellcrush::access {

/// The scope that a method requires; nothing if everybody may call it. An unlisted method requires admin. `path` has
/// gRPC's form: "/cellcrush.v1.Jobs/GetJob".
std::optional<Scope> needed_scope(std::string_view path);

/// Whether the table lists the method.
bool has_scope_entry(std::string_view path);

}  // namespace cellcrush::access
