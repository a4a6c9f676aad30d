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
                          poincare = set_of(StudyKind::poincare), sweep = set_of(StudyKind::sweep),
                          tolerance = set_of(StudyKind::tolerance);
inline constexpr StudySet chaos = lyapunov | poincare | sweep, to_end = ensemble | tolerance, all = to_end | chaos;
}  // namespace study_sets

inline constexpr StudyKey study_keys[] = {
    {"study.kind", "", study_sets::all, "which study"},
    {"study.members", "1", study_sets::all, "members; sweep: starts per column"},
    {"study.seed", "1", study_sets::all, "seed of what [study.vary] draws"},
    {"study.verify", "1", study_sets::all,
     "members that run again with a hundredth of the tolerance and by another method, to check what the study says, 0 for none; as many "
     "as a tenth of the study's work allows, at most 16"},
    {"study.revolutions", "1", study_sets::all,
     "how many are recorded, of the crank, or of a carriage there and back; ensemble and tolerance 1, lyapunov 10, "
     "poincare 150, sweep 50"},
    {"study.duration", "s", study_sets::all & ~study_sets::sweep, "or a time"},
    {"study.samples_per_revolution", "1", study_sets::to_end, "samples of the time series, 0 for none"},
    {"study.samples", "1", study_sets::to_end, "or their number in all, first and last included"},
    {"study.quantities", "", study_sets::all, "names of quantities and, with samples, series"},
    {"study.transient_revolutions", "1", study_sets::chaos, "left out before them; lyapunov 2, else 20"},
    {"study.Ttr", "s", study_sets::chaos, "or a time"},
    {"study.phase", "rad", study_sets::poincare | study_sets::sweep,
     "crank angle of the sections, or phase of a carriage; 0"},
    {"study.section", "", study_sets::poincare,
     "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }: a state, or in space a gap like gap_y[P1]; rising, "
     "falling, "
     "both"},
    {"study.max_crossings", "1", study_sets::poincare,
     "most crossings of study.section that are recorded of a member; 1000"},
    {"study.exponents", "1", study_sets::lyapunov | study_sets::sweep,
     "how many Lyapunov exponents, sweep: 0 for none; 1"},
    {"study.d0", "1", study_sets::lyapunov | study_sets::sweep, "distance of neighbours, in the scales of atol; 1e-6"},
    {"study.d0_lower", "1", study_sets::lyapunov | study_sets::sweep,
     "below it a single neighbour is rescaled; 0.3 d0"},
    {"study.d0_upper", "1", study_sets::lyapunov | study_sets::sweep, "above it a single neighbour is rescaled; 3 d0"},
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
    {"study.design", "", study_sets::all, "how the members are spread over what varies: see designs; mc"},
    {"study.base", "1", study_sets::to_end, "rows of saltelli, a power of two; members = base (keys that vary + 2)"},
    {"study.levels", "1", study_sets::all & ~study_sets::sweep,
     "grid: levels of each key that has no levels = k of its own in [study.vary]"},
    {"study.table", "", study_sets::all & ~study_sets::sweep,
     "file of the table, beside the scene: dotted keys, [unit] behind them, above a row for each member"},
    {"study.store", "", study_sets::to_end,
     "members, or statistics: counts, moments and sketched quantiles in place of the members; members"},
    {"study.vary", "", study_sets::all, "how numeric keys scatter over the members"},
    {"study.correlation", "", study_sets::all,
     "{ keys = [\"joint.clearance_y\", ...], matrix = [[1, 0.5], [0.5, 1]] } of keys that vary"},
    {"study.limits", "", study_sets::to_end,
     "{ min = ..., max = ... } of a quantity, \"mode_time[free]\" where it has several values"},
};

}  // namespace slideway
