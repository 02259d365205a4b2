#include "store/report_log.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>

#include "store/durable_file.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kHead = 8;
constexpr std::uint32_t kLargest = 1U << 30U;
constexpr std::size_t kReadAhead = 65536;

void append_number(std::string& bytes, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((value >> (8U * i)) & 0xFFU));
}

std::uint32_t number_at(const char* bytes) {
  std::uint32_t out = 0;
  for (unsigned i = 0; i < 4; ++i) out |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8U * i);
  return out;
}

std::uint32_t checksum_of(const char* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const unsigned char*>(bytes), size));
}

}  // namespace

ReportLog::ReportLog(const std::filesystem::path& path)
    : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600)) {
  if (file_ < 0) throw_file_error(path, "written", errno);
  ReportLogReader reader(path);
  worker::Report report;
  while (reader.read(report) == ReportLogReader::Read::message) continue;
  cut(reader.offset());
}

ReportLog::~ReportLog() {
  if (file_ >= 0) close(file_);
}

void ReportLog::cut(std::uint64_t size) {
  if (ftruncate(file_, static_cast<off_t>(size)) != 0) throw_file_error(path_, "written", errno);
  size_ = size;
}

void ReportLog::append(const worker::Report& report) {
  const std::string message = report.SerializeAsString();
  std::string record;
  record.reserve(kHead + message.size());
  append_number(record, static_cast<std::uint32_t>(message.size()));
  append_number(record, checksum_of(message.data(), message.size()));
  record += message;
  for (std::size_t done = 0; done < record.size();) {
    const auto written = write(file_, record.data() + done, record.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      cut(size_);
      throw_file_error(path_, "written", error);
    }
    done += static_cast<std::size_t>(written);
  }
  size_ += record.size();
}

void ReportLog::synchronize() {
  if (fdatasync(file_) != 0) throw_file_error(path_, "written", errno);
}

ReportLogReader::ReportLogReader(const std::filesystem::path& path) : file_(open_to_read(path)) {}

ReportLogReader::~ReportLogReader() { close(file_); }

bool ReportLogReader::is_so_long(std::size_t size) const {
  struct stat status {};
  return fstat(file_, &status) == 0 && static_cast<std::uint64_t>(status.st_size) >= offset_ + size;
}

// Makes this many bytes of the record available. The buffer never shrinks, since resizing would fill it with zeros.
bool ReportLogReader::fill(std::size_t size) {
  while (end_ - taken_ < size) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(taken_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= taken_;
    taken_ = 0;
    if (buffer_.size() < std::max(size, kReadAhead)) {
      // A damaged length may be a GiB; no memory is allocated beyond the size of the file.
      if (size > kReadAhead && !is_so_long(size)) return false;
      buffer_.resize(std::max(size, kReadAhead));
    }
    const auto count = pread(file_, buffer_.data() + end_, buffer_.size() - end_, static_cast<off_t>(offset_ + end_));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    end_ += static_cast<std::size_t>(count);
  }
  return true;
}

// The incomplete record may be truncated and rewritten.
ReportLogReader::Read ReportLogReader::nothing_whole() {
  taken_ = 0;
  end_ = 0;
  return Read::end;
}

ReportLogReader::Read ReportLogReader::next_record(std::uint32_t& size) {
  if (!fill(kHead)) return nothing_whole();
  size = number_at(buffer_.data() + taken_);
  if (size > kLargest) return Read::broken;
  // No report is empty; zeros stand where a network file system or a power loss has left a hole.
  if (size == 0) return nothing_whole();
  if (!fill(kHead + size)) return nothing_whole();
  const char* record = buffer_.data() + taken_;
  return checksum_of(record + kHead, size) == number_at(record + 4) ? Read::message : Read::broken;
}

ReportLogReader::Read ReportLogReader::read(worker::Report& report) {
  std::uint32_t size = 0;
  const Read out = next_record(size);
  if (out != Read::message) return out;
  if (!report.ParseFromArray(buffer_.data() + taken_ + kHead, static_cast<int>(size))) return Read::broken;
  pass(size);
  return Read::message;
}

bool ReportLogReader::read_record(std::string& bytes) {
  std::uint32_t size = 0;
  if (next_record(size) != Read::message) {
    nothing_whole();
    return false;
  }
  bytes.append(buffer_, taken_, kHead + size);
  pass(size);
  return true;
}

// A record begins with the number of what it reports.
ReportLogReader::Read ReportLogReader::read_sample(v1::Sample& sample) {
  constexpr char kTag = (worker::Report::kSampleFieldNumber << 3U) | 2U;
  worker::Report report;
  while (true) {
    if (!fill(kHead + 1)) return nothing_whole();
    const std::uint32_t size = number_at(buffer_.data() + taken_);
    if (size > 0 && buffer_[taken_ + kHead] != kTag) {
      if (size > kLargest) return Read::broken;
      if (!is_so_long(kHead + size)) return nothing_whole();
      pass(size);
      continue;
    }
    const Read out = read(report);
    if (out == Read::message) sample = std::move(*report.mutable_sample());
    return out;
  }
}

void ReportLogReader::pass(std::size_t size) {
  offset_ += kHead + size;
  taken_ = std::min(taken_ + kHead + size, end_);
}

}  // namespace cellcrush::store
