// Frames and meshes in parts, and packed frames.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "watch/sent_frame.h"

namespace cellcrush::watch {
namespace {

constexpr std::size_t kStockClient = 4 * 1024 * 1024;

v1::Mesh mesh_of(int particles) {
  v1::Mesh out;
  out.set_particle_count(particles);
  out.set_length_mm(3.0);
  out.set_rigid_element_count(2);
  for (int i = 0; i < particles; i += 3) out.add_overlap_particle(i);
  for (const int apart : {1, 50}) {
    for (int i = 0; i + apart < particles; ++i) {
      out.add_element_nodes(i);
      out.add_element_nodes(i + apart);
      out.add_thickness_mm(0.1F * static_cast<float>(1 + i % 7));
      out.add_element_wall(i / 2);
    }
  }
  for (int i = 0; i < particles; ++i) {
    out.add_position_mm(static_cast<float>(i % 100));
    out.add_position_mm(static_cast<float>(i / 100));
  }
  return out;
}

// Far from the plate nothing moves, as in a fast crush.
v1::FieldFrame frame_of(const v1::Mesh& mesh, double largest) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> moved(-static_cast<float>(largest), static_cast<float>(largest));
  v1::FieldFrame out;
  out.set_index(5);
  out.set_time_s(1e-3);
  out.set_strain(0.25);
  for (int i = 0; i < mesh.position_mm_size(); ++i)
    out.add_position_mm(mesh.position_mm(i) + (i < mesh.position_mm_size() / 4 ? moved(random) : 0.0F));
  for (int i = 0; i < mesh.thickness_mm_size(); ++i) out.add_plastic_fraction(i % 11 == 0 ? 0.3F : 0.0F);
  for (int i = 0; i < mesh.thickness_mm_size() / 2; ++i) out.add_fibre_strain(0.1F * static_cast<float>(i % 5));
  for (int i = 0; i < mesh.thickness_mm_size() / 2; ++i) out.add_local_strain(0.1F * static_cast<float>(i % 7));
  return out;
}

// As the proto describes it, with nothing of the code that packs.
v1::FieldFrame unpacked(const v1::FieldFrame& frame, const v1::Mesh& mesh) {
  const auto& packed = frame.packed();
  const auto particles = static_cast<std::size_t>(packed.particle_count());
  std::vector<unsigned char> bytes(4 * particles + static_cast<std::size_t>(packed.element_count()));
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(packed.data().data()), packed.data().size()),
            Z_OK);
  EXPECT_EQ(size, bytes.size());
  v1::FieldFrame out;
  out.mutable_position_mm()->Resize(static_cast<int>(2 * particles), 0.0F);
  std::vector<int> number(2 * particles);
  for (std::size_t i = 0; i < 2 * particles; ++i) {
    int expected = i % particles == 0 ? 0 : number[i - 1];
    std::vector<int> lower;
    for (int k = 0; packed.predicted_by_elements() && k < mesh.element_nodes_size(); ++k) {
      if (mesh.element_nodes(k) != static_cast<int>(i % particles)) continue;
      const int other = mesh.element_nodes(k % 2 == 0 ? k + 1 : k - 1);
      if (other < mesh.element_nodes(k)) lower.push_back(number[i - i % particles + static_cast<std::size_t>(other)]);
    }
    if (lower.size() == 1) expected = lower[0];
    if (lower.size() > 1) expected = static_cast<int>(std::floor((lower[0] + lower[1]) / 2.0));
    number[i] = static_cast<std::int16_t>(expected + bytes[i] + 256 * bytes[2 * particles + i]);
    const auto at = static_cast<int>(2 * (i % particles) + i / particles);
    out.set_position_mm(at, static_cast<float>(mesh.position_mm(at) + number[i] * packed.quantum_mm()));
  }
  for (std::size_t i = 4 * particles; i < bytes.size(); ++i)
    out.add_plastic_fraction(static_cast<float>(bytes[i]) / 255.0F);
  return out;
}

