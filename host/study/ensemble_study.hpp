// The study `ensemble`: the members of a scene, integrated to one result file.
#pragma once

#include <cstdint>
#include <string>

#include "host/backend/backend.hpp"
#include "host/driver/ensemble.hpp"
#include "host/driver/member_set.hpp"
#include "host/output/provenance.hpp"
#include "host/output/result_layout.hpp"
#include "host/scene/scene.hpp"

namespace slideway {

ResultLayout result_layout(Scene const& scene, MemberRange range);
EnsemblePlan ensemble_plan(Scene const& scene, MemberRange range, Isa isa, int threads);
Provenance provenance(Scene const& scene, Isa isa, int threads);

struct EnsembleOptions {
    std::string output;
    MemberRange range;
    Isa isa = Isa::scalar;
    int threads = 1;
    Progress::Style progress = Progress::Style::none;
};

/// Runs the members and writes the file, also when `stop` ends the run early: members without a result have status
/// not_run there.  The file's place is tried before anything is computed.  @throws FileError.
EnsembleTotals run_ensemble_study(Scene const& scene, EnsembleOptions const& options, StopRequest const& stop);

}  // namespace slideway
