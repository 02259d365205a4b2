#include "http/download.h"

#include <absl/strings/numbers.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "columns/history_csv.h"
#include "columns/result_columns.h"
#include "columns/sweep_csv.h"
#include "error.h"

namespace cellcrush::http {
namespace {

using google::protobuf::Message;

constexpr const char* kCsv = "text/csv; charset=utf-8";

class ResultDownload final : public Download {
 public:
  explicit ResultDownload(const std::string& id) : name_("jobs/" + id) {
    method = "/cellcrush.v1.Jobs/DownloadResult";
    content_type = "application/x-hdf5";
    file_name = "job-" + id + ".h5";
    has_ranges = true;
  }

  void ask(Message& request) const override {
    auto& download = static_cast<v1::DownloadResultRequest&>(request);
    download.set_name(name_);
    download.set_offset(first);
  }
  void write(const Message& answer, std::string& to) override {
    const auto& chunk = static_cast<const v1::DownloadResultResponse&>(answer);
    to += chunk.data();
    size = chunk.total_size();
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
    to += history_csv(page.samples(), decimal_, next_.page_token().empty());
    next_.set_page_token(page.next_page_token());
  }
  [[nodiscard]] bool has_more() const override { return !next_.page_token().empty(); }

 private:
  Decimal decimal_;
  v1::GetHistoryRequest next_;
};

struct CsvForm {
  Decimal decimal = Decimal::point;
  bool each = false;  ///< a row per job instead of means over the seeds
};

/// Gathers the rows, as a table may sum up several.
class SweepDownload final : public Download {
 public:
  SweepDownload(const std::string& id, const CsvForm& form) : form_(form) {
    method = "/cellcrush.v1.Sweeps/GetSweepTable";
    content_type = kCsv;
    file_name = "sweep-" + id + ".csv";
    next_.set_name("sweeps/" + id);
  }

  void ask(Message& request) const override { request.CopyFrom(next_); }
  void write(const Message& answer, std::string& to) override {
    const auto& page = static_cast<const v1::SweepTable&>(answer);
    if (!page.fields().empty()) table_.clear_fields();  // on each first page
    table_.MergeFrom(page);
    next_.set_page_token(page.next_page_token());
    if (!next_.page_token().empty()) return;
    // After the rows of the jobs, the means over their seeds, if they vary.
    const bool seeds = std::ranges::find(table_.fields(), kSeedField) != table_.fields().end();
    has_more_ = seeds && !form_.each && !next_.mean_over_seeds();
    next_.set_mean_over_seeds(has_more_);
    if (!has_more_) to += sweep_table_csv(shown_table(table_, form_.each), form_.decimal);
  }
  [[nodiscard]] bool has_more() const override { return has_more_; }

 private:
  CsvForm form_;
  bool has_more_ = true;
  v1::GetSweepTableRequest next_;
  v1::SweepTable table_;
};

// The parameters behind the question mark.
CsvForm read_form(std::string_view query, bool is_sweep) {
  CsvForm out;
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), part.size() + 1));
    if (part == "decimal=comma" || part == "decimal=point") {
      out.decimal = decimal_of(part == "decimal=comma");
    } else if (is_sweep && (part == "each=0" || part == "each=1")) {
      out.each = part == "each=1";
    } else {
      throw ServiceError(ServiceError::Kind::invalid,
                         fmt::format("The parameter \"{}\" is not valid. A CSV file has the parameter decimal=comma or "
                                     "decimal=point, that of a sweep also each=1 for a row per job.",
                                     part));
    }
  }
  return out;
}

// The text between both ends of the path; empty if it has others, or more folders between.
std::string between(std::string_view path, std::string_view start, std::string_view end) {
  if (path.size() <= start.size() + end.size() || !path.starts_with(start) || !path.ends_with(end)) return {};
  path = path.substr(start.size(), path.size() - start.size() - end.size());
  return path.find('/') == std::string_view::npos ? std::string(path) : std::string();
}

}  // namespace

void Download::begin_at(std::string_view range) {
  constexpr std::string_view kStart = "bytes=";
  std::int64_t from = 0;
  const bool is_from =
      range.starts_with(kStart) && range.ends_with('-') &&
      absl::SimpleAtoi(std::string(range.substr(kStart.size(), range.size() - kStart.size() - 1)), &from);
  if (has_ranges && is_from && from > 0) first = from;
}

void describe(const Download& file, boost::beast::http::response_header<>& to) {
  using Field = boost::beast::http::field;
  to.set(Field::content_disposition, "attachment; filename=\"" + file.file_name + "\"");
  if (!file.size) return;
  to.set(Field::accept_ranges, "bytes");
  to.set(Field::content_length, std::to_string(*file.size - file.first));
  if (file.first == 0) return;
  to.result(boost::beast::http::status::partial_content);
  to.set(Field::content_range, fmt::format("bytes {}-{}/{}", file.first, *file.size - 1, *file.size));
}

std::shared_ptr<Download> open_download(std::string_view target) {
  const std::string_view path = target.substr(0, target.find('?'));
  const std::string_view query = path.size() < target.size() ? target.substr(path.size() + 1) : std::string_view();
  if (const auto id = between(path, "/jobs/", "/history.csv"); !id.empty())
    return std::make_shared<HistoryDownload>(id, read_form(query, false).decimal);
  if (const auto id = between(path, "/sweeps/", ".csv"); !id.empty())
    return std::make_shared<SweepDownload>(id, read_form(query, true));
  const auto id = between(path, "/jobs/", "/result.h5");
  if (id.empty()) return nullptr;
  if (!query.empty()) {
    throw ServiceError(
        ServiceError::Kind::invalid,
        fmt::format("The parameter \"{}\" is not valid: result.h5 has no parameters. Leave it out.", query));
  }
  return std::make_shared<ResultDownload>(id);
}

bool is_download(std::string_view target) { return open_download(target.substr(0, target.find('?'))) != nullptr; }

}  // namespace cellcrush::http
