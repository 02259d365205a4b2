#include "docs/configuration_prose.h"

namespace cellcrush::docs {
namespace {

OptionGroup data_and_disk() {
  return {
      "Data and disk",
      "",
      {{"data",
        {"DIR",
         "",
         {"The daemon keeps everything here and nothing elsewhere. One daemon at a time owns the folder. The commands "
          "`backup` and `restore` accept the same option."}}},
       {"min-free-disk",
        {"MIB",
         "MiB",
         {"Below the limit, running jobs stop at a checkpoint and continue once there is space. "
          "With 0 the disk may fill up. Even then no job fails: the queue is held until there is space."}}},
       {"keep-ended-jobs",
        {"DAYS",
         "days",
         {"Neither a wrong clock nor a long pause deletes anything. A sweep ends with its last job and is deleted as a "
          "whole."}}},
       {"keep-ended-count", {"N", "jobs", {}}},
       {"keep-ended-size",
        {"MIB", "MiB", {"The size of a job is that of its `result.h5` and its rows in the journal."}}}}};
}

OptionGroup addresses() {
  return {
      "Addresses",
      "",
      {{"listen",
        {"ADDR",
         "",
         {"The host is an IPv4 address, an IPv6 address in brackets, or `localhost`. An address that other machines "
          "can reach requires TLS and a way to identify callers ([let-others-in.md](let-others-in.md))."}}},
       {"http",
        {"ADDR",
         "",
         {"An address that other machines can reach requires `--tls-cert`, `--tls-key` and `--tokens`. With "
          "`--tls-client-ca` alone the port is off, since over HTTP only a token names the caller. [http.md](http.md) "
          "shows how to call it."}}},
       {"metrics",
        {"ADDR",
         "",
         {"The port has neither TLS nor tokens, so only loopback addresses are allowed. "
          "[monitor.md](monitor.md#metrics) lists the metrics."}}}}};
}

OptionGroup access() {
  return {"Access",
          "These options apply to TCP addresses. A Unix socket is protected by its file mode instead. "
          "[let-others-in.md](let-others-in.md) shows how to use them.",
          {{"tls-cert",
            {"FILE", "", {"The file holds the certificate chain of the daemon. The option requires `--tls-key`."}}},
           {"tls-key",
            {"FILE",
             "",
             {"Other users must not be able to read the file (mode 0600 or 0640). A key with a password is refused."}}},
           {"tls-client-ca",
            {"FILE",
             "",
             {"The common name of the client's certificate is the owner of the jobs and sweeps it creates, unless a "
              "token names the caller."}}},
           {"tls-client-scope", {"SCOPE", "", {}}},
           {"tokens",
            {"FILE",
             "",
             {"Each line is `NAME SCOPE SHA256-HEX`; `#` begins a comment. Other users must not be able to read the "
              "file (mode 0600 or 0640)."}}}}};
}

OptionGroup connections() {
  return {
      "Connections and streams",
      "A caller beyond one of these limits gets RESOURCE_EXHAUSTED, and the message names the limit.",
      {{"max-connections", {"N", "connections", {}}},
       {"max-connections-per-address", {"N", "connections", {"An IPv6 network of 64 bits counts as one address."}}},
       {"max-streams", {"N", "streams", {}}},
       {"max-streams-per-caller", {"N", "streams", {"Without tokens and certificates all callers share this limit."}}},
       {"max-call-memory", {"MIB", "MiB", {}}},
       {"watch-patience",
        {"SECONDS",
         "s",
         {"The daemon resets a stream ten seconds after closing it. A client that watches again continues where "
          "it stopped."}}}}};
}

OptionGroup jobs() {
  return {"Jobs and workers",
          "",
          {{"workers",
            {"N",
             "jobs",
             {"Each job runs in a process of its own. A job that asks for threads gets extra cores only if no other "
              "job uses them or waits for them."}}},
           {"slurm",
            {"NAME:KEY=VALUE,...",
             "",
             {"[executor.md](../deploy/slurm/executor.md#settings) lists the keys. Values cannot contain commas."}}},
           {"executor",
            {"NAME",
             "",
             {"Each executor has a queue of its own, and trouble on one holds only its own queue. A job keeps the "
              "executor that it was created with. The daemon does not start with a name that it does not have."}}},
           {"checkpoint-interval",
            {"SECONDS", "s", {"A job whose worker is lost repeats at most the work since its last checkpoint."}}},
           {"max-queued-jobs", {"N", "jobs", {"Beyond this limit a submission fails with RESOURCE_EXHAUSTED."}}},
           {"max-job-memory", {"MIB", "MiB", {"Beyond this limit a submission fails with RESOURCE_EXHAUSTED."}}},
           {"max-job-time",
            {"SECONDS",
             "s",
             {"The limit covers all workers that the job has had. Time in which the job waits or is suspended does not "
              "count. A job that reaches the limit becomes FAILED with the cause TIME_LIMIT. With 0 there is no "
              "limit."}}}}};
}

OptionGroup quotas() {
  return {
      "Quotas",
      "Quotas apply to every owner, `local` and owners with the scope `admin` included. A submission beyond a quota "
      "fails with RESOURCE_EXHAUSTED, a submission with a higher priority than allowed with INVALID_ARGUMENT.",
      {{"owner-max-queued", {"N", "jobs", {}}},
       {"owner-max-running", {"N", "jobs", {}}},
       {"owner-max-disk", {"MIB", "MiB", {"A job counts in full once it has ended."}}},
       {"owner-max-priority", {"P", "", {}}}}};
}

OptionGroup other() {
  return {"Log and configuration file",
          "",
          {{"log-format",
            {"FORMAT", "", {"The log goes to standard error. [monitor.md](monitor.md#logs) describes its lines."}}},
           {"config", {"FILE", "", {"The file sets every other option of this page."}}}}};
}

}  // namespace

std::vector<OptionGroup> option_groups() {
  return {data_and_disk(), addresses(), access(), connections(), jobs(), quotas(), other()};
}

const char* const kHead = R"(<!-- Generated from the options of cellcrushd. Rewrite it after a build with
     CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_configuration_page -->

# Configuration of cellcrushd

This page is the reference of every option of the daemon, for those who run it. [run.md](run.md) shows how to start the
daemon; [README.md](README.md) lists the other pages.

Every option is a flag on the command line (`--workers 2`) and a key of the file that `--config` names (`workers = 2`).
A flag overrides the file, and the file overrides the default. One MiB is 1,048,576 bytes.

## Example of a configuration file

The file is TOML, one option per line. An unknown key, a section or a value beyond its limits is an error: the daemon
names it and ends with exit code 2.

)";

