#pragma once

#include <array>
#include <string_view>

namespace cellcrush {

/// Measured error of one quantity of a preset, crushed by force-based elements at one plate speed.
struct MeasuredRow {
  std::string_view preset;
  std::string_view quantity;
  double speed_m_per_s = 0.0;
  int elements_per_wall = 0;
  double error = 0.0;        ///< as MeshEstimate::error
  double uncertainty = 0.0;  ///< as MeshEstimate::uncertainty
  double scatter = 0.0;      ///< standard deviation of one crush, relative to its mean
};

/// All that was measured: for hexagons tests/bench/results/mesh_study.csv, for squares and triangles
/// tests/validation/example_2_seeds.csv and example_2_mesh.csv (all with seeds of 0.01 mm, to 41 % strain), for
/// Example 1 tests/bench/results/work_precision.csv (3 seeds of 0.001 mm). tests/bench/fidelity_numbers_test.cpp holds
/// every row to them and prints them for this list.
inline constexpr auto kMeasuredRows = std::to_array<MeasuredRow>({
    {"type-i", "impact plateau", 25, 1, 0.059, 0.0141, 0.0072},
    {"type-i", "impact plateau", 25, 2, 0.0172, 0.0167, 0.0113},
    {"type-i", "impact plateau", 25, 4, 0.0066, 0.0218, 0.0176},
    {"type-i", "impact plateau", 25, 8, 0.0066, 0.0218, 0.0118},
    {"type-i", "support plateau", 25, 1, 0.0244, 0.0577, 0.0199},
    {"type-i", "support plateau", 25, 2, 0.0454, 0.0602, 0.0252},
    {"type-i", "support plateau", 25, 4, 0.0076, 0.0888, 0.0679},
    {"type-i", "support plateau", 25, 8, 0.0076, 0.0888, 0.052},
    {"type-i", "impact plateau", 50, 1, 0.0588, 0.0266, 0.0256},
    {"type-i", "impact plateau", 50, 2, 0.0047, 0.0156, 0.0121},
    {"type-i", "impact plateau", 50, 4, 0.0083, 0.0142, 0.0102},
    {"type-i", "impact plateau", 50, 8, 0.0083, 0.0142, 0.0092},
    {"type-i", "support plateau", 50, 1, 0.1579, 0.0848, 0.0949},
    {"type-i", "support plateau", 50, 2, 0.0036, 0.0316, 0.0242},
    {"type-i", "support plateau", 50, 4, 0.0024, 0.0213, 0.0086},
    {"type-i", "support plateau", 50, 8, 0.0024, 0.0213, 0.0187},
    {"type-i", "impact plateau", 75, 1, 0.0311, 0.0125, 0.0111},
    {"type-i", "impact plateau", 75, 2, 0.0232, 0.0097, 0.0077},
    {"type-i", "impact plateau", 75, 4, 0.0042, 0.0091, 0.0069},
    {"type-i", "impact plateau", 75, 8, 0.0042, 0.0091, 0.0055},
    {"type-i", "support plateau", 75, 1, 0.0695, 0.0929, 0.0923},
    {"type-i", "support plateau", 75, 2, 0.0353, 0.0373, 0.0253},
    {"type-i", "support plateau", 75, 4, 0.0012, 0.0406, 0.029},
    {"type-i", "support plateau", 75, 8, 0.0012, 0.0406, 0.0267},
    {"type-i", "impact plateau", 100, 1, 0.0399, 0.0118, 0.0084},
    {"type-i", "impact plateau", 100, 2, 0.017, 0.0095, 0.0046},
    {"type-i", "impact plateau", 100, 4, 0.0094, 0.0115, 0.0077},
    {"type-i", "impact plateau", 100, 8, 0.0094, 0.0115, 0.008},
    {"type-i", "support plateau", 100, 1, 0.0755, 0.0294, 0.0294},
    {"type-i", "support plateau", 100, 2, 0.0005, 0.0097, 0.0041},
    {"type-i", "support plateau", 100, 4, 0.0011, 0.0093, 0.0029},
    {"type-i", "support plateau", 100, 8, 0.0011, 0.0093, 0.0085},
    {"type-i", "impact plateau", 200, 1, 0.0338, 0.0054, 0.0051},
    {"type-i", "impact plateau", 200, 2, 0.0067, 0.0048, 0.0043},
    {"type-i", "impact plateau", 200, 4, 0.0008, 0.0033, 0.0026},
    {"type-i", "impact plateau", 200, 8, 0.0008, 0.0033, 0.0019},
    {"type-i", "support plateau", 200, 1, 0.0751, 0.0073, 0.0053},
    {"type-i", "support plateau", 200, 2, 0.0257, 0.0125, 0.0108},
    {"type-i", "support plateau", 200, 4, 0.0024, 0.013, 0.0116},
    {"type-i", "support plateau", 200, 8, 0.0024, 0.013, 0.005},
    {"type-ii-as-counted", "impact plateau", 50, 8, 0.0579, 0.1205, 0.0924},
    {"type-ii-as-counted", "impact plateau", 50, 16, 0.0579, 0.1205, 0.0776},
    {"type-ii-as-counted", "support plateau", 50, 8, 0.0176, 0.2677, 0.1747},
    {"type-ii-as-counted", "support plateau", 50, 16, 0.0176, 0.2677, 0.1942},
    {"type-ii-as-counted", "impact plateau", 75, 8, 0.0016, 0.0463, 0.0362},
    {"type-ii-as-counted", "impact plateau", 75, 16, 0.0016, 0.0463, 0.0264},
    {"type-ii-as-counted", "support plateau", 75, 8, 0.2268, 0.2211, 0.2064},
    {"type-ii-as-counted", "support plateau", 75, 16, 0.2268, 0.2211, 0.1426},
    {"type-ii-as-counted", "impact plateau", 100, 8, 0.0035, 0.1041, 0.0675},
    {"type-ii-as-counted", "impact plateau", 100, 16, 0.0035, 0.1041, 0.0746},
    {"type-ii-as-counted", "support plateau", 100, 8, 0.2201, 0.2329, 0.179},
    {"type-ii-as-counted", "support plateau", 100, 16, 0.2201, 0.2329, 0.0559},
    {"type-ii-as-counted", "impact plateau", 200, 8, 0.0063, 0.0335, 0.0225},
    {"type-ii-as-counted", "impact plateau", 200, 16, 0.0063, 0.0335, 0.0235},
    {"type-ii-as-counted", "support plateau", 200, 8, 0.1, 0.1092, 0.0776},
    {"type-ii-as-counted", "support plateau", 200, 16, 0.1, 0.1092, 0.0624},
    {"type-iii-as-counted", "impact plateau", 150, 8, 0.0019, 0.0107, 0.0072},
    {"type-iii-as-counted", "impact plateau", 150, 16, 0.0019, 0.0107, 0.0075},
    {"type-iii-as-counted", "support plateau", 150, 8, 0.0952, 0.0552, 0.0188},
    {"type-iii-as-counted", "support plateau", 150, 16, 0.0952, 0.0552, 0.0507},
    {"type-iii-as-counted", "impact plateau", 200, 8, 0.0029, 0.0107, 0.0036},
    {"type-iii-as-counted", "impact plateau", 200, 16, 0.0029, 0.0107, 0.0098},
    {"type-iii-as-counted", "support plateau", 200, 8, 0.0911, 0.1548, 0.0834},
    {"type-iii-as-counted", "support plateau", 200, 16, 0.0911, 0.1548, 0.1293},
    {"papka-kyriakides-1", "limit stress", 1, 1, 0.0213, 0.0037, 0.0007},
    {"papka-kyriakides-1", "limit stress", 1, 2, 0.0074, 0.0042, 0.0014},
    {"papka-kyriakides-1", "limit stress", 1, 8, 0.0074, 0.0042, 0.0022},
});

}  // namespace cellcrush
