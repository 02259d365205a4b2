#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace cellcrush::access {

/// Name of the Unix user, as a caller has it: "uid1000" for one without a name, or with one that no caller may have.
std::string name_of_user(uid_t user);

/// Name of the user that runs this process.
const std::string& own_user();

/// The user at the other end of a connection on a Unix socket or between two loopback addresses, as the kernel says;
/// nothing if it does not say: the other end is on another machine, or was closed.
std::optional<uid_t> user_of_peer(int connection);

/// The user who has opened the socket at the peer's end of a connection of TCP within this machine, as the tables
/// /proc/net/tcp and tcp6 show it; nothing if they do not show it, or only as closed. Reads all connections.
std::optional<uid_t> user_in_socket_tables(const sockaddr_storage& own, const sockaddr_storage& peer);

/// Groups that the user database gives to the user; none for a user that it does not know.
std::vector<gid_t> groups_of_user(uid_t user);

/// Nothing if there is no group of this name.
std::optional<gid_t> find_group(const std::string& name);

}  // namespace cellcrush::access
