#include <fmt/format.h>

#include <cstdio>

#include "case_file/case_source.h"
#include "commands/commands.h"
#include "commands/watch.h"
#include "terminal/json_text.h"

namespace cellcrush::client {

namespace {

struct SubmitOptions {
  CaseOptions scene;
  bool watch = false;
  std::string request_id;
  std::vector<std::string> labels;
  int priority = 0;
  double time_limit_s = 0.0;
  std::string executor;
};

ExitCode run_submit(Session& session, const SubmitOptions& options) {
  // From here on Ctrl-C ends the watch properly, even right after the job was queued.
  std::unique_ptr<Interruption> interruption;
  v1::CreateJobRequest request;
  *request.mutable_labels() = parse_labels(options.labels);
  request.set_request_id(options.request_id);
  request.set_priority(options.priority);
  request.set_time_limit_s(options.time_limit_s);
  request.set_executor(options.executor);
  Connection& connection = session.connection();
  *request.mutable_case_() = read_case(options.scene.source, options.scene.assignments, connection);
  if (options.watch) interruption = std::make_unique<Interruption>();
  const auto job = connection.call(connection.jobs(), &v1::Jobs::Stub::CreateJob, request);
  if (session.json) {
    print_json(job);
  } else {
    fmt::print("{}\n", job.name());
    std::fflush(stdout);
  }
  fmt::print(stderr, "{}", session.json ? "" : notes_text(job.notes()));
  return options.watch ? watch_job(session, job.name(), *interruption) : ExitCode::done;
}

}  // namespace

void add_submit_command(CLI::App& app, Session& session) {
  const auto options = std::make_shared<SubmitOptions>();
  CLI::App* command = add_command(app, session, "submit", "Queue a case and print the job name",
                                  [&session, options] { return run_submit(session, *options); });
  command->group(kJobCommands);
  add_case_options(*command, options->scene);
  command->add_flag("--watch", options->watch, "Follow the job to its end")->group(kOutputOptions);
  command
      ->add_option("--request-id", options->request_id,
                   "Id of the request, up to 128 characters; submitting it again returns the same job (default: none)")
      ->group(kIdentityOptions);
  add_label_option(*command, options->labels);
  add_priority_option(*command, options->priority);
  add_time_limit_option(*command, options->time_limit_s);
  add_executor_option(*command, options->executor);
  add_examples(*command, {"cellcrush submit my.txtpb --watch",
                          "cellcrush submit preset:type-i --set loading.speed_m_per_s=50 --time-limit 2h"});
}

}  // namespace cellcrush::client
