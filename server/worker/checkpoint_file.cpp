#include "worker/checkpoint_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "revision.h"
#include "store/case_hash.h"
#include "store/durable_file.h"
#include "store/report_log.h"
#include "translate/case_to_spec.h"
#include "worker/piece_file.h"

namespace cellcrush::worker {
namespace {

// "CELLCRUSH CHECKPOINT 2 CRC-32 SIZE\n", then a Checkpoint of that many bytes. Its simulation may exceed what protobuf
// can hold, so it is written and found without it.
constexpr std::string_view kTitle = "CELLCRUSH CHECKPOINT 2";
constexpr std::size_t kLongestHead = 80;
constexpr std::size_t kLargestBeside = std::size_t{1} << 20;  // of a checkpoint without its simulation

// What CRC-32 and size of bytes come to.
struct Sum {
  uLong crc = 0;
  std::uint64_t size = 0;

  void add(std::string_view bytes) {
    // Of a null pointer, zlib gives the sum of nothing.
    if (bytes.empty()) return;
    crc = crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    size += bytes.size();
  }
  [[nodiscard]] std::string head() const { return fmt::format("{} {} {}\n", kTitle, crc, size); }
};

constexpr std::uint64_t kKeyOfSimulation = (Checkpoint::kSimulationFieldNumber << 3U) | 2U;

void append_varint(std::string& bytes, std::uint64_t value) {
  for (; value > 0x7F; value >>= 7U) bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  bytes += static_cast<char>(value);
}

std::optional<std::uint64_t> read_varint(PieceReader& file) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    char byte = 0;
    if (!file.read(&byte, 1)) return std::nullopt;
    value |= (static_cast<std::uint64_t>(byte) & 0x7FU) << shift;
    if ((static_cast<unsigned char>(byte) & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

// Where the simulation's bytes are.
struct Range {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;
};

// A checkpoint from here to the end of the file: the simulation is found, all else is appended to `beside`. False if it
// is malformed.
bool read_fields(PieceReader& file, Range& simulation, std::string& beside) {
  while (file.left() > 0 && beside.size() < kLargestBeside) {
    const auto key = read_varint(file);
    const std::uint64_t wire_type = key.value_or(7) & 7U;
    std::uint64_t size = sizeof(std::uint64_t);
    if (wire_type == 0 || wire_type == 2) {
      const auto value = read_varint(file);
      if (!value) return false;
      size = wire_type == 2 ? *value : 0;
      if (key == kKeyOfSimulation) {
        simulation = {file.place(), size};
        if (size > file.left()) return false;
        file.go_to(file.place() + size);
        continue;
      }
      append_varint(beside, *key);
      append_varint(beside, *value);
    } else if (wire_type == 1) {
      append_varint(beside, *key);
    } else {
      return false;
    }
    if (size > kLargestBeside) return false;
    const std::size_t before = beside.size();
    beside.resize(before + size);
    if (!file.read(beside.data() + before, size)) return false;
  }
  return file.left() == 0;
}

// Whether the rest of the file has the sum that its first line says.
bool has_sum(PieceReader& file, const std::string& head) {
  Sum sum;
  while (file.left() > 0) sum.add(file.next(file.left()));
  return head == sum.head();
}

// The checkpoint in a file, or why it cannot be used.
void read(const std::filesystem::path& path, const Checkpoint::Origin& wanted, FoundCheckpoint& out) {
  const std::string name = path.filename().string();
  const auto file = std::make_shared<PieceReader>(path);
  std::string head;
  for (char c = 0; head.size() < kLongestHead && c != '\n' && file->read(&c, 1);) head += c;
  const std::uint64_t begin = file->place();
  const bool is_sound = has_sum(*file, head);
  Range simulation;
  std::string beside;
  Checkpoint checkpoint;
  file->go_to(begin);
  if (head.empty()) {
    out.refused.push_back(name + " is empty.");
  } else if (!is_sound || !read_fields(*file, simulation, beside) || !checkpoint.ParseFromString(beside)) {
    out.refused.push_back(name + " is damaged.");
  } else if (checkpoint.origin().SerializeAsString() != wanted.SerializeAsString()) {
    out.refused.push_back(name + " was written by solver " + checkpoint.origin().solver_revision() + " with " +
                          checkpoint.origin().simd_target() + ", but this is solver " + wanted.solver_revision() +
                          " with " + wanted.simd_target() + ".");
  } else {
    file->go_to(simulation.begin);
    out.simulation = {simulation.size, [file](char* to, std::size_t size) { return file->read(to, size); }};
    out.checkpoint = std::move(checkpoint);
  }
}

}  // namespace

std::shared_ptr<const Scene> scene_of(const Order& order) {
  const auto reading = translate::to_spec(order.case_());
  auto built = build_scene(reading.spec);
  Problems problems = reading.problems;
  problems.insert(problems.end(), built.problems.begin(), built.problems.end());
  // The daemon has checked the case, so this is an old job that the present version rejects.
  if (!problems.empty()) {
    throw std::runtime_error("this version no longer accepts the case: " + problems.front().field + ": " +
                             problems.front().message);
  }
  return built.scene;
}

Checkpoint::Origin origin_of(const Order& order) {
  Checkpoint::Origin out;
  out.set_solver_revision(kSolverIdentity);
  out.set_simd_target(simd_target());
  out.set_case_hash(store::hash_of(order.case_()));
  return out;
}

std::optional<Checkpoint::Origin> find_other_origin(const store::JobFolder& folder, const Checkpoint::Origin& origin) {
  store::ReportLogReader reader(folder.reports());
  const std::string own = origin.SerializeAsString();
  Report report;
  while (reader.read(report) == store::ReportLogReader::Read::message) {
    if (report.has_begun() && report.begun().origin().SerializeAsString() != own) return report.begun().origin();
  }
  return std::nullopt;
}

void write_checkpoint(const store::JobFolder& folder, const Checkpoint& checkpoint, const SimulationBytes& simulation) {
  std::uint64_t size = 0;
  simulation([&](std::string_view bytes) { size += bytes.size(); });
  std::string beside = checkpoint.SerializeAsString();
  append_varint(beside, kKeyOfSimulation);
  append_varint(beside, size);
  Sum sum;
  sum.add(beside);
  simulation([&](std::string_view bytes) { sum.add(bytes); });
  PieceWriter file(folder.partial_checkpoint());
  file.write(sum.head());
  file.write(beside);
  simulation([&](std::string_view bytes) { file.write(bytes); });
  file.close();
  static_cast<void>(store::rename_own(folder.checkpoint(), folder.previous_checkpoint()));
  store::publish_file(folder.partial_checkpoint(), folder.checkpoint());
}

FoundCheckpoint find_checkpoint(const store::JobFolder& folder, const Checkpoint::Origin& origin) {
  FoundCheckpoint out;
  for (const auto& path : {folder.checkpoint(), folder.previous_checkpoint()}) {
    if (!store::find_own(path)) continue;
    if (!store::is_own_file(path)) {
      out.refused.push_back(path.filename().string() + " is not a regular file.");
      continue;
    }
    read(path, origin, out);
    if (out.checkpoint) return out;
  }
  return out;
}

translate::RunTime run_time_of(const Checkpoint& checkpoint) {
  translate::RunTime out;
  out.processor = checkpoint.processor_seconds();
  std::copy_n(checkpoint.stage_seconds().begin(), std::min(kStageCount, checkpoint.stage_seconds_size()),
              out.stages.begin());
  return out;
}

}  // namespace cellcrush::worker
