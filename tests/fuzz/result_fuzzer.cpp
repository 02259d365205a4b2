// A result that is not as it was written: a whole one, of which the first bytes of the input replace parts, with a seal
// that fits, and the others overwrite bytes, as a bad disk would. It is read as
// GetFrame and the tests read it. Nothing may crash, hang, take more memory than such a file is worth, or come from
// another file.
//
// Left out: bytes at random behind a seal that fits. HDF5 1.10.8 reads past its buffers over damaged metadata (an
// attribute's size is enough), which is not ours to mend; the seal keeps such files from it (store/result_seal.h), and
// only the daemon's own worker writes files with one. HDF5 also loses a few bytes of memory when it refuses a file, so
// leaks are not looked for.
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "error.h"
#include "fuzz/prepared_folder.h"
#include "programs/temporary_folder.h"
#include "rpc/result_sources.h"
#include "store/hdf5.h"
#include "store/result_layout.h"
#include "store/result_reader.h"
#include "store/result_seal.h"

namespace cellcrush::fuzz {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// A number that stands in the files beside the result, and never in a result.
constexpr double kOfAnotherFile = 777.0;

/// How a part is replaced.
using Choice = std::span<const std::uint8_t, 5>;

using store::Hdf5Handle;

struct Part {
  const char* path;
  std::vector<hsize_t> shape;  // as prepared_folder.cpp writes it; that of groups is of no meaning
  bool is_double = true;
};

const std::array<Part, 10> kParts = {{{"/frames/time_s", {3}},
                                      {"/frames/strain", {3}},
                                      {"/frames/position_mm", {3, 3, 2}, false},
                                      {"/frames/plastic_fraction", {3, 2}, false},
                                      {"/frames/fibre_strain", {3, 2}, false},
                                      {"/frames/local_strain", {3, 2}, false},
                                      {"/frames", {3}},
                                      {"/history/time_s", {5}},
                                      {"/history/front_strain_behind", {5}},
                                      {"/history", {5}},
                                      {"/mesh", {3}}}};
constexpr const char* kOther = "other.h5";
constexpr const char* kOtherBytes = "other.bin";

hid_t type_of(unsigned choice) {
  const std::array<hid_t, 8> types = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE,  H5T_STD_I8LE,
                                      H5T_STD_I64LE,  H5T_C_S1,       H5T_STD_REF_OBJ, H5T_NATIVE_LDOUBLE};
  return types[choice % types.size()];
}

hsize_t extent_of(unsigned choice) {
  const std::array<hsize_t, 8> extents = {3, 0, 1, 2, 7, 300, hsize_t{1} << 31U, hsize_t{1} << 61U};
  return extents[choice % extents.size()];
}

// How a dataset is stored, as one byte says.
Hdf5Handle storage_of(unsigned choice, const std::vector<hsize_t>& shape, const std::filesystem::path& folder) {
  Hdf5Handle out(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
  std::vector<hsize_t> chunk(shape.size(), 1 + (choice >> 4U) * (shape.size() > 1 ? 1U : 40U));
  switch (choice % 8U) {
    case 0: H5Pset_layout(out.id(), H5D_COMPACT); break;
    case 1: H5Pset_layout(out.id(), H5D_CONTIGUOUS); break;
    case 2: H5Pset_external(out.id(), (folder / kOtherBytes).c_str(), 0, H5F_UNLIMITED); break;
    case 3: {
      const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                             "space");
      H5Pset_virtual(out.id(), space.id(), (folder / kOther).c_str(), "/frames/time_s", space.id());
      break;
    }
    case 4: H5Pset_fletcher32(out.id()); [[fallthrough]];
    case 5: H5Pset_szip(out.id(), H5_SZIP_NN_OPTION_MASK, 4); [[fallthrough]];
    default: H5Pset_chunk(out.id(), static_cast<int>(chunk.size()), chunk.data()); H5Pset_deflate(out.id(), 4);
  }
  return out;
}

