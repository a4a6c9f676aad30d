// The exponents of a study's members as columns of its result file.
#pragma once

#include "host/chaos/exponents.hpp"
#include "host/driver/block_result.hpp"
#include "host/output/study_columns.hpp"
#include "host/scene/scene.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {

/// Axes and columns: `lyapunov_exponent(member, exponent)`, its standard error and resolution, the running exponents along
/// `history`, how often an offset was lost, and from two exponents on the Kaplan–Yorke dimension.  Empty without shadows.
class ExponentTable {
public:
    explicit ExponentTable(Scene const& scene);

    StudyTable const& layout() const { return layout_; }
    StudyValues values(BlockResult const& block) const;

private:
    /// @param order of the offsets by their exponents.
    std::vector<double> history_of(GrowthLog const& log, std::vector<std::size_t> const& order) const;

    OrbitSchedule const schedule_;
    std::size_t const exponents_;
    double const d0_;
    std::vector<std::size_t> history_;  // records after which the running exponents are kept
    StudyTable layout_;
};

}  // namespace slideway
