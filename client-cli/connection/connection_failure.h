#pragma once

#include <string>

#include "connection/credentials.h"

namespace cellcrush::client {

/// Explains why the connection failed and what to do. `reason` is gRPC's message; may be empty.
std::string connection_failure_text(const std::string& address, const Credentials& credentials,
                                    const std::string& reason);

/// Whether a server that could not be reached may still be starting: not if it was reached and closed the connection.
bool may_still_answer(const std::string& address, const std::string& reason);

}  // namespace cellcrush::client
