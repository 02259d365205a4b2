// The configuration file of the package, and the check of options before a start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "checked_options.h"
#include "command_line/daemon_flags.h"
#include "error.h"
#include "programs/temporary_folder.h"
#include "usage/command_entries.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// The options that a daemon has with a file of this text.
DaemonOptions options_with(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "cellcrushd.toml";
  std::ofstream(file) << text;
  CLI::App app("", "cellcrushd");
  const DaemonFlags flags(app);
  app.parse("--config " + file.string());
  return flags.options();
}

class ConfigFileTest : public ::testing::Test {
 protected:
  CLI::App app_{"", "cellcrushd"};
  DaemonFlags flags_{app_};
};

TEST_F(ConfigFileTest, HasEveryOptionAndSetsThoseGiven) {
  const std::string text = config_file(app_, {{"http", "\"none\""}, {"listen", "[\"unix:/a\", \"unix:/b\"]"}});
  for (const OptionEntry& option : option_entries(app_)) {
    const std::string key = option.names.back().substr(2);
    if (key == "help" || key == "config") continue;
    const bool is_set = key == "http" || key == "listen";
    EXPECT_THAT(text, HasSubstr((is_set ? "\n" : "\n#") + key + " = "));
  }
  const DaemonOptions options = options_with(text);
  EXPECT_EQ(options.http, "none");
  EXPECT_THAT(options.listen, ::testing::ElementsAre("unix:/a", "unix:/b"));
  EXPECT_EQ(options.limits.queued_jobs, DaemonOptions().limits.queued_jobs);
}

TEST_F(ConfigFileTest, ShowsDefaultsThatMayBeSetAsTheyStand) {
  const std::string text = config_file(app_, {});
  const std::string set = std::regex_replace(text, std::regex("\n#([a-z-]+ = [0-9.]+\n)"), "\n$1");
  ASSERT_NE(set, text);
  const DaemonOptions options = options_with(set);
  const DaemonOptions defaults = options_with("");
  EXPECT_EQ(options.limits.queued_jobs, defaults.limits.queued_jobs);
  EXPECT_EQ(options.limits.free_disk_bytes, defaults.limits.free_disk_bytes);
  EXPECT_EQ(options.checkpoint_interval, defaults.checkpoint_interval);
  EXPECT_EQ(options.connections.streams, defaults.connections.streams);
  EXPECT_EQ(options.keep.count, defaults.keep.count);
}

TEST_F(ConfigFileTest, AKeyThatStandsTwiceIsRefused) {
  EXPECT_THROW(options_with("listen = [\"unix:/a\"]\nworkers = 1\nlisten = [\"unix:/b\"]\n"), CLI::ConfigError);
}

TEST(CheckOptions, TellsWhatADaemonWouldDoAndChangesNothing) {
  const TemporaryFolder folder;
  DaemonOptions options;
  options.data_folder = folder.path() / "data";
  options.listen = {"unix:" + (folder.path() / "socket").string()};
  options.http = "none";
  const auto told = check_options(options);
  EXPECT_THAT(told, Contains("data in " + options.data_folder.string()));
  EXPECT_THAT(told, Contains("gRPC at " + options.listen.front()));
  EXPECT_THAT(told, Contains("no HTTP"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CheckOptions, RefusesWhatADaemonWould) {
  const auto refused = [](const std::function<void(DaemonOptions&)>& change) -> std::string {
    DaemonOptions options;
    options.data_folder = "/nowhere";
    change(options);
    try {
      check_options(options);
    } catch (const ServiceError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused([](DaemonOptions&) {}), "");
  EXPECT_THAT(refused([](DaemonOptions& options) { options.listen = {"0.0.0.0:0"}; }), HasSubstr("without TLS"));
  EXPECT_THAT(refused([](DaemonOptions& options) { options.access.tokens = "/none"; }), HasSubstr("/none"));
  EXPECT_THAT(refused([](DaemonOptions& options) { options.default_executor = "slurm/x"; }),
              HasSubstr("this daemon has local"));
  EXPECT_THAT(refused([](DaemonOptions& options) { options.device = "none-such"; }), HasSubstr("--device"));
}

}  // namespace
}  // namespace cellcrush
