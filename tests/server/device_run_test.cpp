#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cellcrush/simd.h"
#include "error.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

v1::Case with_a_curve(v1::Case submitted) {
  submitted.mutable_material()->set_voce_stress_mpa(50.0);
  submitted.mutable_material()->set_voce_exponent(20.0);
  return submitted;
}

class DeviceRunTest : public DaemonFixture {
 protected:
  void SetUp() override {
    if (simd_target() == "scalar") GTEST_SKIP() << "Without fused multiply-add no device is used.";
    DaemonOptions options = default_options();
    options.device = "emulated";
    start(options);
  }

  // The device that the job's result names.
  std::string device_of(const std::string& job) {
    grpc::Status status;
    const std::string bytes = client().download(job, 0, status);
    EXPECT_TRUE(status.ok()) << status.error_message();
    const auto copy = folder_.path() / "copy.h5";
    std::ofstream(copy, std::ios::binary) << bytes;
    return store::ResultReader(copy).text_attribute("device");
  }

  std::vector<std::string> samples_of(const std::string& job) {
    std::vector<std::string> out;
    for (const auto& sample : client().history(job)) out.push_back(sample.SerializeAsString());
    return out;
  }
};

TEST_F(DeviceRunTest, ADeviceGivesTheResultsOfTheProcessorAndIsNamed) {
  const std::string on_device = finished_job();
  EXPECT_EQ(device_of(on_device), "emulated device");
  const auto samples = samples_of(on_device);
  start(default_options());
  const std::string own = finished_job();
  EXPECT_EQ(device_of(own), "none");
  EXPECT_EQ(samples, samples_of(own));
  EXPECT_GT(samples.size(), 10U);
}

TEST_F(DeviceRunTest, AResultSaysWhyNoDeviceAdvancedIt) {
  EXPECT_EQ(device_of(finished_job(with_a_curve(tiny_case()))),
            "none: the yield stress of its material follows a curve or a rate");
}

TEST_F(DeviceRunTest, ACheckSaysWhatAdvancesTheRun) {
  auto client = this->client();
  const auto modelled = [&](const v1::Case& submitted) {
    v1::CheckCaseRequest request;
    *request.mutable_case_() = submitted;
    const auto answer = answer_of(*client.cases, &v1::Cases::Stub::CheckCase, request);
    return answer.modelled(answer.modelled_size() - 1);
  };
  EXPECT_EQ(modelled(small_case()), "Device: advances this run, to the bits of the processor.");
  EXPECT_EQ(modelled(with_a_curve(small_case())),
            "Device: does not advance this run, because the yield stress of its material follows a curve or a rate.");
}

TEST_F(DeviceRunTest, ADaemonDoesNotStartWithADeviceThatCannotBeUsed) {
  DaemonOptions options = default_options();
  options.device = "/nowhere/libnone.so";
  options.data_folder = folder_.path() / "other";
  try {
    start(options);
    FAIL() << "It started.";
  } catch (const ServiceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--device is \"/nowhere/libnone.so\". The library cannot be loaded: "));
    EXPECT_THAT(error.what(), HasSubstr("or leave out --device."));
  }
}

}  // namespace
}  // namespace cellcrush::testing