// The shape and the type are as they were, or others.
void make_dataset(hid_t file, const Part& part, const std::filesystem::path& folder, Choice choice) {
  std::vector<hsize_t> shape = part.shape;
  if (choice[2] >= 128) {
    shape.resize(choice[2] % 5U);
    for (std::size_t i = 0; i < shape.size(); ++i)
      shape[i] = extent_of(static_cast<unsigned>(choice[2] / 5U + i * choice[3]));
  }
  const hid_t type = choice[3] >= 128 ? type_of(choice[3]) : part.is_double ? H5T_IEEE_F64LE : H5T_IEEE_F32LE;
  const std::vector<hsize_t> limit(shape.size(), H5S_UNLIMITED);
  const bool grows = choice[4] % 8U > 3U;
  const Hdf5Handle space(
      shape.empty() ? H5Screate(choice[3] % 2U == 0 ? H5S_SCALAR : H5S_NULL)
                    : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), grows ? limit.data() : nullptr),
      H5Sclose, "space");
  const Hdf5Handle storage = storage_of(choice[4], shape, folder);
  const hid_t dataset = H5Dcreate2(file, part.path, type, space.id(), H5P_DEFAULT, storage.id(), H5P_DEFAULT);
  if (dataset < 0) return;
  // A chunk at the start is written, the others never; HDF5 itself would crash where the extents' product overflows.
  const double value = 0.5;
  const Hdf5Handle one(H5Screate(H5S_SCALAR), H5Sclose, "space");
  const std::vector<hsize_t> first(shape.size(), 0);
  const double numbers = std::accumulate(shape.begin(), shape.end(), 1.0, std::multiplies<>());
  if (grows && !shape.empty() && numbers > 0.0 && numbers < 1e18) {
    H5Sselect_elements(space.id(), H5S_SELECT_SET, 1, first.data());
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, one.id(), space.id(), H5P_DEFAULT, &value);
  }
  H5Dclose(dataset);
}

void make_attribute(hid_t file, Choice choice) {
  H5Adelete(file, "case");
  std::vector<hsize_t> shape(choice[2] % 3U, 1 + choice[3] % 8U);
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "space");
  const Hdf5Handle type(H5Tcopy(type_of(choice[4])), H5Tclose, "type");
  if (choice[4] % 8U == 5) H5Tset_size(type.id(), choice[4] % 16U == 5 ? H5T_VARIABLE : 9);
  const hid_t attribute = H5Acreate2(file, "case", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0) return;
  const std::vector<const char*> texts(64, "text");
  if (H5Tis_variable_str(type.id()) > 0) H5Awrite(attribute, type.id(), texts.data());
  H5Aclose(attribute);
}

void replace_part(hid_t file, const std::filesystem::path& folder, Choice choice) {
  const Part& part = kParts[choice[0] % kParts.size()];
  const char* other = kParts[choice[2] % kParts.size()].path;
  if (choice[1] % 8U == 0) return make_attribute(file, choice);
  H5Ldelete(file, part.path, H5P_DEFAULT);
  switch (choice[1] % 8U) {
    case 1: break;
    case 2: H5Lcreate_soft(other, file, part.path, H5P_DEFAULT, H5P_DEFAULT); break;
    case 3: H5Lcreate_external(kOther, other, file, part.path, H5P_DEFAULT, H5P_DEFAULT); break;
    case 4: H5Lcreate_hard(file, other, file, part.path, H5P_DEFAULT, H5P_DEFAULT); break;
    default: make_dataset(file, part, folder, choice);
  }
}

// Writes other.h5 and other.bin, full of kOfAnotherFile, into the folder.
void write_other_files(const std::filesystem::path& folder) {
  const std::vector<double> numbers(4096, kOfAnotherFile);
  const Hdf5Handle file(H5Fcreate((folder / kOther).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                        kOther);
  for (const char* group : {"/frames", "/history"}) {
    const Hdf5Handle made(H5Gcreate2(file.id(), group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, group);
    for (const char* name : {"time_s", "strain"}) {
      const Hdf5Handle column = store::make_growing_dataset(made.id(), name, H5T_IEEE_F64LE, {}, {256});
      store::append_rows(column.id(), H5T_NATIVE_DOUBLE, 3, numbers.data());
    }
  }
  std::ofstream(folder / kOtherBytes, std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(8 * numbers.size()));
}

// Puts something else in the place of datasets, groups and an attribute of the result at `path`, which lies beside the
// other files: nothing, a link of some kind, a dataset that is made of other files, one of another shape, type or
// storage, or one that says it holds what was never written.
void replace_parts(const std::filesystem::path& path, std::span<const Choice> choices) {
  if (choices.empty()) return;
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "Opening a result");
  for (const Choice& choice : choices) replace_part(file.id(), path.parent_path(), choice);
}

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
  for (const float value : frame.fibre_strain()) expect_own(static_cast<double>(value));
  for (const float value : frame.local_strain()) expect_own(static_cast<double>(value));
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
  try_to([&] { static_cast<void>(result.job()); });
  try_to([&] {
    for (const float value : result.mesh().position_mm()) expect_own(static_cast<double>(value));
  });
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
