#include "contact/search/candidate_lists.h"
#include "contact/touch/active_contacts-inl.h"
#include "contact/touch/contact_stages.h"

namespace cellcrush {

void find_active_contacts(const Scene& scene, const State& state, const ContactLists& lists, const Touches& touches,
                          std::size_t first, std::size_t end, std::vector<ActiveContact>& active) {
  active.clear();
  make_room(active, end - first);
  for (int touch = static_cast<int>(first); touch < static_cast<int>(end); ++touch) {
    ActiveContact contact;
    if (HWY_NAMESPACE::is_active(scene, state, lists, touches, touch, contact)) {
      active.push_back(contact);
    }
  }
}

}  // namespace cellcrush
