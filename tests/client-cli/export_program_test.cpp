#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

Script script_with_page() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.page = "<!doctype html>\n<!-- cellcrush export -->\n<html lang=\"en\"></html>\n";
  return script;
}

ProgramResult export_to(const FakeServer& server, const fs::path& file, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"export", "test", "-o", file});
  return server.run(more);
}

TEST(Export, WritesThePageAndSaysWhichFramesItHas) {
  const FakeServer server(script_with_page());
  const fs::path file = server.folder() / "crush.html";
  const ProgramResult result = export_to(server, file);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(text_of_file(file), script_with_page().page);
  EXPECT_EQ(result.output, file.string() + "  66 B  3 of 5 frames; raise --max-size for more\n");
  const std::string json = export_to(server, file, {"--json"}).output;
  for (const std::string& field :
       {std::string("\"frame_count\":3"), std::string("\"job_frame_count\":5"), "\"path\":\"" + file.string() + '"'})
    EXPECT_THAT(json, HasSubstr(field));
}

TEST(Export, MaxSizeIsInMegabytes) {
  const FakeServer server(script_with_page());
  const fs::path file = server.folder() / "crush.html";
  EXPECT_EQ(export_to(server, file, {"--max-size", "2.5"}).output, file.string() + "  66 B\n");
  EXPECT_EQ(server.asked().max_bytes, std::vector<std::int64_t>{2'500'000});
  EXPECT_EQ(export_to(server, file, {"--max-size", "0"}).exit_code, 2);
}

TEST(Export, ReplacesItsOwnFilesAndNoOthers) {
  const FakeServer server(script_with_page());
  const fs::path file = server.folder() / "crush.html";
  ASSERT_EQ(export_to(server, file).exit_code, 0);
  EXPECT_EQ(export_to(server, file).exit_code, 0);
  std::ofstream(file) << "<!doctype html>\n<title>mine</title>\n";
  const ProgramResult refused = export_to(server, file);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("crush.html: exists and was not written by cellcrush"));
  EXPECT_EQ(text_of_file(file), "<!doctype html>\n<title>mine</title>\n");
}

TEST(Export, ToAnotherFormatIsRefused) {
  const FakeServer server(script_with_page());
  const ProgramResult result = server.run({"export", "jobs/1", "-o", server.folder() / "a.txt"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("a.txt: not a format of this command; give -o a name that ends in .html"));
}

TEST(Export, AStreamThatBreaksOffLeavesNoFile) {
  Script script = script_with_page();
  script.cut_export = true;
  const FakeServer server(script);
  const fs::path folder = server.folder() / "run";
  fs::create_directory(folder);
  EXPECT_EQ(export_to(server, folder / "crush.html").exit_code, 4);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Export, AJobThatHasNotEndedIsRefusedWithTheRemedy) {
  Script script = script_with_page();
  script.page.clear();
  const FakeServer server(script);
  const ProgramResult result = export_to(server, server.folder() / "crush.html");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("Wait until it has ended."));
}

}  // namespace
}  // namespace cellcrush::client::testing
