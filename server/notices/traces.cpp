#include <google/protobuf/util/time_util.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "notices/receiver.h"
#include "revision.h"
#include "store/case_hash.h"

// OTLP 1, opentelemetry/proto/trace/v1/trace.proto, in its JSON form: ids in hexadecimal, times as text in nanoseconds.

namespace cellcrush::notices {
namespace {

using google::protobuf::Timestamp;
using google::protobuf::util::TimeUtil;
using nlohmann::json;

constexpr int kInternal = 1;  // kind of a span
constexpr int kOk = 1;        // status of a span
constexpr int kError = 2;

std::string nanoseconds(const Timestamp& time) { return std::to_string(TimeUtil::TimestampToNanoseconds(time)); }

json attribute(const char* key, const char* kind, json value) {
  json out;
  out["key"] = key;
  out["value"][kind] = std::move(value);
  return out;
}
json text(const char* key, const std::string& value) { return attribute(key, "stringValue", value); }
json number(const char* key, double value) { return attribute(key, "doubleValue", value); }
// 64-bit integers are text in the JSON of protobuf.
json count(const char* key, std::int64_t value) { return attribute(key, "intValue", std::to_string(value)); }

const char* phase_of(v1::Job::State state) {
  switch (state) {
    case v1::Job::PENDING: return "waiting";
    case v1::Job::RUNNING: return "running";
    case v1::Job::SUSPENDED: return "suspended";
    default: return "cancelling";
  }
}

json attributes_of(const v1::Job& job) {
  json out = json::array();
  out.push_back(text("cellcrush.job", job.name()));
  out.push_back(text("cellcrush.state", v1::Job::State_Name(job.state())));
  out.push_back(text("cellcrush.owner", job.owner()));
  out.push_back(text("cellcrush.executor", job.executor()));
  out.push_back(count("cellcrush.attempts", job.attempt()));
  if (!job.title().empty()) out.push_back(text("cellcrush.title", job.title()));
  if (!job.sweep().empty()) out.push_back(text("cellcrush.sweep", job.sweep()));
  if (job.state() == v1::Job::FAILED) out.push_back(text("cellcrush.cause", v1::Job::Cause_Name(job.cause())));
  if (job.has_summary()) {
    out.push_back(count("cellcrush.steps", job.summary().step_count()));
    out.push_back(number("cellcrush.solver_seconds", job.summary().solver_seconds()));
  }
  return out;
}

// Without its ids.
json span_of(const char* name, const Timestamp& begin, const Timestamp& end, json attributes) {
  json out;
  out["name"] = name;
  out["kind"] = kInternal;
  out["startTimeUnixNano"] = nanoseconds(begin);
  out["endTimeUnixNano"] = nanoseconds(end);
  out["attributes"] = std::move(attributes);
  return out;
}

// The states of which each begins a time of its own: a note begins none, and jobs of earlier versions have no times.
std::vector<v1::Job> phases_of(const std::vector<v1::Job>& states) {
  std::vector<v1::Job> out;
  for (const v1::Job& job : states) {
    const bool is_new = out.empty() || TimeUtil::TimestampToNanoseconds(out.back().state_time()) !=
                                           TimeUtil::TimestampToNanoseconds(job.state_time());
    if (is_new && job.has_state_time()) out.push_back(job);
  }
  return out;
}

}  // namespace

std::string spans_of(const std::vector<v1::Job>& states, const std::string& epoch) {
  const v1::Job& last = states.back();
  const std::string name = epoch + "/" + last.name();
  const std::string trace = store::sha256_of("trace " + name).substr(0, 32);
  json spans = json::array();
  const auto add = [&](json span) {
    span["traceId"] = trace;
    span["spanId"] = store::sha256_of("span " + name + " " + std::to_string(spans.size())).substr(0, 16);
    if (!spans.empty()) span["parentSpanId"] = spans.front()["spanId"];
    spans.push_back(std::move(span));
  };
  const bool failed = last.state() == v1::Job::FAILED;
  const auto phases = phases_of(states);
  const bool has_times = !phases.empty() && last.has_state_time();
  json whole = span_of("job", has_times ? phases.front().state_time() : last.create_time(),
                       has_times ? last.state_time() : last.end_time(), attributes_of(last));
  whole["status"]["code"] = failed ? kError : kOk;
  if (failed) whole["status"]["message"] = last.cause_message();
  add(std::move(whole));
  for (std::size_t i = 0; i + 1 < phases.size(); ++i) {
    json attributes = json::array();
    if (phases[i].state() == v1::Job::RUNNING) attributes.push_back(count("cellcrush.attempt", phases[i].attempt()));
    add(span_of(phase_of(phases[i].state()), phases[i].state_time(), phases[i + 1].state_time(),
                std::move(attributes)));
  }
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  json scope;
  scope["scope"]["name"] = "cellcrush";
  scope["scope"]["version"] = kVersion;
  scope["spans"] = std::move(spans);
  json resource;
  resource["resource"]["attributes"].push_back(text("service.name", "cellcrushd"));
  resource["resource"]["attributes"].push_back(text("service.version", kVersion));
  resource["resource"]["attributes"].push_back(text("host.name", host.data()));
  resource["scopeSpans"].push_back(std::move(scope));
  json out;
  out["resourceSpans"].push_back(std::move(resource));
  return out.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace cellcrush::notices
