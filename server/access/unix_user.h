#pragma once

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

/// Groups that the user database gives to the user; none for a user that it does not know.
std::vector<gid_t> groups_of_user(uid_t user);

/// Nothing if there is no group of this name.
std::optional<gid_t> find_group(const std::string& name);

}  // namespace cellcrush::access
