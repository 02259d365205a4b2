#include "search/find_contacts.h"

#include "search/bucket_search.h"
#include "search/face_search.h"
#include "search/merge_band_contacts.h"

namespace cellcrush {
namespace {

/// Returns false if walls are found to have crossed.
bool search_bands(const Scene& scene, State& state, Workers& workers) {
  bool is_planar = true;
  for (std::size_t band = 0; band < scene.bands.size() && is_planar; ++band) {
    is_planar = search_faces(scene, state, band, state.contacts[band], workers);
  }
  return is_planar;
}

}  // namespace

void search_space(const Scene& scene, State& state) {
  const bool is_planar = search_buckets(scene, state, state.contacts.front());
  if (!is_planar && state.crossing_step < 0) {
    state.crossing_step = state.step;
  }
}

bool searches_faces(const Scene& scene, const State& state) {
  return scene.faces.are_enough() && state.contacts.front().searched_position.empty() && state.crossing_step < 0;
}

bool has_left_faces(const Scene& scene, const State& state) {
  return scene.contact.present && scene.faces.are_enough() && !searches_faces(scene, state);
}

void find_contacts(const Scene& scene, State& state, Workers& workers) {
  if (!scene.contact.present) {
    return;
  }
  if (searches_faces(scene, state) && !search_bands(scene, state, workers)) {
    state.crossing_step = state.step;
    merge_band_contacts(state);
  }
  if (!searches_faces(scene, state)) {
    search_space(scene, state);
  }
}

}  // namespace cellcrush
