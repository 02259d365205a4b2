#define CELLCRUSH_ON_DEVICE

#include <cstdlib>
#include <cstring>
#include <numeric>
#include <thread>
#include <vector>

#include "cellcrush/device.h"
#include "device/steps-inl.h"

namespace cellcrush {
namespace {

namespace on_device = HWY_NAMESPACE;

/// Computes the items of phases on some threads, each time in another order.
class ScatteredItems {
 public:
  ScatteredItems(on_device::Crush& crush, int walls) : crush_(crush), walls_(walls) {}

  template <class Phase>
  void phase(Phase /*phase*/, std::size_t step) {
    visit(Phase::items(crush_), [&](std::size_t item) { Phase::compute(crush_, item, step); });
  }

  void walls() {
    on_device::visit_kind_of_walls(walls_, [this]<class Kind>(Kind /*kind*/) { walls_of<Kind>(); });
  }

 private:
  template <class Kind>
  void walls_of() {
    const auto& rule = on_device::rule_of<Kind>(crush_);
    visit(Kind::items(crush_), [&](std::size_t item) { Kind::compute(crush_, rule, item); });
  }

  /// Every item once: from one of them on, by a stride without a common divisor, dealt out to the threads in turn.
  template <class Visit>
  void visit(std::size_t items, const Visit& visit) {
    if (items == 0) return;
    drawn_ = drawn_ * 6364136223846793005U + 1442695040888963407U;
    std::size_t stride = (drawn_ >> 33U) % items + 1;
    while (std::gcd(stride, items) != 1) ++stride;
    const std::size_t first = (drawn_ >> 17U) % items;
    const std::size_t threads = items < kThreads ? 1 : kThreads;
    const auto visit_some = [&](std::size_t thread) {
      for (std::size_t k = thread; k < items; k += threads) visit((first + k * stride) % items);
    };
    std::vector<std::thread> others;
    for (std::size_t thread = 1; thread < threads; ++thread) others.emplace_back(visit_some, thread);
    visit_some(0);
    for (std::thread& other : others) other.join();
  }

  static constexpr std::size_t kThreads = 3;

  on_device::Crush& crush_;
  const int walls_;
  std::uint64_t drawn_ = 1;
};

class EmulatedDevice final : public Device {
 public:
  [[nodiscard]] std::string name() const override { return "emulated device"; }

  void* allocate(std::size_t bytes) override {
    void* const memory = std::malloc(bytes + 1);
    std::memset(memory, 0xFF, bytes + 1);
    return memory;
  }
  void free(void* memory) override { std::free(memory); }
  void write(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
  void read(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }

  void advance(const void* /*crush*/, void* on_device, int walls, std::int64_t steps) override {
    ScatteredItems run(*static_cast<HWY_NAMESPACE::Crush*>(on_device), walls);
    for (std::size_t step = 0; step < static_cast<std::size_t>(steps); ++step) HWY_NAMESPACE::run_step(run, step);
    run.phase(HWY_NAMESPACE::AddStored(), 0);
  }
};

}  // namespace

std::unique_ptr<Device> make_emulated_device() { return std::make_unique<EmulatedDevice>(); }

}  // namespace cellcrush
