#include "connection/connection.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"
#include "columns/result_columns.h"
#include "connection/credentials.h"
#include "usage/suggestion.h"

namespace cellcrush::client {
namespace {

constexpr std::string_view kPreset = "preset:";
bool has_part(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

std::string host_of(const std::string& address) { return address.substr(0, address.rfind(':')); }

bool is_socket(const std::string& address) { return address.starts_with("unix:"); }

// There was no connection that could have ended.
bool was_not_reached(const std::string& reason) {
  for (const char* part : {"Connection refused", "No route to host", "unreachable", "timed out", "Timeout", "DNS"}) {
    if (has_part(reason, part)) return true;
  }
  return reason.empty() || has_part(reason, "Deadline");
}

std::string tls_failure_text(const std::string& address, const std::string& reason) {
  if (has_part(reason, "certificate verify failed") || has_part(reason, "CERTIFICATE_VERIFY_FAILED")) {
    return "the certificate of the server at " + address +
           " has expired or is not signed by the authority of --tls-ca; name the authority that signed it, or renew "
           "the certificate";
  }
  if (has_part(reason, "Peer name") || has_part(reason, "Hostname")) {
    return "the certificate of the server at " + address + " is not valid for " + host_of(address) +
           "; give --server a host name that the certificate lists";
  }
  if (has_part(reason, "wrong version number") || has_part(reason, "WRONG_VERSION_NUMBER")) {
    return "the server at " + address + " does not use TLS; leave out --tls-ca and CELLCRUSH_TLS_CA";
  }
  return "the server at " + address +
         " closed the connection; if it requires a client certificate, give one signed by its authority with "
         "--tls-cert and --tls-key";
}

// Whether a server that could not be reached may still be starting: not if it was reached and closed the connection.
bool may_still_answer(const std::string& address, const std::string& reason) {
  return is_socket(address) || was_not_reached(reason);
}

// Explains why the connection failed and what to do. `reason` is gRPC's message; may be empty.
std::string connection_failure_text(const std::string& address, const Credentials& credentials,
                                    const std::string& reason) {
  std::error_code error;
  if (!may_still_answer(address, reason)) {
    if (credentials.tls) return tls_failure_text(address, reason);
    return "the server at " + address +
           " does not answer in plain text; if it uses TLS, name the authority of its certificate with --tls-ca";
  }
  std::string message = "no server answers at " + address;
  if (is_socket(address) && !std::filesystem::exists(address.substr(5), error)) message += " (no such socket)";
  return message + "; start cellcrushd, or name its address with --server";
}

constexpr std::chrono::milliseconds kHandshakePatience{600};
constexpr std::chrono::milliseconds kConnectPatience{900};
constexpr std::chrono::milliseconds kReasonPatience{200};
constexpr std::chrono::seconds kProbePatience{5};

std::shared_ptr<grpc::ChannelCredentials> channel_credentials(const Credentials& credentials) {
  if (!credentials.tls) return grpc::InsecureChannelCredentials();
  return grpc::SslCredentials({credentials.authority, credentials.key, credentials.certificate});
}

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
  // Tunnels and proxies cut what is silent for a minute, and a peer that vanished sends nothing.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  return arguments;
}

}  // namespace

Connection::Connection(ServerAddress address, Credentials credentials)
    : address_(std::move(address.text)),
      may_be_others_(address.may_be_others),
      credentials_(std::move(credentials)),
      channel_(grpc::experimental::CreateCustomChannelWithInterceptors(
          address_, channel_credentials(credentials_), channel_arguments(), ServerEpoch::interceptors_for(epoch_))),
      cases_(v1::Cases::NewStub(channel_)),
      jobs_(v1::Jobs::NewStub(channel_)),
      sweeps_(v1::Sweeps::NewStub(channel_)),
      admin_(v1::Admin::NewStub(channel_)) {}

bool Connection::wait(std::chrono::milliseconds patience) {
  return channel_->WaitForConnected(std::chrono::system_clock::now() + patience);
}

void Connection::prepare(grpc::ClientContext& context, std::chrono::milliseconds patience) const {
  if (!credentials_.token.empty()) context.AddMetadata("authorization", "Bearer " + credentials_.token);
  if (patience.count() > 0) context.set_deadline(std::chrono::system_clock::now() + patience);
}

CommandError Connection::error_about(const std::string& name, const grpc::Status& status) {
  CommandError error = error_of(status);
  if (error.code() != ExitCode::not_found || name.empty()) return error;
  return {error.code(), with_suggestion(error.message(), find_nearest_name(name))};
}

template <typename Stub, typename Request, typename Response>
bool Connection::probe(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                       const Request& request, Response& response) const {
  grpc::ClientContext context;
  prepare(context, kProbePatience);
  return (stub.*method)(&context, request, &response).ok();
}

std::string Connection::find_nearest_preset(const std::string& word) const {
  v1::ListPresetsResponse presets;
  if (!probe(*cases_, &v1::Cases::Stub::ListPresets, v1::ListPresetsRequest(), presets)) return {};
  std::vector<std::string> names;
  for (const v1::Preset& preset : presets.presets()) names.push_back(preset.name());
  const std::string nearest = find_nearest(word, names);
  return nearest.empty() ? nearest : std::string(kPreset) + nearest;
}

std::string Connection::find_nearest_name(const std::string& name) const {
  if (name.starts_with(kPreset)) return find_nearest_preset(name.substr(kPreset.size()));
  const std::string number = name.substr(name.find_last_not_of("0123456789") + 1);
  if (number.empty()) return find_nearest_preset(name.substr(name.rfind('/') + 1));
  std::vector<std::string> names;
  v1::GetJobRequest job;
  job.set_name("jobs/" + number);
  v1::Job found_job;
  if (probe(*jobs_, &v1::Jobs::Stub::GetJob, job, found_job)) names.push_back(job.name());
  v1::GetSweepRequest sweep;
  sweep.set_name("sweeps/" + number);
  v1::Sweep found_sweep;
  if (probe(*sweeps_, &v1::Sweeps::Stub::GetSweep, sweep, found_sweep)) names.push_back(sweep.name());
  return names.size() == 1 ? names.front() : find_nearest(name, names);
}

void Connection::check_request_size(std::int64_t size) {
  if (size <= kLargestRequest) return;
  constexpr double kMebibyte = 1024.0 * 1024.0;
  refuse(
      fmt::format("the request has {:.2f} MiB ({} bytes), above the message limit of {:.0f} MiB ({} bytes); make the "
                  "case smaller, such as a frame with fewer nodes and beams, or a network of numbers with at most six "
                  "decimals",
                  static_cast<double>(size) / kMebibyte, size, kLargestRequest / kMebibyte, kLargestRequest));
}

std::string Connection::last_failure() {
  // A call on a channel that cannot connect fails at once with the reason.
  grpc::ClientContext context;
  prepare(context, kReasonPatience);
  v1::Capabilities response;
  return admin_->GetCapabilities(&context, v1::GetCapabilitiesRequest(), &response).error_message();
}

void Connection::require_server() {
  if (connected_) return;
  connected_ = wait(kHandshakePatience);
  // A server that refuses this client keeps refusing; one that does not answer may be starting.
  std::string reason = connected_ ? "" : last_failure();
  if (!connected_ && may_still_answer(address_, reason)) {
    connected_ = wait(kConnectPatience);
    if (!connected_) reason = last_failure();
  }
  if (!connected_) throw CommandError(ExitCode::no_connection, connection_failure_text(address_, credentials_, reason));
  if (may_be_others_) find_owner();
}

void Connection::find_owner() {
  grpc::ClientContext context;
  prepare(context, kProbePatience);
  v1::WhoAmIResponse who;
  const auto status = admin_->WhoAmI(&context, v1::WhoAmIRequest(), &who);
  // A server that does not let this user in says so at the next call.
  if (status.error_code() == grpc::StatusCode::UNAUTHENTICATED ||
      status.error_code() == grpc::StatusCode::PERMISSION_DENIED)
    return;
  if (status.ok() && who.server_owner() == own_user()) return;
  owner_ = status.ok() ? who.server_owner() : "an unknown user";
  fmt::print(stderr, "cellcrush: using the server of {} at {}\n", owner_, address_);
}

void Connection::require_named(const google::protobuf::Descriptor& request) const {
  if (owner_.empty()) return;
  for (const char* reading : {"Get", "List", "Check", "Preview", "WhoAmI"}) {
    if (request.name().starts_with(reading)) return;
  }
  refuse(
      fmt::format("the server at {0} belongs to {1}, and is changed only if you name it: --server {0}. For a server of "
                  "your own, start cellcrushd",
                  address_, owner_));
}

v1::GetHistoryResponse fetch_history(Connection& connection, const std::string& job) {
  v1::GetHistoryRequest request;
  request.set_name(job);
  return call_for_pages(connection, connection.jobs(), &v1::Jobs::Stub::GetHistory, request);
}

v1::Job fetch_job(Connection& connection, const std::string& name) {
  return connection.call_for(name, connection.jobs(), &v1::Jobs::Stub::GetJob);
}

v1::Sweep fetch_sweep(Connection& connection, const std::string& name) {
  return connection.call_for(name, connection.sweeps(), &v1::Sweeps::Stub::GetSweep);
}

v1::SweepTable fetch_table(Connection& connection, const std::string& sweep) {
  v1::GetSweepTableRequest request;
  request.set_name(sweep);
  auto table = call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::GetSweepTable, request);
  if (std::ranges::find(table.fields(), kSeedField) == table.fields().end()) return table;
  request.set_mean_over_seeds(true);
  auto means = call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::GetSweepTable, request);
  table.mutable_means()->Swap(means.mutable_means());
  return table;
}

}  // namespace cellcrush::client
