#include "rpc/change_log.h"

#include <absl/strings/str_replace.h>

#include "log_format.h"

namespace cellcrush::rpc {

void log_change(const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id) {
  const std::string subject = name.empty() ? "the daemon" : name;
  // In quotes, so that it cannot be mistaken for the rest of the line; the form of the log escapes control characters.
  const std::string quoted = "\"" + absl::StrReplaceAll(request_id, {{"\"", "\\\""}, {"\\", "\\\\"}}) + "\"";
  const std::string request = request_id.empty() ? "" : ", request " + quoted;
  const bool is_sweep = name.starts_with("sweeps/");
  log_with_fields(spdlog::level::info, subject + " " + done + " by " + caller + request,
                  {{is_sweep ? "sweep" : "job", name}, {"caller", caller}, {"request", request_id}});
}

}  // namespace cellcrush::rpc
