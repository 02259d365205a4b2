#pragma once

#include <optional>
#include <string_view>

#include "access/scope.h"

namespace cellcrush::access {

/// The scope that a method needs; nothing for one that is open to everybody. A method that is not in the table needs
/// admin. `path` is as gRPC has it: "/cellcrush.v1.Jobs/GetJob".
std::optional<Scope> needed_scope(std::string_view path);

/// Whether the table has it.
bool has_scope_entry(std::string_view path);

}  // namespace cellcrush::access
