// Calls over gRPC before their requests have come.
#include "rpc/open_calls.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include "rpc/method_table.h"
#include "server/daemon_fixture.h"
#include "server/refuses.h"

namespace cellcrush::testing {
namespace {

using rpc::OpenCalls;
using std::chrono::minutes;
using ::testing::ElementsAre;

class OpenCallsTest : public ::testing::Test {
 protected:
  using Names = std::vector<std::string>;

  // Notes what it is told, and keeps its room.
  struct Noted final : OpenCalls::Call {
    Noted(Names& read, Names& late, const std::string& caller, const std::string& name, minutes patience)
        : Call(caller, OpenCalls::Clock::now() + patience), read_(read), late_(late), name_(name) {}
    void read(std::shared_ptr<rpc::Accounts::Charge> given) override {
      read_.push_back(name_);
      room = std::move(given);
    }
    void end_late() override { late_.push_back(name_); }

    std::shared_ptr<rpc::Accounts::Charge> room;

   private:
    Names& read_;
    Names& late_;
    std::string name_;
  };

  std::shared_ptr<Noted> add(const std::string& caller, int number, minutes patience = minutes(1)) {
    const auto out = std::make_shared<Noted>(read_, late_, caller, caller + " " + std::to_string(number), patience);
    calls_.add(out, 2);
    return out;
  }

  Names read_;
  Names late_;
  rpc::Accounts received_{{24 << 20, 8 << 20}};  // six requests, two of one caller
  OpenCalls calls_{received_};
};

TEST_F(OpenCallsTest, TwoOfACallerAreReadAtOnceAndTheNextOnceOneHasCome) {
  const auto first = add("anna", 1);
  add("anna", 2);
  add("anna", 3);
  const auto fourth = add("anna", 4);
  EXPECT_THAT([&] { add("anna", 5); }, Refuses(ServiceError::Kind::exhausted, "2 calls of anna wait"));
  add("bob", 1);
  EXPECT_THAT(read_, ElementsAre("anna 1", "anna 2", "bob 1"));
  first->room->set(1000);
  EXPECT_THAT(read_, ElementsAre("anna 1", "anna 2", "bob 1")) << "no room for 4 MiB more";
  calls_.remove(*first);
  first->room.reset();
  EXPECT_THAT(read_, ElementsAre("anna 1", "anna 2", "bob 1", "anna 3"));
  EXPECT_TRUE(calls_.withdraw(*fourth));
  EXPECT_FALSE(calls_.withdraw(*fourth));
}

TEST_F(OpenCallsTest, WhatIsLateIsEnded) {
  add("anna", 1);
  add("anna", 2, minutes(-1));
  const auto waits = add("anna", 3, minutes(-1));
  calls_.look();
  EXPECT_TRUE(calls_.withdraw(*waits));
  EXPECT_THAT(late_, ::testing::UnorderedElementsAre("anna 2", "anna 3")) << "whether it is read or waits";
}

class RequestTest : public DaemonFixture {
 protected:
  // How a call ends that sends so many empty requests, and half-closes if it `closes`.
  [[nodiscard]] grpc::Status end_of(const std::string& method, int requests, bool closes,
                                    const std::string& epoch = "") const {
    grpc::CompletionQueue queue;
    const auto next = [&queue] {
      void* tag = nullptr;
      bool is_done = false;
      EXPECT_TRUE(queue.Next(&tag, &is_done));
      return is_done;
    };
    const auto context = bounded_context();
    if (!epoch.empty()) context->AddMetadata(rpc::kEpochHeader, epoch);
    grpc::GenericStub stub(client().channel);
    const auto call = stub.PrepareCall(context.get(), method, &queue);
    call->StartCall(nullptr);
    next();
    const grpc::Slice empty;
    for (int i = 0; i < requests; ++i) {
      call->Write(grpc::ByteBuffer(&empty, 1), nullptr);
      next();
    }
    if (closes) {
      call->WritesDone(nullptr);
      next();
    }
    grpc::ByteBuffer answer;
    grpc::Status out;
    do call->Read(&answer, nullptr);
    while (next());
    call->Finish(&out, nullptr);
    next();
    return out;
  }
};

TEST_F(RequestTest, ACallWithoutOneIsInvalid) {
  start(default_options());
  for (const char* method : {"/cellcrush.v1.Jobs/ListJobs", "/cellcrush.v1.Jobs/WatchJobs"})
    EXPECT_THAT(end_of(method, 0, true), Fails(grpc::StatusCode::INVALID_ARGUMENT, "no request message"));
  EXPECT_TRUE(end_of("/cellcrush.v1.Jobs/ListJobs", 1, true).ok());
  EXPECT_TRUE(end_of("/cellcrush.v1.Jobs/ListJobs", 2, false).ok()) << "the first is answered at once";
}

TEST_F(RequestTest, ACallIsRefusedBeforeItComes) {
  start(default_options());
  EXPECT_THAT(end_of("/cellcrush.v1.Jobs/ListJobs", 0, false, std::string(32, '0')),
              Fails(grpc::StatusCode::FAILED_PRECONDITION, "another server"));
  EXPECT_THAT(end_of("/cellcrush.v1.Jobs/Listen", 0, false),
              Fails(grpc::StatusCode::UNIMPLEMENTED, "/cellcrush.v1.Jobs/Listen"));
}

}  // namespace
}  // namespace cellcrush::testing
