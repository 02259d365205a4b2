#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "shortage.h"

namespace cellcrush {

/// A call, a start or a write that is refused. The message is for the user; the kind decides the gRPC status.
class ServiceError : public std::runtime_error {
 public:
  enum class Kind {
    invalid,              ///< an argument cannot be right
    not_found,            ///< nothing has that name
    already_exists,       ///< the name or id stands for something else
    failed_precondition,  ///< not in the state that this needs
    out_of_range,         ///< past the end
    storage_full,         ///< the disk or a quota has no room left
    exhausted,            ///< beyond a limit of this daemon
    unavailable,          ///< not now; later again
    unauthenticated,      ///< nobody knows who calls
    permission_denied,    ///< the caller may not do this
    cancelled,            ///< the caller does not wait any more
    data_loss,            ///< something stored cannot be read any more
    internal,             ///< a fault of this program or this machine
  };

  ServiceError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// What a shortage makes fail: storage_full where the disk is full, otherwise unavailable.
  ServiceError(Shortage shortage, const std::string& message)
      : std::runtime_error(message),
        kind_(shortage == Shortage::full_disk ? Kind::storage_full : Kind::unavailable),
        shortage_(shortage) {}

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] Shortage shortage() const { return shortage_; }

 private:
  Kind kind_;
  Shortage shortage_ = Shortage::none;
};

/// A field of a call that cannot be right. The message goes on from the field's name: "is negative."
class InvalidField : public std::runtime_error {
 public:
  InvalidField(std::string field, std::string message, std::string remedy)
      : std::runtime_error(field + " " + message + " " + remedy),
        field_(std::move(field)),
        message_(std::move(message)),
        remedy_(std::move(remedy)) {}

  [[nodiscard]] const std::string& field() const { return field_; }
  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] const std::string& remedy() const { return remedy_; }

 private:
  std::string field_;
  std::string message_;
  std::string remedy_;
};

}  // namespace cellcrush