const char* const kExample = R"(# cellcrushd --config cellcrushd.toml
data = "/var/lib/cellcrush"
listen = ["unix:/var/lib/cellcrush/cellcrushd.sock", "127.0.0.1:50551"]
metrics = "127.0.0.1:9464"
workers = 4
checkpoint-interval = 30
keep-ended-jobs = 90
min-free-disk = 2048
log-format = "json"
)";

const char* const kBehindExample =
    R"(The daemon reads this file once, when it starts. On SIGHUP it reads the files of `tls-cert`,
`tls-key`, `tls-client-ca` and `tokens` again, and nothing else.

## Options

The tables give the default, the unit, and the smallest and largest value of each option.

)";

const char* const kTail = R"(## Environment

| Variable | Meaning |
|---|---|
| `XDG_DATA_HOME`, `HOME` | parents of the default data folder |
| `CELLCRUSH_SIMD` | kernel of the solver: `scalar`, `sse4`, `avx2` or `avx512`; by default the fastest that runs |

## Exit codes

| Code | Meaning |
|---|---|
| 0 | the daemon, or the command, ended normally |
| 1 | the daemon could not start, or the command failed; `verify` found a problem |
| 2 | wrong usage: an unknown flag or key, or a value beyond its limits |
)";

}  // namespace cellcrush::docs
