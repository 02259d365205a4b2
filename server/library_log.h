#pragma once

namespace cellcrush {

/// Routes the logs of gRPC and protobuf to the default logger until the process ends. At most 10 lines a second of 500
/// bytes each are logged, and a later line counts the omitted ones. Lines may contain bytes from a caller. Thread-safe.
void redirect_library_logs();

}  // namespace cellcrush
