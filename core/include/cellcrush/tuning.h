#pragma once

#include <cstddef>
#include <cstdint>

namespace cellcrush {

// What is tuned to a machine. A constant that "changes bits" decides in which order numbers are summed or elements are
// laid out: results of another value agree to round-off only, and checkpoints of one are none of the other. One that is
// "speed only" may be changed at will. Figures: ns an element-step, 16 times the cells of Type I, an AMD EPYC with 32
// MB of last cache, unless said otherwise.

// Layout of the mesh (scene/mesh.h).

/// Most walls side by side in a block: the widest vector of single-precision numbers. Changes bits.
inline constexpr int kMostWallsInBlock = 16;

/// Elements of a chunk: few enough that what passes between the loops over it stays in the nearest cache. Changes bits.
inline constexpr int kElementsInChunk = 128;

// Bands of a large lattice (scene/bands.h).

/// A smaller lattice stays in the caches as it is. Changes bits.
inline constexpr std::size_t kLeastElementsOfBands = 50'000;

/// Bands that a lattice is cut into, at least. Changes bits.
inline constexpr int kLeastBands = 8;

/// Chunks of a band, at least, and how many more where neighbours would not be enough: the fewer, the more steps the
/// caches hold at once. 16, 20 and 24: one thread 8.3, 8.5 and 8.6, two 4.7, 4.8 and 5.2. Changes bits.
inline constexpr int kLeastChunksOfBand = 16;
inline constexpr int kMoreChunksOfBand = 8;

/// Bytes that a step reads and writes for an element, with what goes with it. Changes bits.
inline constexpr std::size_t kBytesOfElement = 430;

/// Bytes of a last cache that holds the bands of two steps; the lattice is cut for it whatever the machine has. Changes
/// bits.
inline constexpr std::size_t kCacheOfBands = 28'000'000;

// Steps.

/// Particles that are moved together at most: so many joints, or so many particles inside walls, from the first on.
/// Bands consist of whole such chunks. Changes bits.
inline constexpr int kParticlesMovedTogether = 256;

/// Lanes over which works are summed, whatever the target's are. Changes bits.
inline constexpr int kSumLanes = 8;

/// Chunks of walls that a thread takes at once while another evaluates contacts. Speed only.
inline constexpr std::size_t kChunksInPiece = 2;

/// With more elements than this, the strains that pass between the walls' stages do not stay in the nearest cache, and
/// two threads do not overlap walls with contacts: with 16 times the cells of Type I they would lose a third, with 4
/// times nothing. Speed only.
inline constexpr std::size_t kMostElementsOverlapped = 20'000;

/// Rows ahead of which fibres are prefetched from memory. Speed only.
inline constexpr std::ptrdiff_t kRowsAhead = 8;

/// Share of the last cache above which fibre stresses do not stay there from step to step and are prefetched: with 16
/// times the cells of Type I the walls take a third less. With fewer fibres, prefetching costs 0.15. Speed only.
inline constexpr std::size_t kCacheShareOfFibres = 8;

/// Most steps of a large lattice at work at once: 4, 7, 10, 20 steps 9.3, 8.5, 8.3, 9.3 before contacts. Speed only.
inline constexpr std::size_t kMostStepsAtOnce = 10;

/// Most steps in a block, so that the next begin where the first end: as many as there are between two samples, mostly.
/// Speed only.
inline constexpr std::int64_t kMostStepsInBlock = 32;

/// Checks of a flag before a thread yields: some hundred microseconds, longer than the gaps between a step's loops.
/// Speed only.
inline constexpr int kSpinCount = 4000;

// Contact search and touches. Forces are summed in the order of balls and segments however pairs were found, so the
// motion has the same bits with other values; the lists in a checkpoint have not.

/// Particles that share a flag of State::contact_tiles. Speed only.
inline constexpr std::size_t kContactTile = 8;

/// Steps between two rebuilds of these flags. Speed only.
inline constexpr std::int64_t kStepsBetweenTiles = 64;

/// Candidates that stand together, of one face. Speed only.
inline constexpr int kCandidateBatch = 8;

/// Empty batches that a list may have before it is closed up. Speed only.
inline constexpr std::int64_t kEmptyBatches = 128;

/// Candidates whose numbers are gathered before they are tested. Speed only.
inline constexpr std::size_t kTestedTogether = 64;

/// Faces that are watched together. Bands are narrow across the crush, so that as many would be long along it. Speed
/// only.
inline constexpr int kFacesPerGroup = 64;
inline constexpr int kFacesPerGroupOfBands = 32;

/// Length across the crush of a patch of faces that are watched together, over its length along the crush: at the
/// front, faces side by side move alike, and faces behind each other do not. Speed only.
inline constexpr double kPatchAspect = 7.0;

/// Share of a face's clearance below which its list is rebuilt. Speed only.
inline constexpr double kWorthKeeping = 0.1;

/// Contact candidates are collected this share of the shortest element beyond touch; those of a face, whose list is
/// cheap to make, less; those of a face of many corners so many times more. Speed only.
inline constexpr double kSkinFraction = 0.35;
inline constexpr double kFaceSkinFraction = 0.20;
inline constexpr double kWideSkin = 3.5;

}  // namespace cellcrush
