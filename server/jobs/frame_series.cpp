#include "jobs/frame_series.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "error.h"
#include "store/report_log.h"
#include "store/result_reader.h"

namespace cellcrush::jobs {
namespace {

class FramesOfResult final : public FrameSeries {
 public:
  explicit FramesOfResult(const std::filesystem::path& path) : result_(path) {
    for (const double time : result_.frame_times()) times_.add_time_s(time);
    for (const double strain : result_.frame_strains()) times_.add_strain(strain);
  }
  [[nodiscard]] const v1::StreamFramesResponse::FrameTimes& times() const override { return times_; }
  v1::FieldFrame frame(int index) override { return result_.frame(index); }

 private:
  store::ResultReader result_;
  v1::StreamFramesResponse::FrameTimes times_;
};

// A worker that resumes reports some frames again; the first report of each counts.
class FramesOfReports final : public FrameSeries {
 public:
  explicit FramesOfReports(const std::filesystem::path& path)
      : path_(path), reader_(std::make_unique<store::ReportLogReader>(path)) {
    store::ReportLogReader reader(path);
    worker::Report report;
    while (reader.read(report) == store::ReportLogReader::Read::message) {
      if (!report.has_frame() || report.frame().index() != times_.time_s_size()) continue;
      times_.add_time_s(report.frame().time_s());
      times_.add_strain(report.frame().strain());
    }
  }
  [[nodiscard]] const v1::StreamFramesResponse::FrameTimes& times() const override { return times_; }

  v1::FieldFrame frame(int index) override {
    worker::Report report;
    if (index < next_) reader_ = std::make_unique<store::ReportLogReader>(path_);
    while (reader_->read(report) == store::ReportLogReader::Read::message) {
      if (!report.has_frame() || report.frame().index() != index) continue;
      next_ = index + 1;
      return std::move(*report.mutable_frame());
    }
    throw ServiceError(ServiceError::Kind::data_loss, "Frame " + std::to_string(index) +
                                                          " can no longer be read from " + path_.string() +
                                                          ". Ask again; if the job has ended by then, for its result.");
  }

 private:
  std::filesystem::path path_;
  std::unique_ptr<store::ReportLogReader> reader_;
  int next_ = 0;  ///< index after that of the last frame
  v1::StreamFramesResponse::FrameTimes times_;
};

}  // namespace

std::unique_ptr<FrameSeries> open_frame_series(const store::JobFolder& folder) {
  // The result appears before the reports are deleted, so that one of both is there; it may appear in between.
  for (int attempt = 0; attempt < 2; ++attempt) {
    std::error_code none;
    if (std::filesystem::exists(folder.result(), none)) return std::make_unique<FramesOfResult>(folder.result());
    if (!std::filesystem::exists(folder.reports(), none)) continue;
    try {
      return std::make_unique<FramesOfReports>(folder.reports());
    } catch (const ServiceError&) {
      if (std::filesystem::exists(folder.reports(), none)) throw;
    }
  }
  return nullptr;
}

}  // namespace cellcrush::jobs
