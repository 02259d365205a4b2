#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include "program.h"

namespace cellcrush::client::testing {
namespace {

TEST(Explain, PrintsAFieldWithoutADaemon) {
  const ProgramResult result = run_program({"explain", "loading.ramp_strain", "--server", "unix:/nowhere"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output,
            "loading.ramp_strain\n"
            "  Type     double\n"
            "  Unit     none (dimensionless)\n"
            "  Default  0 (full speed at once)\n"
            "  Limits   0 to below end_strain\n"
            "\n"
            "Nominal strain over which the speed rises linearly in time from 0 to V.\n");
}

TEST(Explain, ListsTheFieldsOfAGroupAndOfTheCase) {
  EXPECT_NE(run_program({"explain", "loading"}).output.find("\n  speed_m_per_s  Speed V of the impact plate.\n"),
            std::string::npos);
  EXPECT_NE(run_program({"explain"}).output.find("\n  loading            How the plates move.\n"), std::string::npos);
}

TEST(Explain, AnUnknownPathEndsWithTwo) {
  const ProgramResult result = run_program({"explain", "loading.ramp_strian"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("did you mean \"ramp_strain\"?"), std::string::npos) << result.errors;
}

TEST(Explain, WithJsonItIsAnObject) {
  google::protobuf::Struct object;
  const ProgramResult result = run_program({"explain", "loading.direction", "--json"});
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(result.output, &object).ok()) << result.output;
  EXPECT_EQ(object.fields().at("default").string_value(), "X");
  EXPECT_EQ(object.fields().at("values").list_value().values_size(), 2);
}

}  // namespace
}  // namespace cellcrush::client::testing
