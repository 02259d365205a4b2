#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>

#include <chrono>
#include <cstdint>

#include "commands/commands.h"
#include "terminal/json_text.h"
#include "terminal/number_text.h"
#include "terminal/output_file.h"

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
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(10));
  const auto reader = connection.jobs().ExportJob(&context, request);
  v1::ExportJobResponse chunk;
  Exported out;
  while (reader->Read(&chunk)) {
    file.write(chunk.data());
    out.bytes += static_cast<std::int64_t>(chunk.data().size());
    out.frame_count = chunk.frame_count();
    out.job_frame_count = chunk.job_frame_count();
  }
  const grpc::Status status = reader->Finish();
  if (status.ok()) return out;
  if (out.bytes > 0 && exit_code_of(status.error_code()) == ExitCode::no_connection) {
    throw CommandError(ExitCode::cut_off,
                       fmt::format("the export broke off at byte {}: {}", out.bytes, status.error_message()));
  }
  throw error_of(status);
}

void print_exported_json(const std::string& path, const Exported& exported) {
  google::protobuf::Struct json;
  (*json.mutable_fields())["path"].set_string_value(path);
  (*json.mutable_fields())["frame_count"].set_number_value(exported.frame_count);
  (*json.mutable_fields())["job_frame_count"].set_number_value(exported.job_frame_count);
  print_json(json);
}

ExitCode run_export(Session& session, const ExportOptions& options) {
  check_may_overwrite(options.file, {kExportSignature});
  v1::ExportJobRequest request;
  request.set_name(job_name(options.name));
  request.set_max_bytes(static_cast<std::int64_t>(kBytesOfMb * options.megabytes));
  OutputFile file(options.file);
  const Exported exported = download_page(session.connection(), request, file);
  file.commit();
  if (session.json) {
    print_exported_json(options.file, exported);
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
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command =
      add_command(app, session, "export", "Save an ended job as one HTML file that opens without a daemon",
                  [&session, options] { return run_export(session, *options); });
  command->group(kResultCommands);
  command->add_option("NAME", options->name, "Job name")->required();
  command->add_option("-o,--output", options->file, "HTML file, such as FILE.html")->required()->group(kOutputOptions);
  command
      ->add_option("--max-size", options->megabytes,
                   "Approximate size of the file, in MB; limits the number of frames (default: 20)")
      ->group(kOutputOptions)
      ->check(CLI::Range(1.0, 1e4));
  add_examples(*command,
               {"cellcrush export jobs/12 -o crush.html", "cellcrush export jobs/12 -o crush.html --max-size 100"});
}

}  // namespace cellcrush::client
