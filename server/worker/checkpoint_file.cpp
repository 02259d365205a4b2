#include "worker/checkpoint_file.h"

#include <fcntl.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "revision.h"
#include "store/case_hash.h"
#include "store/durable_file.h"
#include "store/report_log.h"
#include "translate/case_to_spec.h"

namespace cellcrush::worker {
namespace {

// "CELLCRUSH CHECKPOINT 2 CRC-32 SIZE\n", then a Checkpoint of that many bytes.
constexpr const char* kTitle = "CELLCRUSH CHECKPOINT 2";

std::string head_of(const std::string& bytes) {
  const auto crc = crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return std::string(kTitle) + " " + std::to_string(crc) + " " + std::to_string(bytes.size());
}

void write_file(const std::filesystem::path& path, const std::string& head, const std::string& bytes) {
  OpenFile file = store::open_own(path, O_WRONLY | O_CREAT | O_TRUNC);
  for (const auto* part : {&head, &bytes}) store::write_all(file, path, *part);
  if (!file.close()) store::throw_file_error(path, "written", errno);
}

// The checkpoint, or why it cannot be used.
struct Reading {
  std::optional<Checkpoint> checkpoint;
  std::string refused;
};

Reading read(const std::filesystem::path& path, const Checkpoint::Origin& wanted) {
  const std::string name = path.filename().string();
  std::ifstream file(path, std::ios::binary);
  std::string head;
  if (!std::getline(file, head)) return {std::nullopt, name + " is empty."};
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  Reading out;
  if (head != head_of(bytes) || !out.checkpoint.emplace().ParseFromString(bytes)) {
    out.checkpoint.reset();
    out.refused = name + " is damaged.";
  } else if (out.checkpoint->origin().SerializeAsString() != wanted.SerializeAsString()) {
    out.refused = name + " was written by solver " + out.checkpoint->origin().solver_revision() + " with " +
                  out.checkpoint->origin().simd_target() + ", but this is solver " + wanted.solver_revision() +
                  " with " + wanted.simd_target() + ".";
    out.checkpoint.reset();
  }
  return out;
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

void write_checkpoint(const store::JobFolder& folder, const Checkpoint& checkpoint) {
  const std::string bytes = checkpoint.SerializeAsString();
  write_file(folder.partial_checkpoint(), head_of(bytes) + "\n", bytes);
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
    auto reading = read(path, origin);
    if (reading.checkpoint) {
      out.checkpoint = std::move(reading.checkpoint);
      return out;
    }
    out.refused.push_back(std::move(reading.refused));
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
