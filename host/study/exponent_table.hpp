// The exponents of a study's members as columns of its result file.
#pragma once

#include <functional>
#include <vector>

#include "host/chaos/exponents.hpp"
#include "host/config/scene.hpp"
#include "host/run/block_buffers.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/ensemble_plan.hpp"

namespace slideway {

/// Axes and columns: `lyapunov_exponent(member, exponent)`, its error, interval and resolution, that of the second half of the record, the
/// running exponents along `history`, how often offsets left their range, and from two exponents on the Kaplan–Yorke dimension.
/// Of each member the largest exponent is the first, and what is along `exponent` goes with it.  Empty without shadows.
class ExponentTable {
public:
    explicit ExponentTable(Scene const& scene);

    /// Axes and columns, whose source is the row of a member.
    std::vector<ResultColumn> const& columns() const { return columns_; }
    /// All numbers of a member of a block: exponents first, then their errors and the others, in the order of the columns.
    std::vector<double> row(BlockResult const& block, std::size_t place) const;

private:
    struct Member {
        std::vector<double> growths;  // that the log shows
        GrowthLog log;
        Exponents exponents;
        double resolution;  // [1/s]
        double turn;        // how long one of the drive lasts, in the mean [s]
        MemberRecord const& record;
    };
    /// A member's row of a column.
    using Row = std::function<std::vector<double>(Member const& member)>;

    void add(std::string name, std::string unit, std::string meaning, std::vector<std::string> const& along, Row row);
    void add_exponents();
    void add_health();
    void add_history(std::size_t points);
    Member member(BlockResult const& block, std::size_t i) const;

    Parts const parts_;
    OrbitSchedule const schedule_;
    std::size_t const exponents_;
    double const d0_;
    std::vector<ResultColumn> columns_;
    std::size_t width_ = 0;  // of a row
    std::vector<Row> rows_;  // of the columns but for the axes
};

}  // namespace slideway
