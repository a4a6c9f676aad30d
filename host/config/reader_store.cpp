#include "host/config/reader.hpp"
#include "host/config/values.hpp"

namespace slideway {

void read_store(Node const& root, Scene& scene) {
    Node const* const node = root.find_path("study.store");
    if (node == nullptr) return;
    scene.store = static_cast<Store>(read_choice(*node, setting("study.store")));
    if (scene.stores_members()) return;
    if (scene.design.kind == DesignKind::saltelli) {
        refuse(*node, {"sensitivity indices need every member's values", "use store = \"members\""});
    }
    if (!scene.sample_times.empty()) {
        refuse(*node, {"time series are of single members", "remove the samples, or use store = \"members\""});
    }
    if (scene.quantities == 0) {
        refuse(*node, {"there is no quantity to make statistics of",
                       "add quantities = [\"peak_normal_force\"], or see `slideway list`"});
    }
}

}  // namespace slideway
