#include "slurm/network_link.h"

#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <type_traits>
#include <utility>

#include "error.h"
#include "slurm/small_file.h"

namespace cellcrush::slurm {
namespace {

constexpr std::chrono::seconds kForACall{30};
// A task that finds no daemon looks after its worker again soon.
constexpr std::chrono::seconds kForAContact{5};
constexpr std::size_t kPartOfCall = std::size_t{1} << 20;

std::uint32_t checksum_after(std::uint32_t before, const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

bool is_this_machine(const std::string& address) {
  for (const char* begin : {"127.", "localhost:", "[::1]:"}) {
    if (address.rfind(begin, 0) == 0) return true;
  }
  return false;
}

}  // namespace

std::shared_ptr<grpc::Channel> open_channel(const NetworkAddress& address) {
  grpc::ChannelArguments arguments;
  // Soon after the daemon is back.
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 500);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 5'000);
  if (address.authority.empty() && is_this_machine(address.daemon))
    return grpc::CreateCustomChannel(address.daemon, grpc::InsecureChannelCredentials(), arguments);
  grpc::SslCredentialsOptions options;
  if (!address.authority.empty()) {
    const auto authority = read_small_file(address.authority);
    if (!authority)
      throw ServiceError(ServiceError::Kind::invalid, address.authority + ", the setting ca of --slurm, is missing.");
    options.pem_root_certs = *authority;
  }
  return grpc::CreateCustomChannel(address.daemon, grpc::SslCredentials(options), arguments);
}

NetworkLink::NetworkLink(const std::shared_ptr<grpc::Channel>& channel, const std::string& cluster,
                         const std::string& attempt, std::string token)
    : stub_(Workers::NewStub(channel)), token_(std::move(token)) {
  name_.set_cluster(cluster);
  name_.set_attempt(attempt);
}

template <typename Request, typename Response>
Response NetworkLink::call(Method<Request, Response> method, const Request& request) {
  grpc::ClientContext context;
  const bool is_contact = std::is_same_v<Request, ContactRequest>;
  context.set_deadline(std::chrono::system_clock::now() + (is_contact ? kForAContact : kForACall));
  // A channel connects only while a call waits for it.
  context.set_wait_for_ready(true);
  context.AddMetadata("authorization", "Bearer " + token_);
  Response out;
  const grpc::Status status = ((*stub_).*method)(&context, request, &out);
  if (status.ok()) return out;
  const bool is_over = status.error_code() == grpc::StatusCode::PERMISSION_DENIED;
  throw ServiceError(is_over ? ServiceError::Kind::permission_denied : ServiceError::Kind::unavailable,
                     "The daemon cannot be reached: " + status.error_message());
}

bool NetworkLink::claim(const Claim& claim) {
  ClaimAttemptRequest request;
  *request.mutable_name() = name_;
  *request.mutable_claim() = claim;
  try {
    return call(&Workers::Stub::ClaimAttempt, request).taken();
  } catch (const ServiceError& error) {
    if (error.kind() == ServiceError::Kind::permission_denied) return false;
    throw;
  }
}

void NetworkLink::fetch(const store::JobFolder& to) {
  for (const auto& path : {to.order(), to.reports(), to.checkpoint(), to.previous_checkpoint()}) {
    std::string content;
    ReadFileRequest request;
    *request.mutable_name() = name_;
    request.set_file(path.filename().string());
    bool exists = false;
    for (bool more = true; more;) {
      request.set_offset(static_cast<std::int64_t>(content.size()));
      const auto part = call(&Workers::Stub::ReadFile, request);
      exists = part.exists();
      more = !part.bytes().empty();
      content += part.bytes();
    }
    if (exists) write_small_file(path, content);
  }
}

void NetworkLink::beat(std::uint64_t number) {
  ContactRequest request;
  *request.mutable_name() = name_;
  request.set_beat(number);
  static_cast<void>(call(&Workers::Stub::Contact, request));
}

Request::Kind NetworkLink::requested() {
  ContactRequest request;
  *request.mutable_name() = name_;
  try {
    return call(&Workers::Stub::Contact, request).request();
  } catch (const ServiceError& error) {
    if (error.kind() == ServiceError::Kind::permission_denied) return Request::ABANDON;
    throw;
  }
}

void NetworkLink::write_reports(std::uint64_t offset, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size(); done += kPartOfCall)
    write_file("reports", static_cast<std::int64_t>(offset + done), bytes.substr(done, kPartOfCall));
}

void NetworkLink::put_checkpoint(const std::string& bytes) {
  const std::uint32_t checksum = checksum_after(0, bytes);
  for (std::size_t done = 0; done < bytes.size(); done += kPartOfCall) {
    const bool is_last = done + kPartOfCall >= bytes.size();
    write_file("checkpoint", static_cast<std::int64_t>(done), bytes.substr(done, kPartOfCall),
               is_last ? std::optional(checksum) : std::nullopt);
  }
}

void NetworkLink::put_result(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(file));
  std::uint32_t checksum = 0;
  for (std::int64_t done = 0; done < size;) {
    std::string part(std::min<std::size_t>(kPartOfCall, static_cast<std::size_t>(size - done)), '\0');
    if (!input.read(part.data(), static_cast<std::streamsize>(part.size())))
      throw ServiceError(ServiceError::Kind::internal, file.string() + " cannot be read.");
    checksum = checksum_after(checksum, part);
    const auto end = done + static_cast<std::int64_t>(part.size());
    write_file("result.h5", done, std::move(part), end == size ? std::optional(checksum) : std::nullopt);
    done = end;
  }
}

void NetworkLink::write_file(const std::string& file, std::int64_t offset, std::string bytes,
                             std::optional<std::uint32_t> checksum) {
  WriteFileRequest request;
  *request.mutable_name() = name_;
  request.set_file(file);
  request.set_offset(offset);
  request.set_bytes(std::move(bytes));
  request.set_last(checksum.has_value());
  request.set_checksum(checksum.value_or(0));
  static_cast<void>(call(&Workers::Stub::WriteFile, request));
}

void NetworkLink::end(const Ended& ended) {
  EndAttemptRequest request;
  *request.mutable_name() = name_;
  *request.mutable_ended() = ended;
  static_cast<void>(call(&Workers::Stub::EndAttempt, request));
}

}  // namespace cellcrush::slurm
