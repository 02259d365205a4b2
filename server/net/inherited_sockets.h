#pragma once

#include <string>

namespace cellcrush::net {

/// A descriptor of its own for the listening Unix socket at the path that systemd has opened for this process and keeps
/// (sd_listen_fds(3)); -1 without one. Throws ServiceError (failed_precondition) if there are no descriptors left.
int inherited_unix_socket(const std::string& path);

}  // namespace cellcrush::net
