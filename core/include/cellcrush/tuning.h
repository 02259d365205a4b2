#pragma once

#include <cstddef>
#include <cstdint>

namespace cellcrush {

// Constants that are tuned to a machine. One that "changes bits" determines the order of sums or the layout of
// elements: with another value, results agree only to round-off, and checkpoints cannot be exchanged. One that is
// "speed only" may be changed freely. Times are in ns per element-step, for 16 times the cells of Type I on an AMD EPYC
// with 32 MB of last-level cache, unless stated otherwise.

// Layout of the mesh (scene/mesh.h).

/// Most walls side by side in a block: as many as the widest vector holds single-precision numbers. Changes bits.
inline constexpr int kMostWallsInBlock = 16;

/// Elements of a chunk: few enough that the values passed between its loops stay in the nearest cache. Changes bits.
inline constexpr int kElementsInChunk = 128;

// Bands of a large lattice (contact/topology/bands.h).

/// Fewest elements of a lattice that is cut into bands; a smaller lattice stays in the caches as a whole. Changes bits.
inline constexpr std::size_t kLeastElementsOfBands = 50'000;

/// Fewest bands into which a lattice is cut. Changes bits.
inline constexpr int kLeastBands = 8;

/// Fewest chunks of a band, and how many more it may get where adjacent bands would not otherwise suffice. The fewer
/// chunks, the more steps the caches hold at once. With 16, 20 and 24 chunks: 8.3, 8.5 and 8.6 ns on one thread; 4.7,
/// 4.8 and 5.2 ns on two. Changes bits.
inline constexpr int kLeastChunksOfBand = 16;
inline constexpr int kMoreChunksOfBand = 8;

/// Bytes that a step reads and writes for an element and all data that belongs to it. Changes bits.
inline constexpr std::size_t kBytesOfElement = 430;

/// Bytes of the last-level cache that are to hold the bands of two steps. The lattice is cut for this size on every
/// machine. Changes bits.
inline constexpr std::size_t kCacheOfBands = 28'000'000;

/// Depth that the walls of a band keep, pressed solid along the crush, over the longest element: it keeps the bands on
/// either side so far apart that contacts need not be searched in space. Changes bits.
inline constexpr double kSolidDepthOfBand = 2.5;

// Steps.

/// Most particles of a chunk that is moved at once: all joints, or all particles inside walls, counted from the first.
/// Bands consist of whole chunks. Changes bits.
inline constexpr int kParticlesMovedTogether = 256;

/// Blocks of walls, and chunks of particles, that a thread looks at for a sample at once. Changes bits of the elastic
/// energy in samples.
inline constexpr std::size_t kSampledTogether = 64;

/// Lanes over which works are summed, whatever the vector width of the target. Changes bits.
inline constexpr int kSumLanes = 8;

/// Chunks of walls in a piece, which a thread computes at once while another evaluates contacts. Speed only.
inline constexpr std::size_t kChunksInPiece = 2;

/// Most elements for which two threads overlap walls with contacts. With more, the strains passed between the stages of
/// the walls do not stay in the nearest cache. With 16 times the cells of Type I two threads would lose a third, with 4
/// times nothing. Speed only.
inline constexpr std::size_t kMostElementsOverlapped = 20'000;

/// How many rows ahead fibres are prefetched from memory. Speed only.
inline constexpr std::ptrdiff_t kRowsAhead = 8;

/// Fibre stresses are prefetched if they fill more than one part in this many of the last-level cache: they do not stay
/// there from step to step. With 16 times the cells of Type I the walls then take a third less time. With fewer fibres,
/// prefetching costs 0.15 ns. Speed only.
inline constexpr std::size_t kCacheShareOfFibres = 8;

/// Most steps of a large lattice in progress at once. With 4, 7, 10 and 20 steps: 9.3, 8.5, 8.3 and 9.3 ns before
/// contacts begin. Speed only.
inline constexpr std::size_t kMostStepsAtOnce = 10;

/// Most steps in a wavefront: mostly all steps between two samples, so that later steps begin while the first ones end.
/// Speed only.
inline constexpr std::int64_t kMostStepsInWavefront = 32;

/// Steps that a wavefront has at least, unless fewer are asked for: with borders so near that it would have fewer, the
/// contacts are searched in space. Speed only.
inline constexpr std::int64_t kFewestStepsInWavefront = 4;

/// Checks of a flag before a thread yields: some hundred microseconds, longer than the gaps between the loops of a
/// step. Speed only.
inline constexpr int kSpinCount = 4000;

// Contact search and touches. Forces are summed in the order of balls and segments, however pairs were found. With
// other values the motion therefore has the same bits, but the lists in a checkpoint differ.

/// Particles that share a flag of State::contact_tiles. Speed only.
inline constexpr std::size_t kContactTile = 8;

/// Steps between two rebuilds of these flags. Speed only.
inline constexpr std::int64_t kStepsBetweenTiles = 64;

/// Candidates of a batch, all of one face. Speed only.
inline constexpr int kCandidateBatch = 8;

/// Empty batches that the lists may have, beyond a quarter of the others, before they are compacted. Speed only.
inline constexpr std::int64_t kEmptyBatches = 128;

/// Candidates whose data is gathered before they are tested. Speed only.
inline constexpr std::size_t kTestedTogether = 64;

/// Faces of a group, which are checked together. A group in a band has fewer: bands are narrow across the crush, so a
/// group of 64 faces would be long along it. Speed only.
inline constexpr int kFacesPerGroup = 64;
inline constexpr int kFacesPerGroupOfBands = 32;

/// Aspect ratio of a group of faces: its length across the crush over that along it. Near the front, faces side by side
/// move alike, and faces behind each other do not. Speed only.
inline constexpr double kPatchAspect = 7.0;

/// Fraction of the clearance of a face below which its list is rebuilt. Speed only.
inline constexpr double kWorthKeeping = 0.1;

/// Skin: how far beyond touch candidates are collected, as a fraction of the shortest element. The first is for
/// buckets. The second is for faces, whose lists are cheap to rebuild; faces of many corners have kWideSkin times as
/// much. Speed only.
inline constexpr double kSkinFraction = 0.35;
inline constexpr double kFaceSkinFraction = 0.20;
inline constexpr double kWideSkin = 3.5;

}  // namespace cellcrush
