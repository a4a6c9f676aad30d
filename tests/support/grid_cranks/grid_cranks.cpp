#include "tests/support/grid_cranks/grid_cranks.hpp"

namespace slideway::testing {

// One for each list, as cuda_kernels.hpp has them.
void run_paper_thread(GridTask const& task, bool shadowed);
void run_paper_impact_thread(GridTask const& task, bool shadowed);
void run_conservative_thread(GridTask const& task, bool shadowed);
void run_conservative_impact_thread(GridTask const& task, bool shadowed);

void run_grid_thread(GridTask const& task, bool shadowed) {
    bool const impacts = task.parts.damping == Damping::restitution;
    if (task.parts.law == Law::paper) {
        (impacts ? run_paper_impact_thread : run_paper_thread)(task, shadowed);
    } else {
        (impacts ? run_conservative_impact_thread : run_conservative_thread)(task, shadowed);
    }
}

}  // namespace slideway::testing
