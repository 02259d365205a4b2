// Nobody changes the API, the result file or the numbers of a run under the same version.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "revision.h"
#include "store/case_hash.h"

namespace cellcrush::testing {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

void add_file(const google::protobuf::FileDescriptor& file, std::set<std::string>& out) {
  if (!file.package().starts_with("cellcrush.")) return;
  google::protobuf::FileDescriptorProto proto;
  file.CopyTo(&proto);
  out.insert(proto.SerializeAsString());
  for (int i = 0; i < file.dependency_count(); ++i) add_file(*file.dependency(i), out);
}

// All messages and methods, without comments.
std::string api() {
  std::set<std::string> files;
  for (const auto* file : {v1::Capabilities::descriptor()->file(), v1::CheckCaseRequest::descriptor()->file(),
                           v1::CreateJobRequest::descriptor()->file(), v1::CreateSweepRequest::descriptor()->file()})
    add_file(*file, files);
  std::string out;
  for (const auto& file : files) out += file;
  return out;
}

// The names that result_format.md gives, which the tests of the result file hold against files.
std::string result_names() {
  const std::string page = read(RESULT_FORMAT);
  const std::regex cell("\n(?:\\| |\\* )(`[^|\n]*`)");
  std::set<std::string> names;
  for (auto found = std::sregex_iterator(page.begin(), page.end(), cell); found != std::sregex_iterator(); ++found)
    names.insert((*found)[1]);
  EXPECT_GT(names.size(), 50U);
  std::string out;
  for (const auto& name : names) out += name + "\n";
  return out;
}

TEST(Versions, AreRaisedWithWhatTheyName) {
  const std::filesystem::path recorded = std::filesystem::path(API_FOLDER) / "versions.csv";
  const std::map<std::string, std::pair<std::string, std::string>> now = {
      {"api", {kApiVersion, store::sha256_of(api()).substr(0, 16)}},
      {"result", {kResultVersion, store::sha256_of(result_names()).substr(0, 16)}},
      {"solver", {kSolverVersion, store::sha256_of(read(GOLDEN_HASHES)).substr(0, 16)}}};
  if (std::getenv("CELLCRUSH_WRITE_VERSIONS") != nullptr) {
    std::ofstream file(recorded);
    file << "part,version,hash\n";
    for (const auto& [part, entry] : now) file << part << "," << entry.first << "," << entry.second << "\n";
  }
  std::istringstream lines(read(recorded));
  std::string line;
  std::getline(lines, line);
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    const auto first = line.find(',');
    const auto second = line.rfind(',');
    const std::string part = line.substr(0, first);
    const auto& [version, hash] = now.at(part);
    ++count;
    EXPECT_EQ(line.substr(second + 1), hash)
        << part << " is another one. Raise its version in CMakeLists.txt, then run this test with "
        << "CELLCRUSH_WRITE_VERSIONS=1.";
    EXPECT_EQ(line.substr(first + 1, second - first - 1), version)
        << "Record " << part << " with CELLCRUSH_WRITE_VERSIONS=1.";
  }
  EXPECT_EQ(count, now.size());
}

}  // namespace
}  // namespace cellcrush::testing
