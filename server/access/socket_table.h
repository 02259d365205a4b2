#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <optional>

namespace cellcrush::access {

/// The user who has opened the socket at the peer's end of a connection of TCP within this machine, as the tables
/// /proc/net/tcp and tcp6 show it; nothing if they do not show it, or only as closed. Reads all connections.
std::optional<uid_t> user_in_socket_tables(const sockaddr_storage& own, const sockaddr_storage& peer);

}  // namespace cellcrush::access
