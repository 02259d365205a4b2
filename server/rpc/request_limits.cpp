#include "rpc/request_limits.h"

#include "error.h"

namespace cellcrush::rpc {

void check_size(const std::string& field, std::size_t bytes, std::size_t largest) {
  if (bytes <= largest) return;
  throw InvalidField(field, "has " + std::to_string(bytes) + " bytes.", "Use at most " + std::to_string(largest) + ".");
}

void check_length(const std::string& field, const std::string& text, std::size_t longest) {
  check_size(field, text.size(), longest);
}

void check_epoch(const store::Epoch& epoch, const std::string& given) {
  if (given.empty() || given == epoch.id) return;
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "The after_sequence comes" + epoch.of_before() +
          ": its number may now belong to a different event. Watch again without after_sequence and epoch.");
}

}  // namespace cellcrush::rpc
