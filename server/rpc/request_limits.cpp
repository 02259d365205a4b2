#include "rpc/request_limits.h"

#include "error.h"

namespace cellcrush::rpc {

void check_length(const std::string& field, const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return;
  throw InvalidField(field, "has " + std::to_string(text.size()) + " bytes.",
                     "Use at most " + std::to_string(longest) + ".");
}

}  // namespace cellcrush::rpc
