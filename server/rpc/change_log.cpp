#include "rpc/change_log.h"

#include <fmt/format.h>

#include "log_format.h"

namespace cellcrush::rpc {
namespace {

// Quotes a caller's text, so that it cannot be mistaken for the rest of the line.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') out.push_back('\\');
    if (character >= ' ' && character <= '~') {
      out.push_back(character);
    } else {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(character));
    }
  }
  return out + "\"";
}

}  // namespace

void log_change(const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id) {
  const std::string subject = name.empty() ? "the daemon" : name;
  const std::string request = request_id.empty() ? "" : ", request " + quoted(request_id);
  const bool is_sweep = name.starts_with("sweeps/");
  log_with_fields(spdlog::level::info, subject + " " + done + " by " + caller + request,
                  {{is_sweep ? "sweep" : "job", name}, {"caller", caller}, {"request", request_id}});
}

}  // namespace cellcrush::rpc
