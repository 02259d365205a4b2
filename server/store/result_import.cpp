#include "store/result_import.h"

#include <google/protobuf/util/time_util.h>

#include <array>
#include <string_view>
#include <system_error>

#include "access/unix_user.h"
#include "error.h"
#include "store/data_folder.h"
#include "store/durable_file.h"
#include "store/journal.h"
#include "store/result_reader.h"
#include "store/result_seal.h"

namespace cellcrush::store {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "result.h5";

ServiceError not_a_result(const std::string& why) { return {ServiceError::Kind::invalid, why}; }

fs::path result_at(const fs::path& given) {
  std::error_code error;
  const auto status = fs::status(given, error);
  if (!fs::is_directory(status) && fs::exists(status)) return fs::canonical(given);
  const bool has_result = fs::is_directory(status) && fs::exists(given / kName, error);
  if (has_result) return fs::canonical(given / kName);
  if (error && error != std::errc::no_such_file_or_directory)
    throw not_a_result(error.message() + ". Name a result.h5, or a folder with one, that you may read.");
  if (!fs::exists(status)) throw not_a_result("no such file or folder. Name a result.h5 or its folder.");
  throw not_a_result(
      "this folder has no result.h5. Name one of `cellcrush run` or `cellcrush fetch`; complete an unfinished run with "
      "`cellcrush run --resume`.");
}

void check_file(const fs::path& path) {
  std::array<char, 16> start{};
  const auto count = read_at(open_to_read(path), path, start.data(), start.size(), 0);
  const std::string_view text(start.data(), count);
  if (!text.starts_with("CELLCRUSH RESULT") && !text.starts_with("\x89HDF"))
    throw not_a_result("not a result of cellcrush. Name a result.h5 or its folder.");
  const Seal seal = read_seal(path);
  if (seal == Seal::whole) return;
  throw not_a_result(
      seal == Seal::missing
          ? "an HDF5 file without the checksum of cellcrush: another program or an early version wrote "
            "it. Run its case again."
          : "the file is damaged or incomplete: its contents do not match its checksum. Copy or fetch it "
            "again, or run its case again.");
}

ImportedResult read_result(const fs::path& path) {
  check_file(path);
  const ResultReader reader(path);
  ImportedResult out{reader.job(), reader.mesh(), static_cast<std::int64_t>(reader.history().size())};
  out.job.set_owner(access::own_user());
  if (!out.job.has_create_time()) *out.job.mutable_create_time() = google::protobuf::util::TimeUtil::GetCurrentTime();
  // These name things of the daemon that made it.
  out.job.clear_sweep();
  out.job.clear_retry_of();
  out.job.clear_begun_again_sequence();
  out.job.clear_worker_pid();
  return out;
}

// Copied beside its place, so that it is complete under its name.
void put_result(const fs::path& from, const JobFolder& folder, Import how) {
  if (how == Import::link) {
    std::error_code error;
    static_cast<void>(remove_own(folder.result()));
    fs::create_symlink(from, folder.result(), error);
    if (error) throw_file_error(folder.result(), "created", error.value());
    return;
  }
  copy_own(from, folder.partial_result());
  publish_file(folder.partial_result(), folder.result());
}

}  // namespace

std::vector<std::int64_t> import_results(const fs::path& data_folder, const std::vector<fs::path>& files, Import how) {
  std::vector<ImportedResult> results;
  std::vector<fs::path> paths;
  std::string problems;
  for (const auto& file : files) {
    try {
      paths.push_back(result_at(file));
      results.push_back(read_result(paths.back()));
    } catch (const ServiceError& error) {
      problems += (problems.empty() ? "" : "\n") + file.string() + ": " + error.what();
    }
  }
  if (!problems.empty()) throw not_a_result(problems);
  const DataFolder folder(data_folder);
  Journal journal(folder.journal(), [](std::int64_t) {});
  return journal.import_results(results, [&](std::size_t result, std::int64_t job) {
    folder.make_job_folder(job);
    put_result(paths[result], folder.job_folder(job), how);
  });
}

}  // namespace cellcrush::store
