#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "access/gate.h"
#include "daemon_options.h"
#include "error.h"
#include "listen_address.h"

namespace cellcrush {

// What a daemon makes of its options before it opens a port or its data folder. All throw ServiceError (invalid) for
// options with which it does not start.

/// The options, once their device has been opened and closed: one that cannot be used is told now and not with every
/// job.
DaemonOptions with_device(DaemonOptions options);

/// The requested addresses, or the default ones.
std::vector<ListenAddress> listen_addresses(const DaemonOptions& options);

/// Those of Gate::credentials_for, in the same order.
std::vector<std::shared_ptr<grpc::ServerCredentials>> credentials_for(const access::Gate& gate,
                                                                      const std::vector<ListenAddress>& addresses);

/// Where to serve metrics. REQUIRES: not empty.
ListenAddress metrics_address(const std::string& text);

/// Where to serve HTTP; nothing for nowhere. Logs why a default address is left out.
std::optional<ListenAddress> http_address(const access::Gate& gate, const DaemonOptions& options);
void warn_without_http(const ServiceError& why);

/// All of these checks, and that of the executors. Returns what a daemon would do, a line each.
std::vector<std::string> check_options(const DaemonOptions& options);

}  // namespace cellcrush
