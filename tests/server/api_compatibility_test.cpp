// The API against that of earlier versions: data/api-VERSION.binpb, the descriptor set of each.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.pb.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "server/api_breaks.h"

namespace cellcrush::testing {
namespace {

namespace pb = google::protobuf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The files of cellcrush.v1 in a set, in a pool of their own.
class OldApi {
 public:
  explicit OldApi(const pb::FileDescriptorSet& set) {
    for (const auto& file : set.file()) {
      const auto* built = pool_.BuildFile(file);
      if (built == nullptr) throw std::runtime_error("cannot read " + file.name());
      if (built->package() == "cellcrush.v1") files.push_back(built);
    }
  }
  std::vector<const pb::FileDescriptor*> files;

 private:
  pb::DescriptorPool pool_;
};

void add_with_imports(const pb::FileDescriptor& file, pb::FileDescriptorSet& set) {
  for (const auto& present : set.file()) {
    if (present.name() == file.name()) return;
  }
  for (int i = 0; i < file.dependency_count(); ++i) add_with_imports(*file.dependency(i), set);
  file.CopyTo(set.add_file());
}

pb::FileDescriptorSet present_api() {
  pb::FileDescriptorSet out;
  for (const auto* service : {v1::CheckCaseRequest::descriptor(), v1::GetJobRequest::descriptor(),
                              v1::GetSweepRequest::descriptor(), v1::DrainRequest::descriptor()})
    add_with_imports(*service->file(), out);
  return out;
}

const pb::DescriptorPool& now() { return *pb::DescriptorPool::generated_pool(); }

TEST(ApiCompatibility, NothingThatAnEarlierVersionHadIsGone) {
  int versions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(API_FOLDER)) {
    if (entry.path().extension() != ".binpb") continue;
    ++versions;
    std::ifstream file(entry.path(), std::ios::binary);
    pb::FileDescriptorSet set;
    ASSERT_TRUE(set.ParseFromIstream(&file)) << entry.path();
    const OldApi old(set);
    EXPECT_GE(old.files.size(), 10U);
    EXPECT_THAT(api_breaks(old.files, now()), IsEmpty()) << entry.path();
  }
  EXPECT_GE(versions, 1);
}

// Writes the set of the present API, for a release: its file is added then and never changed.
TEST(ApiCompatibility, ThePresentApiIsKeptForTheNextVersions) {
  const char* const path = std::getenv("CELLCRUSH_WRITE_API");
  if (path == nullptr) {
    const OldApi old(present_api());
    EXPECT_THAT(api_breaks(old.files, now()), IsEmpty());
    return;
  }
  std::ofstream file(path, std::ios::binary);
  EXPECT_TRUE(present_api().SerializeToOstream(&file));
}

// Breaks between the present API and one in which `change` has altered what a proto has.
std::vector<std::string> breaks_after(const std::function<void(pb::FileDescriptorSet&)>& change) {
  auto set = present_api();
  change(set);
  return api_breaks(OldApi(set).files, now());
}

pb::DescriptorProto& message_in(pb::FileDescriptorSet& set, const std::string& name) {
  for (auto& file : *set.mutable_file()) {
    for (auto& message : *file.mutable_message_type()) {
      if (message.name() == name) return message;
    }
  }
  throw std::runtime_error("no message " + name);
}

pb::FieldDescriptorProto& field_in(pb::DescriptorProto& message, const std::string& name) {
  for (auto& field : *message.mutable_field()) {
    if (field.name() == name) return field;
  }
  throw std::runtime_error("no field " + name);
}

TEST(ApiCompatibility, EveryKindOfBreakIsSeen) {
  EXPECT_THAT(breaks_after([](auto& set) {
                auto& field = *message_in(set, "Progress").add_field();
                field.set_name("gone");
                field.set_number(99);
                field.set_label(pb::FieldDescriptorProto::LABEL_OPTIONAL);
                field.set_type(pb::FieldDescriptorProto::TYPE_DOUBLE);
              }),
              ElementsAre("cellcrush.v1.Progress.gone is gone, and its number not reserved."));
  EXPECT_THAT(breaks_after([](auto& set) { field_in(message_in(set, "Progress"), "step").set_name("steps"); }),
              ElementsAre("cellcrush.v1.Progress.steps is called step."));
  EXPECT_THAT(breaks_after([](auto& set) {
                field_in(message_in(set, "Progress"), "step").set_type(pb::FieldDescriptorProto::TYPE_INT32);
              }),
              ElementsAre("cellcrush.v1.Progress.step has type int64."));
  EXPECT_THAT(breaks_after([](auto& set) {
                field_in(message_in(set, "Progress"), "step").set_label(pb::FieldDescriptorProto::LABEL_REPEATED);
              }),
              ElementsAre("cellcrush.v1.Progress.step has type int64."));
  EXPECT_THAT(breaks_after([](auto& set) { field_in(message_in(set, "JobEvent"), "sequence").set_oneof_index(0); }),
              ElementsAre("cellcrush.v1.JobEvent.sequence is in another oneof."));
  EXPECT_THAT(breaks_after([](auto& set) {
                auto& value = *message_in(set, "Job").mutable_enum_type(0)->add_value();
                value.set_name("PAUSED");
                value.set_number(77);
              }),
              ElementsAre("cellcrush.v1.Job.PAUSED is gone, and its number not reserved."));
  EXPECT_THAT(breaks_after([](auto& set) {
                for (auto& file : *set.mutable_file()) {
                  for (auto& service : *file.mutable_service()) {
                    for (auto& method : *service.mutable_method()) {
                      if (method.name() == "GetJob") method.set_server_streaming(true);
                    }
                  }
                }
              }),
              ElementsAre(HasSubstr("cellcrush.v1.Jobs.GetJob is now cellcrush.v1.GetJobRequest ->")));
}

}  // namespace
}  // namespace cellcrush::testing
