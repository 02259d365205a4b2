#include "slurm/workers_service.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "error.h"
#include "slurm/file_link.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

constexpr std::size_t kPartOfFile = std::size_t{1} << 20;

// Names that cannot lead out of a folder.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::string bearer_of(const grpc::CallbackServerContext& context) {
  constexpr std::string_view kBearer = "Bearer ";
  const auto [first, last] = context.client_metadata().equal_range("authorization");
  if (first == last || std::next(first) != last) return "";
  const std::string_view value(first->second.data(), first->second.size());
  return value.substr(0, kBearer.size()) == kBearer ? std::string(value.substr(kBearer.size())) : "";
}

[[noreturn]] void refuse_file(const std::string& file) {
  throw ServiceError(ServiceError::Kind::invalid, "file '" + file + "' is not one that a task reads or writes.");
}

std::filesystem::path readable_file(const store::JobFolder& files, const std::string& file) {
  for (const auto& path : {files.order(), files.reports(), files.checkpoint(), files.previous_checkpoint()}) {
    if (path.filename() == file) return path;
  }
  refuse_file(file);
}

std::uint64_t bytes_of(const std::filesystem::path& path) {
  std::error_code error;
  const auto out = std::filesystem::file_size(path, error);
  return error ? 0 : out;
}

// Parts follow each other; the first begins the file again.
void write_part(const std::filesystem::path& path, std::int64_t offset, const std::string& bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | (offset == 0 ? O_TRUNC : 0) | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(path, "written", errno);
  const auto written = pwrite(file, bytes.data(), bytes.size(), offset);
  const int error = written == static_cast<ssize_t>(bytes.size()) ? 0 : (written < 0 ? errno : ENOSPC);
  close(file);
  if (error != 0) store::throw_file_error(path, "written", error);
}

std::uint32_t checksum_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string part(kPartOfFile, '\0');
  auto out = crc32(0, nullptr, 0);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0)
    out = crc32_z(out, reinterpret_cast<const unsigned char*>(part.data()), static_cast<std::size_t>(file.gcount()));
  return static_cast<std::uint32_t>(out);
}

}  // namespace

AttemptFolder WorkersService::admit(const grpc::CallbackServerContext& context, const AttemptName& name) const {
  if (is_plain_name(name.cluster()) && is_plain_name(name.attempt())) {
    AttemptFolder out(root_ / name.cluster() / "attempts" / name.attempt());
    const auto token = out.token();
    const std::string given = bearer_of(context);
    if (token && token->size() == given.size() && CRYPTO_memcmp(token->data(), given.data(), given.size()) == 0)
      return out;
  }
  throw ServiceError(ServiceError::Kind::permission_denied,
                     "This token is not that of an open attempt. The task should end.");
}

grpc::ServerUnaryReactor* WorkersService::ClaimAttempt(grpc::CallbackServerContext* context,
                                                       const ClaimAttemptRequest* request,
                                                       ClaimAttemptResponse* response) {
  return calls_.run(*context, *request, [=, this] {
    const auto folder = admit(*context, request->name());
    if (request->claim().withdrawn()) throw ServiceError(ServiceError::Kind::invalid, "withdrawn is for the daemon.");
    bool taken = folder.claim(request->claim());
    // The answer to an earlier call may have been lost.
    if (const auto found = taken ? std::nullopt : folder.find_claim())
      taken = found->SerializeAsString() == request->claim().SerializeAsString();
    response->set_taken(taken);
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* WorkersService::ReadFile(grpc::CallbackServerContext* context, const ReadFileRequest* request,
                                                   ReadFileResponse* response) {
  return calls_.run(*context, *request, [=, this] {
    const auto path = readable_file(admit(*context, request->name()).files(), request->file());
    if (!std::filesystem::exists(path)) return grpc::Status::OK;
    response->set_exists(true);
    const int file = store::open_to_read(path);
    std::string bytes(kPartOfFile, '\0');
    const auto count = pread(file, bytes.data(), bytes.size(), request->offset());
    const int error = errno;
    close(file);
    if (count < 0) store::throw_file_error(path, "read", error);
    bytes.resize(static_cast<std::size_t>(count));
    response->set_bytes(std::move(bytes));
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* WorkersService::Contact(grpc::CallbackServerContext* context, const ContactRequest* request,
                                                  ContactResponse* response) {
  return calls_.run(*context, *request, [=, this] {
    const auto folder = admit(*context, request->name());
    if (request->beat() != 0) folder.beat(request->beat());
    response->set_request(folder.requested());
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* WorkersService::WriteFile(grpc::CallbackServerContext* context,
                                                    const WriteFileRequest* request, WriteFileResponse*) {
  return calls_.run(*context, *request, [=, this] {
    const auto files = admit(*context, request->name()).files();
    if (request->bytes().size() > kPartOfFile) refuse_file(request->file());
    FolderSink sink(files);
    const MutexLock lock(uploads_);
    const bool is_report = request->file() == files.reports().filename();
    const bool is_result = request->file() == files.result().filename();
    if (!is_report && !is_result && request->file() != files.checkpoint().filename()) refuse_file(request->file());
    const std::filesystem::path partial = (is_result ? files.result() : files.checkpoint()).string() + ".upload";
    // No holes: a file grows by what was sent.
    const auto size = static_cast<std::int64_t>(bytes_of(is_report ? files.reports() : partial));
    if (request->offset() < 0 || request->offset() > size) {
      throw ServiceError(ServiceError::Kind::out_of_range, request->file() + " has " + std::to_string(size) +
                                                               " bytes; nothing can be written at offset " +
                                                               std::to_string(request->offset()) + ".");
    }
    if (is_report) {
      sink.write_reports(static_cast<std::uint64_t>(request->offset()), request->bytes());
      return grpc::Status::OK;
    }
    write_part(partial, request->offset(), request->bytes());
    if (!request->last()) return grpc::Status::OK;
    if (checksum_of_file(partial) != request->checksum())
      throw ServiceError(ServiceError::Kind::unavailable, request->file() + " arrived damaged. Send it again.");
    if (is_result) {
      store::publish_file(partial, files.result());
    } else {
      sink.put_checkpoint(read_small_file(partial).value_or(""));
    }
    return grpc::Status::OK;
  });
}

grpc::ServerUnaryReactor* WorkersService::EndAttempt(grpc::CallbackServerContext* context,
                                                     const EndAttemptRequest* request, EndAttemptResponse*) {
  return calls_.run(*context, *request, [=, this] {
    admit(*context, request->name()).end(request->ended());
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::slurm
