#include "jobs/report_feed.h"

#include <fcntl.h>

#include <utility>

#include "store/durable_file.h"

namespace cellcrush::jobs {
namespace {

const std::filesystem::path& existing(const std::filesystem::path& path) {
  store::open_own(path, O_WRONLY | O_CREAT);
  return path;
}

}  // namespace

ReportFeed::ReportFeed(const store::JobFolder& folder, const WorkerEvents& events)
    : events_(events), reader_(existing(folder.reports())) {}

ReportFeed::Reading ReportFeed::read(bool live) {
  Reading out = Reading::nothing_new;
  while (true) {
    switch (reader_.read(report_)) {
      case store::ReportLogReader::Read::end: return out;
      case store::ReportLogReader::Read::broken: return Reading::broken;
      case store::ReportLogReader::Read::message: break;
    }
    out = Reading::something_new;
    if (report_.has_begun()) final_.reset();
    if (report_.has_final()) {
      final_ = report_.final();
    } else if (report_.has_stopping()) {
      acknowledged_ = live;
    } else if (live || !report_.has_progress()) {
      if (report_.has_progress()) progress_ = report_.progress();
      events_.reported(report_);
    }
  }
}

bool ReportFeed::take_acknowledgement() { return std::exchange(acknowledged_, false); }

void ReportFeed::report_stall() {
  if (progress_.stalled()) return;
  progress_.set_stalled(true);
  worker::Report report;
  *report.mutable_progress() = progress_;
  events_.reported(report);
}

}  // namespace cellcrush::jobs
