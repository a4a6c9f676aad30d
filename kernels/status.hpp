// How a member ended.  Stored as `status(member)` in every result file; values never change their meaning.
#pragma once

namespace slideway {

enum class Status : signed char {
    not_run = -1,        // the run stopped before the member started or ended
    finished = 0,        // reached the end time
    step_too_small = 1,  // the error control asked for a step below the resolution of time, or resets pile up below it
    max_steps = 2,       // spent integrator.max_steps
    nonfinite = 3,       // NaN or infinity in state, derivative or linear equations at any step that resolves time
    geometry = 4,        // the rod does not reach: L² − (y−y_A)² − z² ≤ 0
    contact_domain = 5,  // a line contact beyond its domain δ̄ ≤ l²/R_e; rigid contacts that have jammed
    invalid_inputs = 6,  // the inputs drawn for the member cannot be used; it was not integrated
    unstable = 7,        // reached the end time, but its energy audit says that the method left its stable range
    out_of_time = 8,     // its crank has not turned as far as it was to within study.time_limit
};

inline constexpr int status_count = 9;  // without not_run
inline constexpr char const* status_names[status_count] = {"finished",       "step_too_small", "max_steps", "nonfinite",  "geometry",
                                                           "contact_domain", "invalid_inputs", "unstable",  "out_of_time"};

}  // namespace slideway
