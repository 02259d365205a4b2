#include "http/download.h"

#include <fmt/format.h>

#include <utility>

#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "columns/history_csv.h"
#include "columns/sweep_csv.h"
#include "error.h"

namespace cellcrush::http {
namespace {

using client::Decimal;
using google::protobuf::Message;

constexpr const char* kCsv = "text/csv; charset=utf-8";

class ResultDownload final : public Download {
 public:
  explicit ResultDownload(const std::string& id) : name_("jobs/" + id) {
    method = "/cellcrush.v1.Jobs/DownloadResult";
    content_type = "application/x-hdf5";
    file_name = "job-" + id + ".h5";
  }

  void ask(Message& request) const override { static_cast<v1::DownloadResultRequest&>(request).set_name(name_); }
  void write(const Message& answer, std::string& to) override {
    to += static_cast<const v1::DownloadResultResponse&>(answer).data();
  }

 private:
  std::string name_;
};

class HistoryDownload final : public Download {
 public:
  HistoryDownload(const std::string& id, Decimal decimal) : decimal_(decimal) {
    method = "/cellcrush.v1.Jobs/GetHistory";
    content_type = kCsv;
    file_name = "job-" + id + "-history.csv";
    next_.set_name("jobs/" + id);
  }

  void ask(Message& request) const override { request.CopyFrom(next_); }
  void write(const Message& answer, std::string& to) override {
    const auto& page = static_cast<const v1::GetHistoryResponse&>(answer);
    to += client::history_csv(page.samples(), decimal_, next_.page_token().empty());
    next_.set_page_token(page.next_page_token());
  }
  [[nodiscard]] bool has_more() const override { return !next_.page_token().empty(); }

 private:
  Decimal decimal_;
  v1::GetHistoryRequest next_;
};

/// Gathers the rows, as a table may sum up several.
class SweepDownload final : public Download {
 public:
  SweepDownload(const std::string& id, Decimal decimal) : decimal_(decimal) {
    method = "/cellcrush.v1.Sweeps/GetSweepTable";
    content_type = kCsv;
    file_name = "sweep-" + id + ".csv";
    next_.set_name("sweeps/" + id);
  }

  void ask(Message& request) const override { request.CopyFrom(next_); }
  void write(const Message& answer, std::string& to) override {
    table_.clear_fields();
    table_.MergeFrom(static_cast<const v1::SweepTable&>(answer));
    next_.set_page_token(static_cast<const v1::SweepTable&>(answer).next_page_token());
    if (!has_more()) to += client::sweep_table_csv(table_, decimal_);
  }
  [[nodiscard]] bool has_more() const override { return !next_.page_token().empty(); }

 private:
  Decimal decimal_;
  v1::GetSweepTableRequest next_;
  v1::SweepTable table_;
};

Decimal read_decimal(std::string_view query) {
  if (query == "decimal=comma") return Decimal::comma;
  if (query.empty() || query == "decimal=point") return Decimal::point;
  throw ServiceError(ServiceError::Kind::invalid, fmt::format("The parameters \"{}\" are not valid. A CSV file has the "
                                                              "parameter decimal=comma or decimal=point.",
                                                              query));
}

// The text between both ends of the path; empty if it has others, or more folders between.
std::string between(std::string_view path, std::string_view start, std::string_view end) {
  if (path.size() <= start.size() + end.size() || !path.starts_with(start) || !path.ends_with(end)) return {};
  path = path.substr(start.size(), path.size() - start.size() - end.size());
  return path.find('/') == std::string_view::npos ? std::string(path) : std::string();
}

}  // namespace

std::shared_ptr<Download> open_download(std::string_view target) {
  const std::string_view path = target.substr(0, target.find('?'));
  const std::string_view query = path.size() < target.size() ? target.substr(path.size() + 1) : std::string_view();
  if (const auto id = between(path, "/jobs/", "/history.csv"); !id.empty())
    return std::make_shared<HistoryDownload>(id, read_decimal(query));
  if (const auto id = between(path, "/sweeps/", ".csv"); !id.empty())
    return std::make_shared<SweepDownload>(id, read_decimal(query));
  const auto id = between(path, "/jobs/", "/result.h5");
  if (id.empty()) return nullptr;
  if (!query.empty()) throw ServiceError(ServiceError::Kind::invalid, "result.h5 has no parameters.");
  return std::make_shared<ResultDownload>(id);
}

}  // namespace cellcrush::http
