// The metrics on server/monitor.md, as a daemon serves them. CELLCRUSH_WRITE_PAGES=1 writes them into the page.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "docs/tables/page_tables.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/http/http_socket.h"

namespace cellcrush::docs {
namespace {

/// Everything that a daemon may serve: it has a device and a receiver of notices, and has run a job.
class MetricsPage : public testing::DaemonFixture {
 protected:
  void SetUp() override {
    auto options = default_options();
    options.metrics = "127.0.0.1:0";
    options.device = "emulated";
    options.notices.command = folder_.path() / "hook";
    std::ofstream(options.notices.command) << "#!/bin/sh\n";
    chmod(options.notices.command.c_str(), 0700);
    start(options);
    finished_job(testing::tiny_case());
  }

  [[nodiscard]] std::string scrape() const {
    const std::string& url = daemon_->metrics_url();
    const testing::HttpSocket socket(std::stoi(url.substr(url.rfind(':') + 1)));
    socket.send("GET /metrics HTTP/1.0\r\n\r\n");
    return socket.read_to_end();
  }
};

struct Metric {
  std::string help;
  std::string type;
  std::set<std::string> labels;
};

std::map<std::string, Metric> metrics_in(const std::string& answer) {
  std::map<std::string, Metric> out;
  std::istringstream lines(answer);
  std::string name;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string mark;
    std::string kind;
    if (line.starts_with("# ")) {
      words >> mark >> kind >> name;
      std::getline(words >> std::ws, kind == "HELP" ? out[name].help : out[name].type);
      continue;
    }
    static const std::regex kLabel("([a-z_]+)=\"");
    for (auto label = std::sregex_iterator(line.begin(), line.end(), kLabel); label != std::sregex_iterator();
         ++label) {
      if ((*label)[1] != "le") out[name].labels.insert((*label)[1]);
    }
  }
  std::erase_if(out,
                [](const auto& entry) { return entry.first.starts_with("exposer_") || entry.second.help.empty(); });
  return out;
}

std::string table_of(const std::map<std::string, Metric>& metrics) {
  PageTable table({"Metric", "Type", "Meaning"});
  for (const auto& [name, metric] : metrics) {
    std::string labels;
    for (const auto& label : metric.labels) labels += (labels.empty() ? "" : ", ") + label;
    table.add_row({"`" + name + (labels.empty() ? "" : "{" + labels + "}") + "`", metric.type, metric.help});
  }
  return table.text();
}

TEST_F(MetricsPage, ListsWhatADaemonServes) {
  std::map<std::string, Metric> found;
  testing::wait_until([&] {
    found = metrics_in(scrape());
    return found.contains("cellcrush_notices_behind") && found.contains("cellcrush_jobs_ended_total") &&
           found.contains("cellcrush_device_runs_total");
  });
  for (const auto& [name, metric] : found) {
    EXPECT_TRUE(name.starts_with("cellcrush_") || name.starts_with("process_")) << name;
    EXPECT_EQ(metric.type == "counter", name.ends_with("_total")) << name;
    EXPECT_TRUE(metric.help.ends_with(".")) << name;
  }
  const std::filesystem::path file = std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / "server/monitor.md";
  const std::string text = read_text(file);
  const FilledPage filled = fill_tables(text, {{"metrics", table_of(found)}});
  EXPECT_TRUE(filled.findings.empty()) << to_text(filled.findings);
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) {
    std::ofstream(file) << filled.text;
  } else {
    EXPECT_EQ(text, filled.text) << "Write the table again: CELLCRUSH_WRITE_PAGES=1 build/ci/bin/docs_metrics_page";
  }
}

}  // namespace
}  // namespace cellcrush::docs
