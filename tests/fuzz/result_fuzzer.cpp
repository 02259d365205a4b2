// A result that is not as it was written: a whole one, of which the first bytes of the input replace parts
// (hostile_result.h), with a seal that fits, and the others overwrite bytes, as a bad disk would. It is read as
// GetFrame and the tests read it. Nothing may crash, hang, take more memory than such a file is worth, or come from
// another file.
//
// Left out: bytes at random behind a seal that fits. HDF5 1.10.8 reads past its buffers over damaged metadata (an
// attribute's size is enough), which is not ours to mend; the seal keeps such files from it (store/result_seal.h), and
// only the daemon's own worker writes files with one. HDF5 also loses a few bytes of memory when it refuses a file, so
// leaks are not looked for.
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "error.h"
#include "fuzz/hostile_result.h"
#include "fuzz/prepared_folder.h"
#include "rpc/result_sources.h"
#include "server/temporary_folder.h"
#include "store/result_layout.h"
#include "store/result_reader.h"
#include "store/result_seal.h"

namespace cellcrush::fuzz {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kMostParts = 4;

// A whole result, the other files, and the place of the one that is read.
struct Bench {
  Bench() {
    write_result(folder.path() / "whole.h5");
    write_other_files(folder.path());
    std::ifstream file(folder.path() / "whole.h5", std::ios::binary);
    whole = {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  testing::TemporaryFolder folder;
  std::string whole;
  std::filesystem::path result = folder.path() / "result.h5";
};

// The first byte counts the parts to replace. Returns what is left of the input.
Bytes replace_some(const std::filesystem::path& path, Bytes input) {
  if (input.empty()) return input;
  const std::size_t count = input[0] % (kMostParts + 1);
  input = input.subspan(1);
  std::vector<Choice> choices;
  while (choices.size() < count && input.size() >= Choice::extent) {
    choices.emplace_back(input.first<Choice::extent>());
    input = input.subspan(Choice::extent);
  }
  replace_parts(path, choices);
  return input;
}

// Three bytes of an offset and one of a length, then so many bytes, again and again. A length of 0 cuts the file.
void overwrite(const std::filesystem::path& path, Bytes input) {
  constexpr std::size_t kHead = 4;
  if (input.size() < kHead) return;
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  while (input.size() >= kHead && !bytes.empty()) {
    const std::size_t offset = (input[0] * 65536U + input[1] * 256U + input[2]) % bytes.size();
    const std::size_t length = std::min<std::size_t>({input[3], input.size() - kHead, bytes.size() - offset});
    if (input[3] == 0) bytes.resize(offset);
    std::copy_n(input.begin() + kHead, length, bytes.begin() + static_cast<std::ptrdiff_t>(offset));
    input = input.subspan(kHead + length);
  }
  write_file(path, bytes);
}

void expect_own(double value) {
  if (value != kOfAnotherFile) return;
  std::fprintf(stderr, "a number comes from another file\n");
  std::abort();
}

void expect_own(const v1::FieldFrame& frame) {
  expect_own(frame.time_s());
  expect_own(frame.strain());
  for (const float value : frame.position_mm()) expect_own(static_cast<double>(value));
  for (const float value : frame.plastic_fraction()) expect_own(static_cast<double>(value));
}

template <class Reading>
void try_to(const Reading& reading) {
  try {
    reading();
  } catch (const ServiceError&) {
    // Refused, as it may be.
  }
}

// The byte chooses the frame that is asked for.
void read_frame(const store::ResultReader& result, std::uint8_t choice) {
  v1::GetFrameRequest request;
  switch (choice % 6U) {
    case 0: break;
    case 1: request.set_strain(0.1); break;
    case 2: request.set_time_s(1.2); break;
    case 3: request.set_index(std::numeric_limits<int>::max()); break;
    default: request.set_index(static_cast<int>(choice % 7U) - 2);
  }
  try_to([&] { expect_own(rpc::read_frame(result, request)); });
}

void read_all(const std::filesystem::path& path, std::uint8_t choice) {
  const store::ResultReader result(path);
  read_frame(result, choice);
  try_to([&] { static_cast<void>(result.text_attribute("case")); });
  try_to([&] {
    for (const auto& sample : result.history()) {
      for (const auto& column : store::history_columns()) expect_own(column.get(sample));
    }
  });
}

}  // namespace
}  // namespace cellcrush::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcrush::fuzz;
  static const Bench bench;
  write_file(bench.result, bench.whole);
  const std::uint8_t choice = size > 0 ? data[size - 1] : 0;
  const auto damage = replace_some(bench.result, {data, size});
  cellcrush::store::seal_result(bench.result);
  overwrite(bench.result, damage);
  try_to([&] { read_all(bench.result, choice); });
  return 0;
}
