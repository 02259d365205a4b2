#define CELLCRUSH_ON_DEVICE

#include <cuda_runtime.h>

#include <string>

#include "cellcrush/device.h"
#include "device/steps-inl.h"

namespace cellcrush {
namespace {

namespace on_device = HWY_NAMESPACE;

constexpr unsigned kThreads = 128;

/// The next call does not see the error again.
void check(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  cudaGetLastError();
  throw DeviceError(std::string(what) + ": " + cudaGetErrorString(result) + ".");
}

template <class Phase>
__global__ void __launch_bounds__(kThreads) compute_phase(on_device::Crush* crush, std::size_t step) {
  const std::size_t item = blockIdx.x * static_cast<std::size_t>(kThreads) + threadIdx.x;
  if (item < Phase::items(*crush)) Phase::compute(*crush, item, step);
}

template <class Kind>
__global__ void __launch_bounds__(kThreads) compute_walls(on_device::Crush* crush) {
  const std::size_t item = blockIdx.x * static_cast<std::size_t>(kThreads) + threadIdx.x;
  if (item < Kind::items(*crush)) Kind::compute(*crush, on_device::rule_of<Kind>(*crush), item);
}

class Launches {
 public:
  Launches(const on_device::Crush& facts, on_device::Crush* crush, int walls)
      : facts_(facts), crush_(crush), walls_(walls) {}

  template <class Phase>
  void phase(Phase, std::size_t step) {
    if (const unsigned blocks = blocks_of(Phase::items(facts_)); blocks > 0) {
      compute_phase<Phase><<<blocks, kThreads>>>(crush_, step);
    }
  }
  void walls() {
    on_device::visit_kind_of_walls(walls_, [this]<class Kind>(Kind /*kind*/) { walls_of<Kind>(); });
  }

 private:
  template <class Kind>
  void walls_of() {
    compute_walls<Kind><<<blocks_of(Kind::items(facts_)), kThreads>>>(crush_);
  }
  static unsigned blocks_of(std::size_t items) { return static_cast<unsigned>((items + kThreads - 1) / kThreads); }

  const on_device::Crush& facts_;
  on_device::Crush* crush_;
  int walls_;
};

class CudaDevice final : public Device {
 public:
  CudaDevice() {
    cudaDeviceProp properties;
    check(cudaGetDeviceProperties(&properties, 0), "No CUDA device");
    name_ = properties.name;
    cudaFuncAttributes attributes;
    check(cudaFuncGetAttributes(&attributes, compute_phase<HWY_NAMESPACE::SumJoints>), "No kernels for this device");
  }

  [[nodiscard]] std::string name() const override { return name_; }

  void* allocate(std::size_t bytes) override {
    void* memory = nullptr;
    check(cudaMalloc(&memory, bytes), "Memory of the device");
    return memory;
  }
  void free(void* memory) override {
    cudaFree(memory);
    cudaGetLastError();
  }
  void write(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice), "Copy to the device");
  }
  void read(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "Copy from the device");
  }

  void advance(const void* crush, void* address, int walls, std::int64_t steps) override {
    Launches run(*static_cast<const HWY_NAMESPACE::Crush*>(crush), static_cast<HWY_NAMESPACE::Crush*>(address), walls);
    for (std::size_t step = 0; step < static_cast<std::size_t>(steps); ++step) HWY_NAMESPACE::run_step(run, step);
    run.phase(HWY_NAMESPACE::AddStored(), 0);
    check(cudaGetLastError(), "Kernels of the device");
  }

 private:
  std::string name_;
};

}  // namespace
}  // namespace cellcrush

/// See layout_of_crush.
extern "C" std::size_t cellcrush_device_layout() { return cellcrush::HWY_NAMESPACE::kLayout; }

/// What open_device looks for in a library. Throws DeviceError.
extern "C" cellcrush::Device* cellcrush_open_device() { return new cellcrush::CudaDevice(); }
