// Whose server it is, who calls it, and how a browser gets in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "connection/connection.h"
#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::HasSubstr;

Script script_of_owner(const std::string& owner) {
  Script script;
  script.job = make_job(v1::Job::RUNNING);
  script.changes_jobs = true;
  script.who = from_text<v1::WhoAmIResponse>("name: 'ada' scope: 'submit' epoch: 'e7' server_owner: '" + owner + "'");
  return script;
}

// How a change of a job ends, at a server that was found at the default port.
std::string cancel_at(const FakeServer& server, bool may_be_others) {
  Connection connection({server.address(), may_be_others});
  fetch_job(connection, "jobs/test");
  try {
    connection.call_for("jobs/test", connection.jobs(), &v1::Jobs::Stub::CancelJob);
    return "";
  } catch (const CommandError& error) {
    return error.message();
  }
}

TEST(Owner, AnotherUsersServerIsChangedOnlyIfItIsNamed) {
  const FakeServer server(script_of_owner("someone"));
  EXPECT_THAT(cancel_at(server, true), HasSubstr("belongs to someone, and is changed only if you name it: --server"));
  EXPECT_TRUE(server.asked().cancelled.empty());
  EXPECT_EQ(cancel_at(server, false), "");
  EXPECT_EQ(cancel_at(FakeServer(script_of_owner(own_user())), true), "");
  Script of_before = script_of_owner("");
  of_before.who.reset();
  EXPECT_THAT(cancel_at(FakeServer(of_before), true), HasSubstr("belongs to an unknown user"));
}

TEST(WhoAmI, PrintsTheCallerAndTheOwnerOfTheServer) {
  const FakeServer server(script_of_owner("someone"));
  const ProgramResult result = run_program({"whoami", "--server", server.address()});
  EXPECT_EQ(result.exit_code, 0) << result.all();
  for (const char* line : {"caller +ada", "scope +submit", "owner of the server +someone", "epoch +e7"})
    EXPECT_THAT(result.output, ::testing::ContainsRegex(line));
  EXPECT_THAT(result.output, HasSubstr(server.address()));
}

TEST(Open, PrintsALinkToTheJob) {
  const FakeServer server(script_of_owner("someone"));
  for (const auto& [name, page] : {std::pair("7", "jobs/7"), std::pair("sweeps/3", "sweeps/3")}) {
    const ProgramResult result = run_program({"open", name, "--server", server.address()});
    EXPECT_EQ(result.output, std::string("http://127.0.0.1:8080/sign-in?page=") + page + "\n") << result.all();
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