TEST(PackedFrame, HasThePositionsToHalfAQuantumAndThePlasticFractions) {
  const auto mesh = mesh_of(1000);
  for (const double largest : {0.0, 1e-4, 3.0, 500.0}) {
    const auto frame = frame_of(mesh, largest);
    const auto packed = pack(frame, &mesh);
    EXPECT_EQ(packed.index(), 5);
    EXPECT_EQ(packed.strain(), 0.25);
    EXPECT_NEAR(packed.packed().quantum_mm(), std::max(largest / 32767.0, 0.1 / 16.0), 1e-3);
    EXPECT_TRUE(packed.packed().predicted_by_elements());
    const auto back = unpacked(packed, mesh);
    ASSERT_EQ(back.position_mm_size(), frame.position_mm_size());
    for (int i = 0; i < frame.position_mm_size(); ++i)
      ASSERT_NEAR(back.position_mm(i), frame.position_mm(i), 0.51 * packed.packed().quantum_mm() + 1e-4) << i;
    ASSERT_EQ(back.plastic_fraction_size(), frame.plastic_fraction_size());
    for (int i = 0; i < frame.plastic_fraction_size(); ++i)
      ASSERT_NEAR(back.plastic_fraction(i), frame.plastic_fraction(i), 0.5 / 63.0 + 0.5 / 255.0);
  }
}

TEST(PackedFrame, IsSmallWhereLittleMoves) {
  const auto mesh = mesh_of(6400);
  const auto frame = frame_of(mesh, 3.0);
  EXPECT_LT(4 * pack(frame, &mesh).ByteSizeLong(), frame.ByteSizeLong());
}

TEST(PackedFrame, WithoutPositionsBeforeLoadingHasThePositions) {
  const auto mesh = mesh_of(100);
  auto from_nowhere = mesh;
  for (auto& position : *from_nowhere.mutable_position_mm()) position = 0.0F;
  const auto frame = frame_of(mesh, 3.0);
  const auto back = unpacked(pack(frame, nullptr), from_nowhere);
  for (int i = 0; i < frame.position_mm_size(); ++i) ASSERT_NEAR(back.position_mm(i), frame.position_mm(i), 0.01);
}

TEST(FrameChunks, EveryPartPassesAStockClientAndTogetherTheyAreTheFrame) {
  const auto mesh = mesh_of(700'000);
  auto frame = frame_of(mesh, 500.0);
  for (int k = 0; k < 50'000; ++k) {
    frame.add_broken_end(k);
    frame.add_end_position_mm(0.5F);
    frame.add_end_position_mm(static_cast<float>(k));
  }
  for (const bool is_packed : {false, true}) {
    if (is_packed) frame = pack(frame, &mesh);
    v1::FieldFrame whole;
    std::string data;
    const auto parts = chunks_of(frame, 500'000);
    ASSERT_GE(parts.size(), 2U);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_EQ(parts[i].part(), static_cast<int>(i));
      EXPECT_EQ(parts[i].part_count(), static_cast<int>(parts.size()));
      EXPECT_LT(parts[i].ByteSizeLong(), 510'000U);
      data += parts[i].frame().packed().data();
      whole.MergeFrom(parts[i].frame());
    }
    if (is_packed) whole.mutable_packed()->set_data(data);
    EXPECT_EQ(whole.SerializeAsString(), frame.SerializeAsString());
  }
}

TEST(MeshChunks, EveryPartPassesAStockClientAndTogetherTheyAreTheMesh) {
  const auto mesh = mesh_of(700'000);
  ASSERT_GT(mesh.ByteSizeLong(), kStockClient);
  v1::Mesh whole;
  for (const auto& part : chunks_of(mesh)) {
    EXPECT_LT(part.ByteSizeLong(), kStockClient);
    whole.MergeFrom(part.mesh());
  }
  EXPECT_EQ(whole.SerializeAsString(), mesh.SerializeAsString());
  EXPECT_EQ(chunks_of(v1::Mesh()).size(), 1U);
}

}  // namespace
}  // namespace cellcrush::watch
