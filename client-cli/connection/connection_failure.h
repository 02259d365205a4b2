#pragma once

#include <string>

#include "connection/credentials.h"

namespace cellcrush::client {

/// Says why there is no connection to a server, and what to do. `reason` is gRPC's own words; may be empty.
std::string connection_failure_text(const std::string& address, const Credentials& credentials,
                                    const std::string& reason);

/// Whether a server that could not be reached may still start: not one that was reached and ended the connection.
bool may_still_answer(const std::string& address, const std::string& reason);

}  // namespace cellcrush::client
