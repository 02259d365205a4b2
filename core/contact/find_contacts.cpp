#include "contact/find_contacts.h"

#include "contact/bucket_search.h"
#include "contact/face_search.h"

namespace cellcrush {

void find_contacts(const Scene& scene, State& state, Workers& workers) {
  if (!scene.contact.present) {
    return;
  }
  if (scene.faces.are_enough() && state.crossing_step < 0) {
    search_faces(scene, state, workers);
  }
  if (!scene.faces.are_enough() || state.crossing_step >= 0) {
    search_buckets(scene, state);
  }
}

}  // namespace cellcrush
