// The API: what no version may lose (data/api-VERSION.binpb, the descriptor set of each), and what strings clients
// send, so that no one of them comes to be used as a path in the daemon's files unnoticed.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/descriptor_database.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "store/resource_name.h"

namespace cellcrush::testing {
namespace {

using google::protobuf::Descriptor;

namespace pb = google::protobuf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Comparison {
 public:
  explicit Comparison(const pb::DescriptorPool& now) : now_(now) {}

  void compare(const pb::FileDescriptor& file) {
    for (int i = 0; i < file.message_type_count(); ++i) compare(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) compare(*file.enum_type(i));
    for (int i = 0; i < file.service_count(); ++i) compare(*file.service(i));
  }

  std::vector<std::string> breaks;

 private:
  void add(const std::string& what, const std::string& why) { breaks.push_back(what + " " + why + "."); }

  void compare(const pb::Descriptor& before) {
    const auto* after = now_.FindMessageTypeByName(before.full_name());
    if (after == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.field_count(); ++i) compare(*before.field(i), *after);
    for (int i = 0; i < before.nested_type_count(); ++i) compare(*before.nested_type(i));
    for (int i = 0; i < before.enum_type_count(); ++i) compare(*before.enum_type(i));
  }

  void compare(const pb::FieldDescriptor& before, const pb::Descriptor& message) {
    const auto* after = message.FindFieldByNumber(before.number());
    if (after == nullptr) {
      if (!message.IsReservedNumber(before.number())) add(before.full_name(), "is gone, and its number not reserved");
      return;
    }
    if (after->name() != before.name()) add(before.full_name(), "is called " + after->name());
    if (type_of(*after) != type_of(before)) add(before.full_name(), "has type " + type_of(*after));
    if (oneof_of(*after) != oneof_of(before)) add(before.full_name(), "is in another oneof");
  }

  void compare(const pb::EnumDescriptor& before) {
    const auto* after = now_.FindEnumTypeByName(before.full_name());
    if (after == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.value_count(); ++i) {
      const auto& value = *before.value(i);
      const auto* same = after->FindValueByNumber(value.number());
      if (same == nullptr && !after->IsReservedNumber(value.number()))
        add(value.full_name(), "is gone, and its number not reserved");
      if (same != nullptr && same->name() != value.name()) add(value.full_name(), "is called " + same->name());
    }
  }

  void compare(const pb::ServiceDescriptor& before) {
    const auto* service = now_.FindServiceByName(before.full_name());
    if (service == nullptr) return add(before.full_name(), "is gone");
    for (int i = 0; i < before.method_count(); ++i) {
      const auto& method = *before.method(i);
      const auto* after = service->FindMethodByName(method.name());
      if (after == nullptr) {
        add(method.full_name(), "is gone");
      } else if (signature_of(*after) != signature_of(method)) {
        add(method.full_name(), "is now " + signature_of(*after));
      }
    }
  }

  static std::string type_of(const pb::FieldDescriptor& field) {
    std::string out = field.is_repeated() ? "repeated " : field.has_optional_keyword() ? "optional " : "";
    if (field.message_type() != nullptr) return out + field.message_type()->full_name();
    if (field.enum_type() != nullptr) return out + field.enum_type()->full_name();
    return out + field.type_name();
  }

  static std::string oneof_of(const pb::FieldDescriptor& field) {
    return field.real_containing_oneof() == nullptr ? "" : field.real_containing_oneof()->name();
  }

  static std::string signature_of(const pb::MethodDescriptor& method) {
    return std::string(method.client_streaming() ? "stream " : "") + method.input_type()->full_name() + " -> " +
           (method.server_streaming() ? "stream " : "") + method.output_type()->full_name();
  }

