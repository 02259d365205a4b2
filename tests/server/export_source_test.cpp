#include "rpc/export_source.h"

#include <gmock/gmock.h>

#include "error.h"
#include "server/small_case.h"
#include "server/temporary_folder.h"
#include "store/journal.h"
#include "store/resource_name.h"

namespace cellcrush::rpc {
namespace {

TEST(ExportSource, AJobThatIsDeletedMeanwhileIsAnErrorNotAFileWithoutItsResults) {
  const testing::TemporaryFolder folder;
  const store::DataFolder data(folder.path() / "data");
  store::Journal journal(data.journal(), [](std::int64_t) {});
  store::JournalReader reader(data.journal());
  jobs::MeshPlaces places;
  ExportPlaces exports;
  v1::Job created;
  *created.mutable_case_() = testing::small_case();
  const std::int64_t job = journal.create_job(created, "", "").job;
  store::StateChange change;
  change.state = v1::Job::CANCELLED;
  journal.change_state(job, change);
  v1::ExportJobRequest request;
  request.set_name(store::name_of(job));
  const auto stored = reader.find_job(job);
  ASSERT_TRUE(stored);
  {
    ExportSource whole({data, reader, places, exports}, *stored, request);
    while (!whole.ended()) ASSERT_TRUE(whole.next());
  }
  const auto open = [&] {
    return std::make_unique<ExportSource>(ExportSource::Parts{data, reader, places, exports}, *stored, request);
  };
  std::vector<std::unique_ptr<ExportSource>> others;
  for (int i = 0; i < ExportPlaces::kMost; ++i) others.push_back(open());
  EXPECT_THROW(open(), ServiceError) << "All places are taken.";
  others.clear();
  ExportSource source({data, reader, places, exports}, *stored, request);
  ASSERT_TRUE(source.next()) << "the head";
  journal.delete_job(job);
  try {
    while (!source.ended()) source.next();
    FAIL() << "The file ended.";
  } catch (const ServiceError& error) {
    EXPECT_EQ(error.kind(), ServiceError::Kind::not_found);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("was deleted while it was exported"));
  }
}

}  // namespace
}  // namespace cellcrush::rpc
