#include "commands/creation.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <thread>

namespace cellcrush::client {
namespace {

using Clock = std::chrono::steady_clock;

// For the repetitions of a call that took all its time.
constexpr std::chrono::seconds kForRepetitions{10};

// Whether the server may have done what it was asked: the status is gRPC's, of a broken connection or a proxy. Those of
// the server have details.
bool is_lost(const grpc::Status& status) {
  const ExitCode code = exit_code_of(status.error_code());
  return (code == ExitCode::no_connection || code == ExitCode::cut_off) && status.error_details().empty();
}

// A word as a shell reads it.
std::string quoted(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](unsigned char character) {
    return std::isalnum(character) != 0 ||
           std::string_view("_-./:=,+@%").find(static_cast<char>(character)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string out = "'";
  for (const char character : word) out += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return out + "'";
}

std::string command_to_repeat(const Session& session, const std::string& id) {
  std::string out = "cellcrush";
  bool has_id = false;
  for (const std::string& word : session.words) {
    out += ' ' + quoted(word);
    has_id = has_id || word.starts_with("--request-id");
  }
  return has_id ? out : out + " --request-id " + id;
}

}  // namespace

std::string new_request_id() {
  std::random_device random;
  std::string out = "cli-";
  for (int i = 0; i < 4; ++i) out += fmt::format("{:08x}", random());
  return out;
}

void call_until_answered(Session& session, const std::string& id, std::chrono::seconds patience,
                         const std::function<grpc::Status(grpc::ClientContext&)>& call) {
  Connection& connection = session.connection();
  const auto end = Clock::now() + patience + kForRepetitions;
  for (std::size_t attempt = 0;; ++attempt) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    grpc::ClientContext context;
    connection.prepare(context, std::clamp<std::chrono::milliseconds>(left, std::chrono::seconds(1), patience));
    const grpc::Status status = call(context);
    if (status.ok()) return;
    if (!is_lost(status)) throw error_of(status);
    if (attempt == kPauses.size() || Clock::now() + kPauses[attempt] >= end) {
      throw CommandError(
          ExitCode::cut_off,
          fmt::format("the answer was lost ({}), so it is not known whether the server has queued this. To ask again, "
                      "and to queue it once at most, run: {}",
                      status.error_message(), command_to_repeat(session, id)));
    }
    std::this_thread::sleep_for(kPauses[attempt]);
  }
}

}  // namespace cellcrush::client
