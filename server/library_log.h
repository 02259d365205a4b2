#pragma once

namespace cellcrush {

/// Sends what gRPC and protobuf log to the default logger, from the first call until the process ends: 10 lines a
/// second, those left out counted in a later one, and at most 500 bytes of each. A caller's bytes may stand in them.
/// Thread-safe.
void redirect_library_logs();

}  // namespace cellcrush
