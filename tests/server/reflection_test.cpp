#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/descriptor_database.h>

#include <array>
#include <filesystem>
#include <iterator>

#include "grpc/reflection/v1/reflection.grpc.pb.h"
#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
#include "server/daemon_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

struct V1 {
  using Service = grpc::reflection::v1::ServerReflection;
  using Request = grpc::reflection::v1::ServerReflectionRequest;
  using Response = grpc::reflection::v1::ServerReflectionResponse;
};
struct V1Alpha {
  using Service = grpc::reflection::v1alpha::ServerReflection;
  using Request = grpc::reflection::v1alpha::ServerReflectionRequest;
  using Response = grpc::reflection::v1alpha::ServerReflectionResponse;
};

template <class Version>
class ReflectionTest : public DaemonFixture {
 protected:
  using Request = typename Version::Request;
  using Response = typename Version::Response;

  /// What the requests of one stream are answered; the stream ends with OK.
  [[nodiscard]] std::vector<Response> ask(const std::vector<Request>& requests) const {
    const auto stub = Version::Service::NewStub(client().channel);
    const auto context = bounded_context(std::chrono::seconds(20));
    const auto stream = stub->ServerReflectionInfo(context.get());
    std::vector<Response> out;
    for (const auto& request : requests) {
      EXPECT_TRUE(stream->Write(request));
      EXPECT_TRUE(stream->Read(&out.emplace_back()));
    }
    stream->WritesDone();
    EXPECT_TRUE(stream->Finish().ok());
    return out;
  }

  [[nodiscard]] Response ask_for_symbol(const std::string& symbol) const {
    Request request;
    request.set_file_containing_symbol(symbol);
    return ask({request}).front();
  }
};

using Versions = ::testing::Types<V1, V1Alpha>;
TYPED_TEST_SUITE(ReflectionTest, Versions);

TYPED_TEST(ReflectionTest, ListsAllServices) {
  typename TypeParam::Request request;
  request.set_host("here");
  request.set_list_services("*");
  const auto response = this->ask({request}).front();
  EXPECT_EQ(response.valid_host(), "here");
  EXPECT_EQ(response.original_request().list_services(), "*");
  std::vector<std::string> names;
  for (const auto& service : response.list_services_response().service()) names.push_back(service.name());
  EXPECT_THAT(names, ElementsAre("cellcrush.v1.Admin", "cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps",
                                 "grpc.health.v1.Health", "grpc.reflection.v1.ServerReflection",
                                 "grpc.reflection.v1alpha.ServerReflection"));
}

TYPED_TEST(ReflectionTest, GivesFilesFromWhichAClientBuildsTheService) {
  const auto response = this->ask_for_symbol("cellcrush.v1.Jobs");
  google::protobuf::SimpleDescriptorDatabase files;
  for (const auto& bytes : response.file_descriptor_response().file_descriptor_proto()) {
    google::protobuf::FileDescriptorProto file;
    ASSERT_TRUE(file.ParseFromString(bytes));
    EXPECT_TRUE(files.Add(file)) << file.name() << " comes twice.";
  }
  google::protobuf::DescriptorPool pool(&files);
  const auto* jobs = pool.FindServiceByName("cellcrush.v1.Jobs");
  ASSERT_NE(jobs, nullptr);
  EXPECT_NE(jobs->FindMethodByName("CreateJob")->input_type()->FindFieldByName("case"), nullptr);
  EXPECT_EQ(this->ask_for_symbol("cellcrush.v1.Jobs.CreateJob").file_descriptor_response().file_descriptor_proto(0),
            response.file_descriptor_response().file_descriptor_proto(0));
  EXPECT_GT(this->ask_for_symbol("grpc.health.v1.Health").file_descriptor_response().file_descriptor_proto_size(), 0);
  const std::string own = TypeParam::Service::service_full_name();
  EXPECT_THAT(this->ask_for_symbol(own).file_descriptor_response().file_descriptor_proto(), SizeIs(1));
}

TYPED_TEST(ReflectionTest, AnswersWhatItDoesNotHaveInTheStream) {
  std::vector<typename TypeParam::Request> requests(6);
  requests[0].set_file_containing_symbol("cellcrush.v1.Unknown");
  requests[1].set_file_by_filename("unknown.proto");
  requests[2].mutable_file_containing_extension()->set_containing_type("cellcrush.v1.Job");
  requests[3].set_all_extension_numbers_of_type("cellcrush.v1.Unknown");
  requests[5].set_file_by_filename("cellcrush/v1/job.proto");
  const auto responses = this->ask(requests);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(responses[i].error_response().error_code(), grpc::StatusCode::NOT_FOUND) << i;
    EXPECT_THAT(responses[i].error_response().error_message(), HasSubstr("This server has no")) << i;
  }
  EXPECT_EQ(responses[4].error_response().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_GT(responses[5].file_descriptor_response().file_descriptor_proto_size(), 0);
}

TYPED_TEST(ReflectionTest, SilentStreamsHoldNoThreadAndEndWithTheDaemon) {
  constexpr int kStreams = 100;
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
  };
  const auto stub = TypeParam::Service::NewStub(this->client().channel);
  typename TypeParam::Request request;
  request.set_list_services("*");
  typename TypeParam::Response response;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<typename TypeParam::Request, typename TypeParam::Response>>>
      open;
  static_cast<void>(this->ask({request}));
  const auto before = threads();
  for (int i = 0; i < kStreams; ++i) {
    contexts.push_back(bounded_context());
    open.push_back(stub->ServerReflectionInfo(contexts.back().get()));
    ASSERT_TRUE(open.back()->Write(request) && open.back()->Read(&response)) << i;
  }
  EXPECT_LT(threads() - before, kStreams / 2);
  this->daemon_->stop();
  for (const auto& stream : open) EXPECT_FALSE(stream->Finish().ok());
}

TYPED_TEST(ReflectionTest, StreamsBeyondTheCallersLimitAreRefusedByName) {
  auto options = this->default_options();
  options.connections.streams_per_caller = 2;
  this->start(options);
  const auto stub = TypeParam::Service::NewStub(this->client().channel);
  typename TypeParam::Request request;
  request.set_list_services("*");
  typename TypeParam::Response response;
  const auto open = [&](grpc::ClientContext& context) { return stub->ServerReflectionInfo(&context); };
  const auto contexts = std::array{bounded_context(), bounded_context(), bounded_context()};
  const auto first = open(*contexts[0]);
  const auto second = open(*contexts[1]);
  ASSERT_TRUE(first->Write(request) && first->Read(&response));
  ASSERT_TRUE(second->Write(request) && second->Read(&response));
  const auto third = open(*contexts[2])->Finish();
  EXPECT_THAT(third, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "--max-streams-per-caller"));
  first->WritesDone();
  ASSERT_TRUE(first->Finish().ok());
  // Its place is free once the server has let it go, a moment after the client has its status.
  bool is_answered = false;
  for (int i = 0; i < 100 && !is_answered; ++i) {
    const auto context = bounded_context();
    const auto again = open(*context);
    is_answered = again->Write(request) && again->Read(&response);
  }
  EXPECT_TRUE(is_answered);
}

}  // namespace
}  // namespace cellcrush::testing
