#include "server/raw_call.h"

#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <vector>

#include "server/daemon_fixture.h"

namespace cellcrush::testing {

std::string call_raw(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const std::string& bytes,
                     bool stream) {
  grpc::GenericStub stub(channel);
  const auto context = bounded_context();
  grpc::CompletionQueue queue;
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer response;
  void* tag = nullptr;
  bool ok = false;
  const auto call = stub.PrepareCall(context.get(), method, &queue);
  const auto wait = [&] { return queue.Next(&tag, &ok) && ok; };
  call->StartCall(nullptr);
  EXPECT_TRUE(wait());
  call->Write(request, nullptr);
  EXPECT_TRUE(wait());
  call->Read(&response, nullptr);
  EXPECT_TRUE(wait());
  if (stream) context->TryCancel();
  std::vector<grpc::Slice> slices;
  response.Dump(&slices);
  std::string out;
  for (const auto& part : slices) out.append(reinterpret_cast<const char*>(part.begin()), part.size());
  grpc::Status status;
  call->Finish(&status, nullptr);
  wait();
  return out;
}

bool is_serving(const std::shared_ptr<grpc::Channel>& channel, const std::string& service) {
  // HealthCheckRequest{service} is field 1 with that text, HealthCheckResponse{status: SERVING} field 1 with value 1.
  const std::string request = std::string("\x0a") + static_cast<char>(service.size()) + service;
  return call_raw(channel, "/grpc.health.v1.Health/Check", request, false) == "\x08\x01";
}

}  // namespace cellcrush::testing
