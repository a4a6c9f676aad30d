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
    {"study.seed", "1", study_sets::all, "of what [study.vary] draws"},
    {"study.revolutions", "1", study_sets::all, "how long it records; lyapunov 10, poincare 150, sweep 50"},
    {"study.duration", "s", study_sets::all & ~study_sets::sweep, "the same as a time"},
    {"study.samples_per_revolution", "1", study_sets::ensemble, "time series"},
    {"study.samples", "1", study_sets::ensemble, "the same in all"},
    {"study.quantities", "", study_sets::all, "names of quantities and, in an ensemble, series"},
    {"study.transient_revolutions", "1", study_sets::chaos, "left out before; lyapunov 2, else 20"},
    {"study.Ttr", "s", study_sets::chaos, "the same as a time"},
    {"study.phase", "rad", study_sets::poincare | study_sets::sweep, "crank angle of the sections"},
    {"study.section", "", study_sets::poincare,
     "{ on = \"vy\", value = \"0 mm/s\", direction = \"rising\" }: a state, or a gap like gap_y[P1]; rising, falling, "
     "both"},
    {"study.max_crossings", "1", study_sets::poincare, "of study.section, recorded of a member"},
    {"study.exponents", "1", study_sets::lyapunov | study_sets::sweep,
     "how many Lyapunov exponents; sweep: 0 for none"},
    {"study.d0", "1", study_sets::lyapunov | study_sets::sweep, "distance of neighbours, in the scales of atol"},
    {"study.d0_lower", "1", study_sets::lyapunov | study_sets::sweep, "below it one is rescaled; d0/1000"},
    {"study.d0_upper", "1", study_sets::lyapunov | study_sets::sweep, "above it one is rescaled; 1000 d0"},
    {"study.rescalings_per_revolution", "1", study_sets::lyapunov | study_sets::sweep, "how often"},
    {"study.dt", "s", study_sets::lyapunov, "time between rescalings"},
    {"study.history", "1", study_sets::lyapunov, "points of the convergence history, 0 for none"},
    {"study.parameter", "", study_sets::sweep, "the key that changes from column to column"},
    {"study.values", "", study_sets::sweep, "its values, a list"},
    {"study.from", "", study_sets::sweep, "or the first"},
    {"study.to", "", study_sets::sweep, "and the last"},
    {"study.points", "1", study_sets::sweep, "of so many"},
    {"study.spacing", "", study_sets::sweep, "linear or log"},
    {"study.start", "", study_sets::sweep, "fresh, or continue from the column before"},
    {"study.vary", "", study_sets::all, "distributions of keys"},
};

}  // namespace slideway
