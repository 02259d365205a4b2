#include "access/local_doors.h"

#include <algorithm>
#include <utility>

namespace cellcrush::access {

// Checks the calls of one door.
class LocalDoors::Check final : public grpc::AuthMetadataProcessor {
 public:
  explicit Check(const Gate& gate) : gate_(gate) {}

  // It does not wait.
  [[nodiscard]] bool IsBlocking() const override { return false; }

  grpc::Status Process(const InputMetadata& metadata, grpc::AuthContext* context, OutputMetadata*,
                       OutputMetadata*) override {
    const auto path = metadata.find(":path");
    return gate_.check_local_call(
        path == metadata.end() ? std::string_view() : std::string_view(path->second.data(), path->second.size()),
        caller, *context);
  }

  std::optional<Caller> caller;  // set before the first connection

 private:
  const Gate& gate_;
};

LocalDoors::LocalDoors(const Gate& gate, const ListenAddress& address, grpc::ServerBuilder& builder) : gate_(gate) {
  using External = grpc::ServerBuilder::experimental_type::ExternalConnectionType;
  for (std::size_t i = 0; i <= gate.most_local_callers(); ++i) {
    auto check = std::make_shared<Check>(gate);
    auto port =
        builder.experimental().AddExternalConnectionAcceptor(External::FROM_FD, gate.credentials_for(address, check));
    doors_.push_back({std::move(check), std::move(port)});
  }
}

LocalDoors::~LocalDoors() = default;
LocalDoors::LocalDoors(LocalDoors&&) noexcept = default;

LocalDoors::Port* LocalDoors::find_port(int connection) {
  auto caller = gate_.find_local_caller(connection);
  const MutexLock lock(*mutex_);
  const auto end = doors_.begin() + static_cast<std::ptrdiff_t>(taken_);
  const auto own = std::find_if(doors_.begin(), end, [&](const Door& door) { return door.check->caller == caller; });
  if (own != end) return own->port.get();
  if (taken_ == doors_.size()) return nullptr;
  Door& next = doors_[taken_++];
  next.check->caller = std::move(caller);
  return next.port.get();
}

}  // namespace cellcrush::access
