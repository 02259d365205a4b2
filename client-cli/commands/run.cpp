#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "commands/fetch.h"
#include "commands/watch.h"
#include "connection/private_daemon.h"
#include "terminal/case_text.h"
#include "terminal/output_file.h"
#include "terminal/terminal.h"

namespace cellcrush::client {
namespace {

namespace fs = std::filesystem;

// The data folder of the private daemon, deleted once the results are written. Its only job has number 1.
constexpr const char* kDataFolder = ".cellcrush";
constexpr const char* kJob = "jobs/1";

struct RunOptions {
  CaseOptions scene;
  std::string folder;
  bool resume = false;
  double time_limit_s = 0.0;
};

// Deleted on destruction, unless it is kept or existed before.
class PrivateData {
 public:
  explicit PrivateData(fs::path path)
      : path_(std::move(path)), was_there_(fs::exists(path_)), is_kept_(was_there_), folder_(path_) {
    std::error_code error;
    fs::permissions(path_, fs::perms::owner_all, error);
  }
  ~PrivateData() {
    std::error_code none;
    if (!is_kept_) fs::remove_all(path_, none);
  }
  PrivateData(const PrivateData&) = delete;
  PrivateData& operator=(const PrivateData&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] bool was_there() const { return was_there_; }
  void keep(bool is_kept) { is_kept_ = is_kept; }

 private:
  fs::path path_;
  bool was_there_;
  bool is_kept_;
  OutputFolder folder_;
};

std::optional<v1::Job> find_unfinished(Connection& connection) {
  const auto listed = connection.call(connection.jobs(), &v1::Jobs::Stub::ListJobs, v1::ListJobsRequest());
  if (listed.jobs_size() == 0) return std::nullopt;
  return listed.jobs(0);
}

std::string text_of(const v1::Case& scene) { return case_file_text(scene, std::string("Case of ") + kJob); }

// The job to run: a new one, or the unfinished one of the same case.
void start_job(Session& session, const v1::Case& scene, const RunOptions& options) {
  Connection& connection = session.connection();
  const auto unfinished = find_unfinished(connection);
  if (!unfinished) {
    v1::CreateJobRequest request;
    *request.mutable_case_() = scene;
    const auto job = connection.call(connection.jobs(), &v1::Jobs::Stub::CreateJob, request);
    if (!session.json) fmt::print(stderr, "{}", notes_text(job.notes()));
    return;
  }
  if (text_of(unfinished->case_()) != text_of(scene)) {
    refuse(
        fmt::format("{} holds the unfinished run of another case. Give the case it was started with, or "
                    "delete {} to start this one.",
                    options.folder, (fs::path(options.folder) / kDataFolder).string()));
  }
}

// Whether the folder has the result of a complete run of the case. A failed run leaves no case.txtpb.
bool holds_result(const fs::path& folder, const v1::Case& scene) {
  return holds_text(folder / "case.txtpb", text_of(scene)) && fs::exists(folder / "result.h5");
}

// Rewords the error of a broken watch: nobody else can reach this daemon.
CommandError error_of_break(const CommandError& error, PrivateDaemon& daemon) {
  if (error.code() != ExitCode::cut_off && error.code() != ExitCode::no_connection) return error;
  if (!daemon.has_ended()) return error;
  return {error.code(), fmt::format("the private cellcrushd ended before the job did; its log is {}. The same command "
                                    "with --resume continues from the last checkpoint.",
                                    daemon.log().string())};
}

WatchedJob run_to_its_end(Session& session, const v1::Case& scene, const RunOptions& options, PrivateData& data,
                          PrivateDaemon& daemon, const Interruption& interruption) {
  try {
    start_job(session, scene, options);
    data.keep(true);
    return show_job_to_its_end(session, kJob, interruption,
                               "Run it again with a longer --time-limit, with a lower fidelity or to a lower "
                               "end_strain.");
  } catch (const CommandError& error) {
    throw error_of_break(error, daemon);
  }
}

ExitCode run_case(Session& session, const RunOptions& options) {
  if (!session.server.empty()) {
    refuse("run starts its own daemon. Leave --server out, or use submit --watch.");
  }
  // Read before anything is created: Ctrl-C while waiting for stdin leaves nothing behind.
  const auto own_case = read_own_case(options.scene);
  const fs::path folder(options.folder);
  PrivateData data(folder / kDataFolder);
  if (data.was_there() && !options.resume) {
    refuse(fmt::format("{} holds an unfinished run. Continue it with --resume, or delete {} to start over.",
                       folder.string(), data.path().string()));
  }
  check_may_write_results(folder);
  const Interruption interruption;
  PrivateDaemon daemon(data.path(), options.time_limit_s);
  session.server = daemon.address();
  Connection& connection = session.connection();
  const v1::Case scene = own_case ? *own_case : read_case(options.scene, connection);
  if (options.resume && !data.was_there() && holds_result(folder, scene)) {
    if (!session.json) fmt::print("{} already holds the result of this case.\n", folder.string());
    return ExitCode::done;
  }
  if (interruption.requested()) {
    fmt::print(stderr, "\ncellcrush: stopped before the job started\n");
    return ExitCode::interrupted;
  }
  const auto [job, complete] = run_to_its_end(session, scene, options, data, daemon, interruption);
  if (!complete) {
    daemon.stop();
    fmt::print(stderr, "\ncellcrush: stopped at a checkpoint. The same command{} with --resume continues from there.\n",
               options.scene.source == "-" ? ", with the same case on stdin," : "");
    return ExitCode::interrupted;
  }
  if (job.has_summary()) write_results(connection, job, folder);
  if (job.state() != v1::Job::SUCCEEDED) fs::remove(folder / "case.txtpb");
  daemon.stop();
  data.keep(false);
  return exit_code_of(job.state());
}

}  // namespace

void add_run_command(CLI::App& app, Session& session) {
  const auto [command, options] = add_command<RunOptions>(app, session, kJobCommands, "run",
                                                          "Run a case in the foreground, without a daemon", run_case);
  add_case_options(*command, options->scene);
  command
      ->add_option("-o,--output", options->folder,
                   "Output folder, created if missing; without --resume an earlier result in it is replaced")
      ->required();
  command->add_flag(
      "--resume", options->resume,
      "Continue an unfinished run in this folder; start one if there is none, do nothing if it is finished");
  add_time_limit_option(*command, options->time_limit_s,
                        "none; with --resume, the limit given now replaces the earlier one");
  add_examples(*command, {"cellcrush run my.txtpb -o results", "cellcrush run my.txtpb -o results --resume"});
}

}  // namespace cellcrush::client
