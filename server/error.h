#pragma once

#include <stdexcept>
#include <string>

namespace cellcrush {

/// A call, a start or a write that is refused. The message is for the user; the kind decides the gRPC status.
class ServiceError : public std::runtime_error {
 public:
  enum class Kind {
    invalid,              ///< an argument cannot be right
    not_found,            ///< nothing has that name
    already_exists,       ///< the name or id stands for something else
    failed_precondition,  ///< not in the state that this needs
    out_of_range,         ///< past the end of what there is
    unimplemented,        ///< meaningful, but not built
    storage_full,         ///< the disk or a quota has no room left
    internal,             ///< a fault of this program or this machine
  };

  ServiceError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}

  [[nodiscard]] Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace cellcrush
