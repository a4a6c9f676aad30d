// What a thread of a grid does: the bodies of the kernels in host/backend/cuda.cu.
#include "kernels/grid_thread.hpp"
#include "kernels/integrate.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/models/every_law.hpp"
#include "kernels/models/mechanism_model.hpp"
#include "kernels/models/shadowed.hpp"
#include "tests/support/grid_cranks/grid_cranks.hpp"

namespace slideway::testing {

void run_grid_thread(GridTask const& task, bool shadowed) {
    using Cranks = MechanismModel<SliderCrank, SliderBase, EveryLaw>;
    Cranks const cranks(conditions_with_every_law(task.parts));
    if (shadowed) {
        run_thread(task, [&](Block& block) { integrate<Shadowed<Cranks>, double>(block, Shadowed<Cranks>{cranks}); });
    } else {
        run_thread(task, [&](Block& block) { integrate<Cranks, double>(block, cranks); });
    }
}

}  // namespace slideway::testing
