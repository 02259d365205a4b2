#pragma once

#include <string>

namespace cellcrush::client {

/// Name of an executor other than the server's machine; empty for that machine, and from servers without executors.
inline std::string executor_text(const std::string& executor) { return executor == "local" ? "" : executor; }

}  // namespace cellcrush::client
