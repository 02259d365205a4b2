#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "shortage.h"

namespace cellcrush {

/// A refused call, start or write. The message is for the user; the kind decides the gRPC status.
class ServiceError : public std::runtime_error {
 public:
  enum class Kind {
    invalid,              ///< an argument is invalid
    not_found,            ///< nothing has this name
    already_exists,       ///< the name or id is already in use
    failed_precondition,  ///< the state does not allow it
    aborted,              ///< another caller came before
    out_of_range,         ///< past the end
    storage_full,         ///< no room on the disk or in a quota
    exhausted,            ///< beyond a limit of this daemon
    unavailable,          ///< not now; retry later
    unauthenticated,      ///< the caller is unknown
    permission_denied,    ///< the caller may not do this
    cancelled,            ///< the caller no longer waits
    data_loss,            ///< stored data can no longer be read
    internal,             ///< a fault of this program or machine
  };

  ServiceError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// The kind that a shortage causes: storage_full for a full disk, otherwise unavailable.
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

/// An invalid field of a call. The message continues from the field's name: "is negative."
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
