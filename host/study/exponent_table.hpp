// The exponents of a study's members as columns of its result file.
#pragma once

#include <functional>
#include <vector>

#include "host/chaos/exponents.hpp"
#include "host/config/scene.hpp"
#include "host/run/block_buffers.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/orbit_schedule.hpp"

namespace slideway {

/// Axes and columns: `lyapunov_exponent(member, exponent)`, its error, interval and resolution, that of the second half of the record, the
/// running exponents along `history`, how often offsets left their range, and from two exponents on the Kaplan–Yorke dimension.
/// The j-th exponent is that of the j-th shadow: QR sorts them in the limit, and sorting each member's would push near ones
/// apart.  Empty without shadows.
class ExponentTable {
public:
    explicit ExponentTable(Scene const& scene);

    StudyTable const& layout() const { return layout_; }
    StudyValues values(BlockResult const& block) const;

private:
    struct Member {
        GrowthLog log;
        Exponents exponents;
        double resolution;  // [1/s]
        MemberRecord const& record;
    };
    /// A member's row of a column.
    using Row = std::function<std::vector<double>(Member const& member)>;

    void add(StudyColumn column, Row row);
    void add_exponents();
    void add_health();
    void add_history(std::size_t points);
    Member member(BlockResult const& block, std::size_t i) const;

    Parts const parts_;
    OrbitSchedule const schedule_;
    std::size_t const exponents_;
    double const d0_;
    StudyTable layout_;
    std::vector<Row> rows_;  // of the layout's columns
};

}  // namespace slideway
