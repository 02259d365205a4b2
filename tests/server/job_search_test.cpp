// How the journal finds jobs: by indexes, with the columns that an earlier version did not have.
#include <gmock/gmock.h>

#include "access/token_file.h"
#include "access/unix_user.h"
#include "error.h"
#include "server/journal_fixture.h"
#include "store/job_filter.h"

namespace cellcrush::store {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class JobSearchTest : public JournalTest {
 protected:
  std::int64_t make(const std::string& owner, const std::string& title, const std::string& batch) {
    v1::Job job;
    *job.mutable_case_() = testing::small_case();
    job.mutable_case_()->set_title(title);
    job.set_owner(owner);
    (*job.mutable_labels())["batch"] = batch;
    return journal_->create_job(job, "", "").job;
  }
};

// Every combination of conditions that a filter can have.
std::vector<JobFilter> all_filters() {
  std::vector<JobFilter> out;
  for (int i = 1; i < 16; ++i) {
    JobFilter& filter = out.emplace_back();
    if ((i & 1) != 0) filter.states = {v1::Job::RUNNING};
    if ((i & 2) != 0) filter.owners = {"anna"};
    if ((i & 4) != 0) filter.labels = {{"batch", "one"}, {"who", "me"}};
    if ((i & 8) != 0) filter.titles = {"few"};
  }
  out.emplace_back().labels = {{"batch", "one"}};
  return out;
}

// As JournalReader::read_batch selects the numbers of a page.
std::string search_of(const JobConditions& conditions) {
  const std::string number = conditions.numbers().column;
  return "SELECT " + number + " FROM " + conditions.numbers().table + " WHERE " + number + " > ?1 AND " + number +
         " < ?2" + conditions.sql() + " ORDER BY " + number + " DESC LIMIT ?3";
}

TEST_F(JobSearchTest, APageOfALabelReadsItsOwnRowsOnlyHoweverManyJobsHaveTheLabel) {
  JobFilter filter;
  filter.labels = {{"batch", "one"}};
  Database database(path());
  Statement plan(database, "EXPLAIN QUERY PLAN " + search_of(JobConditions(filter, 4)));
  std::vector<std::string> steps;
  while (plan.step()) steps.push_back(plan.bytes(3));
  EXPECT_THAT(steps, ElementsAre("SEARCH job_labels USING PRIMARY KEY (key=? AND value=? AND job>? AND job<?)"));
  std::vector<std::int64_t> made;
  for (int i = 0; i < 500; ++i) made.push_back(make("anna", "A case", i % 5 == 0 ? "two" : "one"));
  std::vector<std::int64_t> listed;
  for (std::int64_t after = 0; listed.size() < 400;) {
    const auto page = reader_->list_jobs(filter, false, after, 90);
    ASSERT_FALSE(page.empty());
    for (const auto& job : page) listed.push_back(job.number);
    after = listed.back();
  }
  for (int i = 499; i >= 0; i -= 5) made.erase(made.begin() + i / 5 * 5);
  EXPECT_EQ(listed, made);
}

TEST_F(JobSearchTest, NoFilterReadsTheRowsOfJobsThatAreNotWanted) {
  for (int i = 0; i < 300; ++i) make(i % 2 == 0 ? "anna" : "bob", "A case", "one");
  Database database(path());
  for (const auto& filter : all_filters()) {
    const JobConditions conditions(filter, 4);
    Statement plan(database, "EXPLAIN QUERY PLAN " + search_of(conditions));
    while (plan.step()) {
      const std::string step = plan.bytes(3);
      EXPECT_THAT(step, Not(HasSubstr("SCAN"))) << conditions.sql();
      // By its number alone a job is looked up where the labels name it.
      if (step.find("INTEGER PRIMARY KEY") != std::string::npos) {
        EXPECT_THAT(step, HasSubstr("rowid=?")) << conditions.sql();
      }
      EXPECT_THAT(step, Not(HasSubstr("TEMP B-TREE"))) << conditions.sql();
    }
  }
}

TEST_F(JobSearchTest, ARequestOfAnEarlierVersionIsThatOfTheDaemonsOwnUser) {
  const auto first = create("id", "hash");
  v1::Job again;
  again.set_owner(access::own_user());
  EXPECT_EQ(journal_->create_job(again, "id", "hash").job, first);
  v1::Job of_local;
  of_local.set_owner(access::kLocal);
  const auto second = journal_->create_job(of_local, "another", "hash").job;
  EXPECT_EQ(journal_->create_job(again, "another", "hash").job, second);
  again.set_owner("anna");
  EXPECT_NE(journal_->create_job(again, "id", "hash anna").job, first);
}

TEST_F(JobSearchTest, AListThatNobodyWaitsForEnds) {
  for (int i = 0; i < 450; ++i) create();
  int asked = 0;
  const auto given_up = [&asked] { return ++asked > 2; };
  EXPECT_THROW(reader_->list_jobs({}, true, 0, 1000, 1'000'000'000, given_up), ServiceError);
  EXPECT_EQ(asked, 3) << "It is asked between batches.";
}

}  // namespace
}  // namespace cellcrush::store
