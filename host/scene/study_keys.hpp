// Which keys of [study] belong to which study.
#pragma once

#include <string_view>

#include "host/scene/study_settings.hpp"

namespace slideway {

/// A set of studies: bit i for StudyKind i.
using StudySet = unsigned;
constexpr StudySet set_of(StudyKind kind) { return 1u << static_cast<int>(kind); }

struct StudyKey {
    std::string_view name;  // dotted
    std::string_view unit;  // SI; "1" for a plain number, "" for what is none
    StudySet studies;       // that read it
    std::string_view meaning;
};

namespace study_sets {
inline constexpr StudySet ensemble = set_of(StudyKind::ensemble), lyapunov = set_of(StudyKind::lyapunov),
                          poincare = set_of(StudyKind::poincare), sweep = set_of(StudyKind::sweep);
inline constexpr StudySet chaos = lyapunov | poincare | sweep, all = ensemble | chaos;
}  // namespace study_sets

inline constexpr StudyKey study_keys[] = {
    {"study.kind", "", study_sets::all, "which study"},
    {"study.members", "1", study_sets::all, "members; sweep: starts per column"},
    {"study.seed", "1", study_sets::all, "seed of what [study.vary] draws"},
    {"study.revolutions", "1", study_sets::all,
     "how many are recorded; ensemble 1, lyapunov 10, poincare 150, sweep 50"},
    {"study.duration", "s", study_sets::all & ~study_sets::sweep, "or a time"},
    {"study.samples_per_revolution", "1", study_sets::ensemble, "samples of the time series, 0 for none"},
    {"study.samples", "1", study_sets::ensemble, "or their number in all, first and last included"},
    {"study.quantities", "", study_sets::all, "names of quantities and, in an ensemble, series"},
    {"study.transient_revolutions", "1", study_sets::chaos, "left out before them; lyapunov 2, else 20"},
    {"study.Ttr", "s", study_sets::chaos, "or a time"},
    {"study.phase", "rad", study_sets::poincare | study_sets::sweep, "crank angle of the sections; 0"},
    {"study.section", "", study_sets::poincare,
     "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }: a state, or a gap like gap_y[P1]; rising, falling, "
     "both"},
    {"study.max_crossings", "1", study_sets::poincare,
     "most crossings of study.section that are recorded of a member; 1000"},
    {"study.exponents", "1", study_sets::lyapunov | study_sets::sweep,
     "how many Lyapunov exponents, sweep: 0 for none; 1"},
    {"study.d0", "1", study_sets::lyapunov | study_sets::sweep, "distance of neighbours, in the scales of atol; 1e-6"},
    {"study.d0_lower", "1", study_sets::lyapunov | study_sets::sweep,
     "below it a single neighbour is rescaled; d0/1000"},
    {"study.d0_upper", "1", study_sets::lyapunov | study_sets::sweep,
     "above it a single neighbour is rescaled; 1000 d0"},
    {"study.rescalings_per_revolution", "1", study_sets::lyapunov | study_sets::sweep,
     "how often neighbours are rescaled; 2000"},
    {"study.dt", "s", study_sets::lyapunov, "or the time between rescalings"},
    {"study.history", "1", study_sets::lyapunov, "points of the convergence history, 0 for none; 100"},
    {"study.parameter", "", study_sets::sweep, "the key that changes from column to column"},
    {"study.values", "", study_sets::sweep, "list of its values"},
    {"study.from", "", study_sets::sweep, "or the first value"},
    {"study.to", "", study_sets::sweep, "the last value"},
    {"study.points", "1", study_sets::sweep, "and how many there are"},
    {"study.spacing", "", study_sets::sweep, "of these: linear, log"},
    {"study.start", "", study_sets::sweep, "of a column: fresh, or continue from the last states of the one before"},
    {"study.vary", "", study_sets::all, "how numeric keys scatter over the members"},
};

}  // namespace slideway
