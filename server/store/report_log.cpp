#include "store/report_log.h"

#include <fcntl.h>
#include <google/protobuf/io/coded_stream.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>

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

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace

ReportLog::ReportLog(const std::filesystem::path& path)
    : path_(path), file_(open_own(path, O_WRONLY | O_CREAT | O_APPEND)) {
  ReportLogReader reader(path);
  worker::Report report;
  while (reader.read(report) == ReportLogReader::Read::message) continue;
  cut(reader.offset());
}

void ReportLog::cut(std::uint64_t size) {
  if (ftruncate(file_.get(), static_cast<off_t>(size)) != 0) throw_file_error(path_, "written", errno);
  size_ = size;
}

void ReportLog::append(const worker::Report& report) {
  const std::string message = report.SerializeAsString();
  std::string record;
  record.reserve(kHead + message.size());
  append_number(record, static_cast<std::uint32_t>(message.size()));
  append_number(record, checksum_of(message));
  record += message;
  try {
    write_all(file_, path_, record);
  } catch (const ServiceError&) {
    cut(size_);
    throw;
  }
  size_ += record.size();
}

void ReportLog::synchronize() {
  if (fdatasync(file_.get()) != 0) throw_file_error(path_, "written", errno);
}

bool ReportLogReader::is_so_long(std::size_t size) const {
  struct stat status {};
  return fstat(file_.get(), &status) == 0 && static_cast<std::uint64_t>(status.st_size) >= offset_ + size;
}

bool ReportLogReader::fill(std::size_t size) {
  if (available_.size() >= size) return true;
  // A damaged length may be a GiB; no memory is allocated beyond the size of the file.
  if (size > kReadAhead && !is_so_long(size)) return false;
  if (buffer_.size() < size) buffer_.resize(std::max(size, kReadAhead));
  std::size_t end = 0;
  while (end < size) {
    const auto count =
        pread(file_.get(), buffer_.data() + end, buffer_.size() - end, static_cast<off_t>(offset_ + end));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    end += static_cast<std::size_t>(count);
  }
  available_ = {buffer_.data(), end};
  return true;
}

// The incomplete record may be truncated and rewritten.
ReportLogReader::Read ReportLogReader::nothing_whole() {
  available_ = {};
  return Read::end;
}

ReportLogReader::Read ReportLogReader::next_record(std::string_view& record) {
  if (!fill(kHead)) return nothing_whole();
  const std::uint32_t size = number_at(available_.data());
  if (size > kLargest) return Read::broken;
  // No report is empty; zeros stand where a network file system or a power loss has left a hole.
  if (size == 0 || !fill(kHead + size)) return nothing_whole();
  record = available_.substr(0, kHead + size);
  return checksum_of(record.substr(kHead)) == number_at(record.data() + 4) ? Read::message : Read::broken;
}

ReportLogReader::Read ReportLogReader::read(worker::Report& report) {
  std::string_view record;
  const Read out = next_record(record);
  if (out != Read::message) return out;
  if (!report.ParseFromArray(record.data() + kHead, static_cast<int>(record.size() - kHead))) return Read::broken;
  pass(record.size());
  return Read::message;
}

bool ReportLogReader::read_record(std::string& bytes) {
  std::string_view record;
  if (next_record(record) != Read::message) {
    nothing_whole();
    return false;
  }
  bytes += record;
  pass(record.size());
  return true;
}

// Those of samples have a second field.
bool ReportLogReader::is_one_message(std::size_t size) {
  constexpr std::size_t kMostLength = 10;  // of a number as protobuf writes it
  if (!fill(kHead + 1 + kMostLength)) return false;
  google::protobuf::io::CodedInputStream in(reinterpret_cast<const std::uint8_t*>(available_.data()) + kHead + 1,
                                            kMostLength);
  std::uint32_t length = 0;
  return in.ReadVarint32(&length) && kHead + 1 + static_cast<std::size_t>(in.CurrentPosition()) + length == size;
}

// A record begins with the number of what it reports.
ReportLogReader::Read ReportLogReader::read_sample(v1::Sample& sample) {
  constexpr char kTag = (worker::Report::kSampleFieldNumber << 3U) | 2U;
  while (true) {
    if (!fill(kHead + 1)) return nothing_whole();
    const std::size_t size = kHead + number_at(available_.data());
    if (size == kHead || available_[kHead] == kTag) break;
    if (size > kHead + kLargest) return Read::broken;
    if (!is_so_long(size)) return nothing_whole();
    // A damaged sample may begin like another report.
    if (size <= kReadAhead) {
      std::string_view record;
      if (const Read out = next_record(record); out != Read::message) return out;
    } else if (!is_one_message(size)) {
      return Read::broken;
    }
    pass(size);
  }
  worker::Report report;
  const Read out = read(report);
  if (out == Read::message) sample = std::move(*report.mutable_sample());
  return out;
}

void ReportLogReader::pass(std::size_t size) {
  offset_ += size;
  available_.remove_prefix(std::min(size, available_.size()));
}

}  // namespace cellcrush::store
