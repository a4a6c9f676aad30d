// What a thread of a grid does with one list of slider-cranks: the bodies of the kernels in host/backend/cuda.cu.  Compiled once per list
// (CMakeLists.txt here).
#include "kernels/grid_thread.hpp"
#include "kernels/integrate.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/models/shadowed.hpp"
#include "kernels/models/slider_crank_choice.hpp"

namespace slideway::testing {

void SLIDEWAY_THREAD(GridTask const& task, bool shadowed) {
    using Cranks = SLIDEWAY_CRANKS_OF<SLIDEWAY_LAW>;
    auto const cranks = chosen_of<Cranks>(task.parts);
    if (shadowed) {
        run_thread(task, [&](Block& block) { integrate<Shadowed<Cranks>, double>(block, Shadowed<Cranks>{cranks}); });
    } else {
        run_thread(task, [&](Block& block) { integrate<Cranks, double>(block, cranks); });
    }
}

}  // namespace slideway::testing
