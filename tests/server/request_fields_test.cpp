// What strings clients send, so that no one of them comes to be used as a path in the daemon's files unnoticed.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor_database.h>

#include <set>
#include <string>

#include "cellcrush/v1/admin_service.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "store/resource_name.h"

namespace cellcrush {
namespace {

using google::protobuf::Descriptor;

void collect_texts(const Descriptor& message, std::set<std::string>& seen, std::set<std::string>& texts) {
  if (!seen.insert(message.full_name()).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    if (field.message_type() != nullptr) collect_texts(*field.message_type(), seen, texts);
    if (field.cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_STRING)
      texts.insert(field.full_name().substr(std::string("cellcrush.v1.").size()));
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
      // Names of resources and presets.
      "GetJobRequest.name", "CancelJobRequest.name", "SuspendJobRequest.name", "ResumeJobRequest.name",
      "DeleteJobRequest.name", "DeleteSweepRequest.name", "WatchJobRequest.name", "GetHistoryRequest.name",
      "GetFrameRequest.name", "DownloadResultRequest.name", "GetSweepRequest.name", "CancelSweepRequest.name",
      "RetryFailedJobsRequest.name", "WatchSweepRequest.name", "GetSweepTableRequest.name", "GetPresetRequest.name",
      "GetConvergenceRequest.name", "StreamFramesRequest.name", "ExportJobRequest.name",
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
      // Of a sweep: paths of fields in a case, and what the daemon writes itself and takes from nobody.
      "SweepAxis.field", "SweepPoint.FieldsEntry.key", "Sweep.name", "Sweep.jobs", "Sweep.owner",
      "Sweep.StateCountsEntry.key", "Problem.field", "Problem.value", "Problem.message", "Problem.remedy",
      "CaseWords.lattice", "CaseWords.loading", "CaseWords.theory_note", "CaseWords.Fact.heading",
      "CaseWords.Fact.text",
      // Of a case: its title and the ids of a frame.
      "Case.title", "Frame.Node.id", "Frame.Beam.start", "Frame.Beam.end", "Frame.Support.node", "Frame.NodalLoad.node",
      "Frame.NodalMotion.node", "Frame.InitialVelocity.node", "Frame.RigidWall.id", "Frame.watched_nodes"};
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
}  // namespace cellcrush
