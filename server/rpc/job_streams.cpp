// The calls of Jobs that send files and frames in parts.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "jobs/resource_name.h"
#include "rpc/error_table.h"
#include "rpc/jobs_service.h"
#include "rpc/result_frame.h"
#include "store/result_reader.h"
#include "watch/frame_chunks.h"

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kDownloadChunk = 512 * 1024;

// A file open for reading that closes itself.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path)
      : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) fail();
    size_ = status.st_size;
  }
  ~InputFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] std::int64_t size() const { return size_; }

  // Up to `most` bytes from `offset` on; fewer only at the end.
  [[nodiscard]] std::string read(std::int64_t offset, std::size_t most) const {
    std::string out(std::min(most, static_cast<std::size_t>(size_ - offset)), '\0');
    std::size_t done = 0;
    while (done < out.size()) {
      const auto count =
          pread(descriptor_, out.data() + done, out.size() - done, offset + static_cast<std::int64_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail();
      done += static_cast<std::size_t>(count);
    }
    return out;
  }

 private:
  [[noreturn]] void fail() const {
    throw ServiceError(ServiceError::Kind::internal,
                       path_.string() + " cannot be read: " + std::generic_category().message(errno) + ".");
  }

  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;
};

}  // namespace

v1::FieldFrame JobsService::find_frame(const store::StoredJob& stored, const v1::GetFrameRequest& request) {
  if ((request.has_strain() && !std::isfinite(request.strain())) ||
      (request.has_time_s() && !std::isfinite(request.time_s())))
    throw ServiceError(ServiceError::Kind::invalid,
                       "The strain or time of the frame is not a number. Use a finite one.");
  if (stored.job.has_summary())
    return read_frame(store::ResultReader(parts_.folder.job_folder(stored.number).result()), request);
  const auto channel = parts_.hub.find(stored.number);
  const auto frame = channel ? channel->newest().frame : nullptr;
  if (!frame) {
    throw ServiceError(
        ServiceError::Kind::failed_precondition,
        stored.job.name() + " is " + v1::JobState_Name(stored.job.state()) +
            " and has no frame. A running job has its newest one; one that SUCCEEDED, or was cancelled or failed "
            "while it ran, has all.");
  }
  return *frame;
}

grpc::Status JobsService::GetFrame(grpc::ServerContext*, const v1::GetFrameRequest* request,
                                   grpc::ServerWriter<v1::GetFrameResponse>* writer) {
  return answer([&] {
    const auto stored = find(request->name());
    auto mesh = parts_.reader.mesh(stored.number);
    const std::size_t chunk_bytes = watch::chunk_bytes_beside(mesh ? mesh->ByteSizeLong() : 0);
    for (auto& chunk : watch::chunks_of(find_frame(stored, *request), chunk_bytes)) {
      v1::GetFrameResponse response;
      if (mesh) *response.mutable_mesh() = *std::exchange(mesh, std::nullopt);
      *response.mutable_chunk() = std::move(chunk);
      if (!writer->Write(response)) return grpc::Status::CANCELLED;
    }
    return grpc::Status::OK;
  });
}

grpc::Status JobsService::DownloadResult(grpc::ServerContext*, const v1::DownloadResultRequest* request,
                                         grpc::ServerWriter<v1::DownloadResultResponse>* writer) {
  return answer([&] {
    const auto stored = find(request->name());
    if (!stored.job.has_summary()) {
      throw ServiceError(
          ServiceError::Kind::failed_precondition,
          stored.job.name() + " is " + v1::JobState_Name(stored.job.state()) +
              " and has no result. A job has one once it has SUCCEEDED, or was cancelled or failed while "
              "it ran.");
    }
    if (request->offset() < 0) return invalid_argument("offset", "is negative.", "Use 0 for the whole file.");
    const InputFile file(parts_.folder.job_folder(stored.number).result());
    if (request->offset() > file.size()) {
      throw ServiceError(ServiceError::Kind::out_of_range, "offset is " + std::to_string(request->offset()) +
                                                               ", but the file has " + std::to_string(file.size()) +
                                                               " bytes.");
    }
    // At least one message, so that the size is told even when nothing is left.
    std::int64_t offset = request->offset();
    do {
      v1::DownloadResultResponse response;
      response.set_offset(offset);
      response.set_total_size(file.size());
      response.set_data(file.read(offset, kDownloadChunk));
      offset += static_cast<std::int64_t>(response.data().size());
      if (!writer->Write(response)) return grpc::Status::CANCELLED;
    } while (offset < file.size());
    return grpc::Status::OK;
  });
}

}  // namespace cellcrush::rpc
