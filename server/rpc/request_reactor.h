#pragma once

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "rpc/cut.h"
#include "rpc/open_calls.h"

namespace cellcrush::rpc {

/// A call of gRPC with one request. gRPC knows it as a bidirectional stream, which looks the same to a client: so the
/// call begins with its headers, and may be refused or wait before gRPC reads the request. OpenCalls keeps it until
/// gRPC is done with it.
class RequestReactor : public grpc::ServerGenericBidiReactor,
                       public OpenCalls::Call,
                       public std::enable_shared_from_this<RequestReactor> {
 public:
  struct Patience {
    std::chrono::milliseconds request;  ///< until it has come
    std::chrono::milliseconds end;      ///< until the client has read the end
  };

  RequestReactor(OpenCalls& open, const grpc::CallbackServerContext& context, std::string caller, Patience patience)
      : Call(std::move(caller), OpenCalls::Clock::now() + patience.request),
        open_(open),
        context_(context),
        patience_(patience) {}

  /// `ended` is called once, with how the call ends. REQUIRES: OpenCalls does not have the call yet.
  void on_end(std::function<void(grpc::StatusCode)> ended) { ended_ = std::move(ended); }

  void read(std::shared_ptr<Accounts::Charge> room) final;
  void end_late() final;
  void OnReadDone(bool is_read) final;
  void OnCancel() override;
  void OnDone() override;

 protected:
  /// The request has come. `received`: the memory that it takes.
  virtual void on_request(grpc::ByteBuffer& bytes, std::shared_ptr<Accounts::Charge> received) = 0;

  /// Cuts the call unless the client has read its end in time: as long as that takes, and `more`.
  void limit_end(std::chrono::milliseconds more = {}) { set_due(OpenCalls::Clock::now() + patience_.end + more); }
  /// To be called before gRPC is told how the call ends.
  void note_end(const grpc::Status& status) const {
    if (ended_) ended_(status.error_code());
  }
  /// Ends the call, and limits that.
  void end(const grpc::Status& status);
  void cut() { cut_.cancel(context_); }
  [[nodiscard]] const grpc::CallbackServerContext& context() const { return context_; }  ///< valid until OnDone

 private:
  /// Whoever moves a call on from `waiting` or `reading` may end it.
  enum class Stage { waiting, reading, moved_on };

  OpenCalls& open_;
  const grpc::CallbackServerContext& context_;
  const Patience patience_;
  std::function<void(grpc::StatusCode)> ended_;
  std::atomic<Stage> stage_ = Stage::waiting;
  std::shared_ptr<Accounts::Charge> room_;
  grpc::ByteBuffer bytes_;
  Cut cut_;
};

}  // namespace cellcrush::rpc
