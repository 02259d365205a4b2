#include "commands/resource_name.h"

#include "command_error.h"

namespace cellcrush::client {

namespace {

constexpr const char* kJobs = "jobs/";
constexpr const char* kSweeps = "sweeps/";

std::string with_prefix(const std::string& name, const char* prefix) {
  return name.find('/') == std::string::npos ? prefix + name : name;
}

}  // namespace

bool names_sweep(const std::string& name) { return name.starts_with(kSweeps); }

std::string job_name(const std::string& name) {
  if (names_sweep(name)) throw CommandError(ExitCode::refused, name + " is a sweep; name one of its jobs, jobs/NAME");
  return with_prefix(name, kJobs);
}

std::string sweep_name(const std::string& name) {
  if (name.starts_with(kJobs)) throw CommandError(ExitCode::refused, name + " is a job; name a sweep, sweeps/NAME");
  return with_prefix(name, kSweeps);
}

}  // namespace cellcrush::client
