// Any bytes as what a worker that was killed, or a bad disk, leaves in a job's folder: its reports, its checkpoint and
// its claim. The first byte chooses which; with its highest bit the bytes get a sound head with their length and
// checksum, so that what is in them is read. Nothing may crash, hang, or take more memory than the file has bytes; a
// log that was read to its end can be continued.
//
// Left out: what core makes of a checkpoint's bytes. It has the form of one build and is read by no other, behind a
// checksum.
#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "error.h"
#include "fuzz/prepared_folder.h"
#include "programs/temporary_folder.h"
#include "store/report_log.h"
#include "worker/checkpoint_file.h"
#include "worker/claim.h"

namespace cellcrush::fuzz {
namespace {

std::uint32_t checksum_of(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
}

std::string as_record(const std::string& bytes) {
  std::string out;
  for (const std::uint32_t number : {static_cast<std::uint32_t>(bytes.size()), checksum_of(bytes)}) {
    for (unsigned i = 0; i < 4; ++i) out.push_back(static_cast<char>((number >> (8U * i)) & 0xFFU));
  }
  return out + bytes;
}

std::string as_checkpoint(const std::string& bytes) {
  return "CELLCRUSH CHECKPOINT 2 " + std::to_string(checksum_of(bytes)) + " " + std::to_string(bytes.size()) + "\n" +
         bytes;
}

int count_reports(const std::filesystem::path& path) {
  store::ReportLogReader reader(path);
  worker::Report report;
  int out = 0;
  while (reader.read(report) == store::ReportLogReader::Read::message) ++out;
  if (reader.offset() > std::filesystem::file_size(path)) std::abort();
  return out;
}

void read_reports(const store::JobFolder& folder) {
  const int before = count_reports(folder.reports());
  worker::Report report;
  report.mutable_stopping();
  store::ReportLog(folder.reports()).append(report);
  if (count_reports(folder.reports()) != before + 1) {
    std::fprintf(stderr, "a log that was mended cannot be continued\n");
    std::abort();
  }
}

void read_checkpoint(const store::JobFolder& folder) {
  static_cast<void>(worker::find_checkpoint(folder, worker::Checkpoint::Origin()));
}

}  // namespace
}  // namespace cellcrush::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcrush;
  static const testing::TemporaryFolder place;
  static const store::JobFolder folder(place.path());
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const bool is_sound = data[0] >= 128;
  switch (data[0] % 3U) {
    case 0:
      fuzz::write_file(folder.reports(), is_sound ? fuzz::as_record(bytes) + bytes : bytes);
      fuzz::read_reports(folder);
      break;
    case 1:
      fuzz::write_file(folder.checkpoint(), is_sound ? fuzz::as_checkpoint(bytes) : bytes);
      fuzz::read_checkpoint(folder);
      break;
    default: fuzz::write_file(folder.claim(), bytes); static_cast<void>(worker::find_claim(folder));
  }
  return 0;
}
