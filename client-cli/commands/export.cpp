#include <fmt/format.h>

#include <chrono>
#include <cstdint>

#include "commands/commands.h"
#include "terminal/number_text.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

// First bytes of the files that this command writes.
constexpr std::string_view kExportSignature = "<!doctype html>\n<!-- cellcrush export -->";
constexpr double kBytesOfMb = 1e6;

struct ExportOptions {
  std::string name;
  std::string file;
  double megabytes = 0.0;  ///< 0: the default of the daemon
};

struct Exported {
  std::int64_t bytes = 0;
  int frame_count = 0;
  int job_frame_count = 0;
};

Exported download_page(Connection& connection, const v1::ExportJobRequest& request, OutputFile& file) {
  Exported out;
  const auto take = [&](const v1::ExportJobResponse& chunk) {
    file.write(chunk.data());
    out.bytes += static_cast<std::int64_t>(chunk.data().size());
    out.frame_count = chunk.frame_count();
    out.job_frame_count = chunk.job_frame_count();
    return true;
  };
  const grpc::Status status =
      connection.read(connection.jobs(), &v1::Jobs::Stub::ExportJob, request, std::chrono::minutes(10), take);
  if (status.ok()) return out;
  if (out.bytes > 0 && exit_code_of(status.error_code()) == ExitCode::no_connection) {
    throw CommandError(ExitCode::cut_off,
                       fmt::format("the export broke off at byte {}: {}", out.bytes, status.error_message()));
  }
  throw error_of(status);
}

ExitCode run_export(Session& session, const ExportOptions& options) {
  check_ending(options.file, {".html", ".htm"});
  check_may_overwrite(options.file, {kExportSignature});
  v1::ExportJobRequest request;
  request.set_name(session.find_job(options.name));
  request.set_max_bytes(static_cast<std::int64_t>(kBytesOfMb * options.megabytes));
  OutputFile file(options.file);
  const Exported exported = download_page(session.connection(), request, file);
  file.commit();
  if (session.json) {
    print_file_json(options.file,
                    {{"frame_count", exported.frame_count}, {"job_frame_count", exported.job_frame_count}});
    return ExitCode::done;
  }
  fmt::print("{}  {}", options.file, size_text(exported.bytes));
  if (exported.frame_count < exported.job_frame_count) {
    fmt::print("  {} of {} frames; raise --max-size for more", exported.frame_count, exported.job_frame_count);
  }
  fmt::print("\n");
  return ExitCode::done;
}

}  // namespace

void add_export_command(CLI::App& app, Session& session) {
  const auto [command, options] =
      add_command<ExportOptions>(app, session, kResultCommands, "export",
                                 "Save an ended job as one HTML file that opens without a daemon", run_export);
  command->add_option("NAME", options->name, "Name of a job, or a result.h5 file or its folder")->required();
  add_option(*command, kOutputOptions, "-o,--output", options->file, "HTML file, such as FILE.html")->required();
  add_option(*command, kOutputOptions, "--max-size", options->megabytes,
             "Approximate size of the file, in MB; limits the number of frames (default: 20)")
      ->check(CLI::Range(1.0, 1e4));
  add_examples(*command,
               {"cellcrush export jobs/12 -o crush.html", "cellcrush export jobs/12 -o crush.html --max-size 100"});
}

}  // namespace cellcrush::client
