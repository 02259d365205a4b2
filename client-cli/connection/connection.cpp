#include "connection/connection.h"

#include <fmt/format.h>

#include <utility>

#include "case_file/suggestion.h"
#include "connection/connection_failure.h"
#include "connection/nearest_name.h"

namespace cellcrush::client {

namespace {

constexpr std::chrono::milliseconds kHandshakePatience{600};
constexpr std::chrono::milliseconds kConnectPatience{900};
constexpr std::chrono::milliseconds kReasonPatience{200};

grpc::ChannelArguments channel_arguments() {
  grpc::ChannelArguments arguments;
  // The mesh of a large lattice arrives in one message.
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetMaxSendMessageSize(-1);
  // Connects directly, ignoring proxies in the environment.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 500);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  return arguments;
}

}  // namespace

Connection::Connection(std::string address, Credentials credentials)
    : address_(std::move(address)),
      credentials_(std::move(credentials)),
      channel_(open_channel(address_, credentials_, channel_arguments())),
      cases_(v1::Cases::NewStub(channel_)),
      jobs_(v1::Jobs::NewStub(channel_)),
      sweeps_(v1::Sweeps::NewStub(channel_)),
      admin_(v1::Admin::NewStub(channel_)) {}

v1::Cases::Stub& Connection::cases() {
  require_server();
  return *cases_;
}

v1::Jobs::Stub& Connection::jobs() {
  require_server();
  return *jobs_;
}

v1::Sweeps::Stub& Connection::sweeps() {
  require_server();
  return *sweeps_;
}

v1::Admin::Stub& Connection::admin() {
  require_server();
  return *admin_;
}

bool Connection::wait(std::chrono::milliseconds patience) {
  return channel_->WaitForConnected(std::chrono::system_clock::now() + patience);
}

CommandError Connection::error_about(const std::string& name, const grpc::Status& status) {
  CommandError error = error_of(status);
  if (error.code() != ExitCode::not_found || name.empty()) return error;
  return {error.code(), with_suggestion(error.message(), find_nearest_name(name, *cases_, *jobs_, *sweeps_))};
}

void Connection::check_request_size(std::int64_t size) {
  if (size <= kLargestRequest) return;
  constexpr double kMebibyte = 1024.0 * 1024.0;
  throw CommandError(
      ExitCode::refused,
      fmt::format("the request has {:.2f} MiB ({} bytes), above the message limit of {:.0f} MiB ({} bytes); make the "
                  "case smaller, such as a frame with fewer nodes and beams",
                  static_cast<double>(size) / kMebibyte, size, kLargestRequest / kMebibyte, kLargestRequest));
}

std::string Connection::last_failure() {
  // A call on a channel that cannot connect fails at once with the reason.
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kReasonPatience);
  v1::Capabilities response;
  return admin_->GetCapabilities(&context, v1::GetCapabilitiesRequest(), &response).error_message();
}

void Connection::require_server() {
  if (connected_) return;
  connected_ = wait(kHandshakePatience);
  if (connected_) return;
  // A server that refuses this client keeps refusing; one that does not answer may be starting.
  std::string reason = last_failure();
  if (may_still_answer(address_, reason)) {
    connected_ = wait(kConnectPatience);
    if (!connected_) reason = last_failure();
  }
  if (!connected_) throw CommandError(ExitCode::no_connection, connection_failure_text(address_, credentials_, reason));
}

}  // namespace cellcrush::client
