#include "notices/feed.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "clocks.h"
#include "error.h"
#include "log_format.h"
#include "store/job_state.h"
#include "store/own_folder.h"
#include "store/resource_name.h"

namespace cellcrush::notices {
namespace {

using google::protobuf::Timestamp;
using google::protobuf::util::TimeUtil;

constexpr int kAtOnce = 200;  // changes

std::string json_of(const google::protobuf::Message& message) {
  std::string out;
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  static_cast<void>(MessageToJsonString(message, &out, options));
  return out;
}

std::string body_of(const std::string& type, const Timestamp& time, const std::string& data) {
  return fmt::format(R"({{"type":{},"timestamp":"{}","data":{}}})", json_string(type), TimeUtil::ToString(time), data);
}

const char* type_of(v1::Job::State state) {
  if (state == v1::Job::SUCCEEDED) return "job.succeeded";
  return state == v1::Job::FAILED ? "job.failed" : "job.cancelled";
}

}  // namespace

std::vector<Notice> Feed::next(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto found = parts_.changes.readable_after(position_, kAtOnce);
    if (found.first == 0) return {};
    // Their numbers have no gaps, until the journal drops the oldest.
    if (found.first > position_ + 1) has_missed_ = true;
    for (const auto& change : found.changes) {
      if (stop.stop_requested()) return {};
      std::vector<Notice> out;
      try {
        out = notices_of(change);
      } catch (const ServiceError& error) {
        if (error.kind() != ServiceError::Kind::data_loss) throw;
        spdlog::error("Nobody is told of change {}: {}", change.number, error.what());
      }
      position_ = change.number;
      std::erase_if(out, [this](const Notice& notice) { return !wants_(notice.type); });
      if (!out.empty()) return out;
    }
    position_ = found.last;
  }
  return {};
}

std::vector<Notice> Feed::notices_of(const store::Change& change) {
  if (change.kind != store::ChangeKind::job_state) return {};
  const auto found = parts_.reader.find_without_case(change.resource);
  if (!found || found->is_damaged || found->last_sequence != change.sequence ||
      !store::is_terminal(found->job.state()) || !found->job.has_state_time())
    return {};
  const std::string type = type_of(found->job.state());
  std::vector<Notice> out;
  out.push_back({fmt::format("{}-{}-{}", parts_.epoch, change.resource, change.sequence), type, found->job.name(),
                 body_of(type, found->job.state_time(), "{\"job\":" + json_of(found->job) + "}"), change.resource});
  if (wants_("sweep.ended")) add_sweep(found->job.sweep(), out);
  return out;
}

void Feed::add_sweep(const std::string& name, std::vector<Notice>& out) {
  const auto number = store::sweep_number_of(name);
  if (!number || !has_ended(*number)) return;
  const std::int64_t newest = parts_.sweeps.newest_job(*number);
  if (std::exchange(told_[*number], newest) == newest) return;
  const auto sweep = parts_.sweeps.find_sweep(*number, store::SweepReader::Jobs::left_out);
  if (!sweep) return;
  out.push_back({fmt::format("{}-sweep-{}-{}", parts_.epoch, *number, newest), "sweep.ended", name,
                 body_of("sweep.ended", time_now(), "{\"sweep\":" + json_of(*sweep) + "}")});
}

// Looks at one job while that has not ended: a sweep may have 100,000.
bool Feed::has_ended(std::int64_t sweep) {
  if (const auto known = unended_.find(sweep); known != unended_.end()) {
    const auto job = parts_.reader.find_without_case(known->second);
    if (job && !store::is_terminal(job->job.state())) return false;
    unended_.erase(known);
  }
  const auto other = parts_.sweeps.find_unended(sweep);
  if (other) unended_[sweep] = *other;
  return !other;
}

Notice notice_of_queue(const std::string& epoch, const std::string& executor, const jobs::Hold* hold) {
  const std::string type = hold != nullptr ? "queue.held" : "queue.released";
  std::string data = "{\"executor\":" + json_string(executor);
  if (hold != nullptr) {
    data += fmt::format(R"(,"cause":"{}","reason":{},"remedy":{})", name_of(hold->shortage), json_string(hold->reason),
                        json_string(remedy_for(hold->shortage)));
  }
  return {epoch + "-queue-" + store::random_name(), type, executor, body_of(type, time_now(), data + "}")};
}

}  // namespace cellcrush::notices