  const pb::DescriptorPool& now_;
};

// What a client built for the old files would miss in the present pool, one sentence each: messages, fields, values of
// enums and methods that are gone or have another name, number, type, label, oneof or streaming. What was removed is no
// break if its number and name are reserved.
std::vector<std::string> api_breaks(const std::vector<const pb::FileDescriptor*>& old_files,
                                    const pb::DescriptorPool& now) {
  Comparison comparison(now);
  for (const auto* file : old_files) comparison.compare(*file);
  return comparison.breaks;
}

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
  using Set = pb::FileDescriptorSet;
  using Field = pb::FieldDescriptorProto;
  const auto add_field = [](Set& set) {
    auto& field = *message_in(set, "Progress").add_field();
    field.set_name("gone");
    field.set_number(99);
    field.set_label(Field::LABEL_OPTIONAL);
    field.set_type(Field::TYPE_DOUBLE);
  };
  const auto add_value = [](Set& set) {
    auto& value = *message_in(set, "Job").mutable_enum_type(0)->add_value();
    value.set_name("PAUSED");
    value.set_number(77);
  };
  const auto make_stream = [](Set& set) {
    for (auto& file : *set.mutable_file()) {
      if (file.service_size() > 0 && file.service(0).name() == "Jobs")
        file.mutable_service(0)->mutable_method(0)->set_server_streaming(true);
    }
  };
  const auto step = [](Set& set) -> Field& { return field_in(message_in(set, "Progress"), "step"); };
  EXPECT_THAT(breaks_after(add_field), ElementsAre("cellcrush.v1.Progress.gone is gone, and its number not reserved."));
  EXPECT_THAT(breaks_after([&](Set& set) { step(set).set_name("steps"); }),
              ElementsAre("cellcrush.v1.Progress.steps is called step."));
  EXPECT_THAT(breaks_after([&](Set& set) { step(set).set_type(Field::TYPE_INT32); }),
              ElementsAre("cellcrush.v1.Progress.step has type int64."));
  EXPECT_THAT(breaks_after([&](Set& set) { step(set).set_label(Field::LABEL_REPEATED); }),
              ElementsAre("cellcrush.v1.Progress.step has type int64."));
  EXPECT_THAT(breaks_after([](Set& set) { field_in(message_in(set, "JobEvent"), "sequence").set_oneof_index(0); }),
              ElementsAre("cellcrush.v1.JobEvent.sequence is in another oneof."));
  EXPECT_THAT(breaks_after(add_value), ElementsAre("cellcrush.v1.Job.PAUSED is gone, and its number not reserved."));
  EXPECT_THAT(breaks_after(make_stream), ElementsAre(HasSubstr("cellcrush.v1.Jobs.CreateJob is now cellcrush.v1.")));
}

void collect_texts(const Descriptor& message, std::set<std::string>& seen, std::set<std::string>& texts) {
  if (!seen.insert(message.full_name()).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    if (field.message_type() != nullptr) collect_texts(*field.message_type(), seen, texts);
    const std::string package = "cellcrush.v1.";
    if (field.cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_STRING && field.full_name().starts_with(package))
      texts.insert(field.full_name().substr(package.size()));
  }
}

std::set<std::string> texts_of_requests() {
  std::set<std::string> seen;
  std::set<std::string> texts;
  for (const auto* file : {v1::GetCapabilitiesRequest::descriptor()->file(), v1::CheckCaseRequest::descriptor()->file(),
                           v1::CreateJobRequest::descriptor()->file(), v1::CreateSweepRequest::descriptor()->file()}) {
    for (int i = 0; i < file->service_count(); ++i) {
      for (int k = 0; k < file->service(i)->method_count(); ++k)
        collect_texts(*file->service(i)->method(k)->input_type(), seen, texts);
    }
  }
  return texts;
}

// A field that comes to a request must be added here, by one who has looked at what the daemon does with it. None of
// these is a path: names become numbers (store/resource_name.h) before a folder is named after one, the others are kept
// or compared as they are.
TEST(RequestFields, NoTextOfARequestNamesAFileOfTheDaemon) {
  const std::set<std::string> known = {
      // Names of resources, presets and pages.
      "GetJobRequest.name", "CancelJobRequest.name", "SuspendJobRequest.name", "ResumeJobRequest.name",
      "DeleteJobRequest.name", "DeleteSweepRequest.name", "WatchJobRequest.name", "GetHistoryRequest.name",
      "GetFrameRequest.name", "DownloadResultRequest.name", "GetSweepRequest.name", "CancelSweepRequest.name",
      "RetryFailedJobsRequest.name", "WatchSweepRequest.name", "GetSweepTableRequest.name", "GetPresetRequest.name",
      "GetConvergenceRequest.name", "StreamFramesRequest.name", "ExportJobRequest.name", "CreateLinkRequest.page",
      // Of lists, of repeated calls and of resumed watches.
      "ListJobsRequest.page_token", "ListJobsRequest.filter", "ListJobsRequest.order_by", "WatchJobsRequest.filter",
      "WatchJobsRequest.resume_token", "ListSweepsRequest.page_token", "GetHistoryRequest.page_token",
      "GetSweepTableRequest.page_token", "CreateJobRequest.request_id", "CreateSweepRequest.request_id",
      "WatchSweepRequest.resume_token", "WatchJobRequest.epoch",
      // Of executors: compared with those that the daemon has.
      "CreateJobRequest.executor", "Sweep.executor",
      // Labels: key and value.
      "CreateJobRequest.LabelsEntry.key", "CreateJobRequest.LabelsEntry.value", "Sweep.LabelsEntry.key",
      "Sweep.LabelsEntry.value",
      // Notes.
      "CreateJobRequest.note", "Job.note", "Sweep.note", "UpdateJobRequest.previous_note",
      "UpdateSweepRequest.previous_note",
      // Of a job to be updated: of these, the daemon reads its name only.
      "Job.name", "Job.LabelsEntry.key", "Job.LabelsEntry.value", "Job.cause_message", "Job.executor", "Job.owner",
      "Job.place", "Job.remedy", "Job.retry_of", "Job.sweep", "Job.title", "RigidWallSummary.wall",
      "Summary.crush_mode_words", "Summary.end_words", "Summary.other_rise_words", "Warning.message", "Warning.remedy",
      // Of a sweep: paths of fields in a case, and what the daemon writes itself and takes from nobody.
      "SweepAxis.field", "SweepPoint.FieldsEntry.key", "Sweep.name", "Sweep.jobs", "Sweep.owner",
      "Sweep.StateCountsEntry.key", "Problem.field", "Problem.value", "Problem.message", "Problem.remedy",
      "CaseWords.lattice", "CaseWords.loading", "CaseWords.theory_note", "CaseWords.Fact.heading",
      "CaseWords.Fact.text",
      // Of a drawing to be imported: its bytes, its name with the ending that tells the format, its unit.
      "ImportLatticeRequest.File.content", "ImportLatticeRequest.File.name", "ImportLatticeRequest.unit",
      // Of a test to be compared: its text and the name for messages; columns; ids of parts, compared with those of the
      // job.
      "CompareTestRequest.name", "CompareTestRequest.TestFile.name", "CompareTestRequest.TestFile.text",
      "CompareTestRequest.columns", "CompareTestRequest.force_part", "CompareTestRequest.displacement_part",
      // Of a case: the name of a material, compared with those that the daemon has.
      "Material.named",
      // Of a case: its title and the ids of a frame and of grips.
      "Loading.Grip.id", "Case.title", "Frame.Node.id", "Frame.Beam.start", "Frame.Beam.end", "Frame.Support.node",
      "Frame.NodalLoad.node", "Frame.NodalMotion.node", "Frame.InitialVelocity.node", "Frame.RigidWall.id",
      "Frame.watched_nodes"};
  EXPECT_THAT(texts_of_requests(), ::testing::ContainerEq(known));
}

TEST(RequestFields, NoNameWithAWayThroughFoldersIsANumber) {
  for (const char* name : {"jobs/../1", "jobs/1/..", "jobs/1/../2", "../jobs/1", "/jobs/1", "jobs//1", "jobs/./1",
                           "jobs/01", "jobs/+1", "jobs/-1", "jobs/1 ", "jobs/", "jobs/18446744073709551617", ""})
    EXPECT_FALSE(store::number_of(name)) << name;
  EXPECT_FALSE(store::number_of(std::string("jobs/1\0", 7)));
  EXPECT_EQ(store::number_of("jobs/1"), 1);
}

}  // namespace
}  // namespace cellcrush::testing
