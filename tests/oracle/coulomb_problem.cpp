#include "coulomb_problem.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "linear_solve.hpp"

namespace oracle::detail {
namespace {

using Real = CoulombProblem::Real;
using Table = CoulombProblem::Table;
using Column = CoulombProblem::Column;
using Vector2 = Eigen::Matrix<Real, 2, 1>;
using Index = Eigen::Index;

constexpr Real rounding = 1e-14L;  // violation, over the largest motion

[[nodiscard]] Index count(CoulombProblem const& p) { return static_cast<Index>(p.contacts.size()); }
[[nodiscard]] CoulombProblem::Contact const& contact(CoulombProblem const& p, Index i) {
    return p.contacts[static_cast<std::size_t>(i)];
}

/// The longest motion there is, which rounding is measured by.
[[nodiscard]] Real largest_motion(CoulombProblem const& p) {
    Real most = std::numeric_limits<Real>::min();
    for (Index i = 0; i < 3 * count(p); ++i) most = std::max(most, std::abs(p.motion[i]));
    return most;
}

// Without friction, or with friction whose direction is known: normal impulses alone, a linear complementarity problem.  Every set of contacts that
// close is tried; a solution with contacts that are independent of one another always exists, so others are passed over.

[[nodiscard]] Column with_friction(CoulombProblem const& p, Column const& normal) {
    Column impulses = Column::Zero(3 * count(p));
    for (Index i = 0; i < count(p); ++i) {
        impulses[3 * i] = normal[i];
        if (contact(p, i).slips)
            impulses.segment<2>(3 * i + 1) = -contact(p, i).friction * normal[i] * contact(p, i).along;
    }
    return impulses;
}

[[nodiscard]] Column by_enumeration(CoulombProblem const& p) {
    Index const n = count(p);
    Table normal_of(n, n);  // γ_N⁺ of unit normal impulses
    Column gap_rate(n);
    for (Index j = 0; j < n; ++j) {
        Column const pushed = p.mobility * with_friction(p, Column::Unit(n, j));
        for (Index i = 0; i < n; ++i) normal_of(i, j) = pushed[3 * i];
        gap_rate[j] = p.motion[3 * j] - contact(p, j).least;
    }
    Column best = Column::Zero(3 * n);
    Real least = violation(p, best);
    for (std::uint32_t set = 1; set < (1u << n) && least > rounding / 100; ++set) {
        std::vector<Index> closed;
        for (Index i = 0; i < n; ++i) {
            if ((set >> i & 1u) != 0) closed.push_back(i);
        }
        auto const m = static_cast<Index>(closed.size());
        if (m > 6) continue;
        Table small(m, m);
        Column right(m);
        for (Index a = 0; a < m; ++a) {
            right[a] = -gap_rate[closed[static_cast<std::size_t>(a)]];
            for (Index b = 0; b < m; ++b)
                small(a, b) = normal_of(closed[static_cast<std::size_t>(a)], closed[static_cast<std::size_t>(b)]);
        }
        auto lu = Eigen::FullPivLU<Table>(small);
        lu.setThreshold(1e-12L);
        if (!lu.isInvertible()) continue;
        Column const push = lu.solve(right);
        Column normal = Column::Zero(n);
        for (Index a = 0; a < m; ++a) normal[closed[static_cast<std::size_t>(a)]] = push[a];
        Column const tried = with_friction(p, normal);
        Real const breaks = violation(p, tried);
        if (breaks < least) least = breaks, best = tried;
    }
    return best;
}

// With friction: the conditions as equations, Λ = proj(Λ − r γ) (Alart & Curnier 1991), by Newton's method from where slow but sure steps have led.

class Projections {
public:
    explicit Projections(CoulombProblem const& p) : p_(p), n_(count(p)), steps_(3 * n_) {
        for (Index i = 0; i < n_; ++i) {
            steps_[3 * i] = 1 / p.mobility(3 * i, 3 * i);
            steps_[3 * i + 1] = steps_[3 * i + 2] =
                2 / (p.mobility(3 * i + 1, 3 * i + 1) + p.mobility(3 * i + 2, 3 * i + 2));
        }
        slow_ = 1 / p.mobility.norm();
    }

    void walk(Column& impulses, int rounds) const {
        for (int round = 0; round < rounds; ++round) {
            Column const motion = p_.motion + p_.mobility * impulses;
            for (Index i = 0; i < n_; ++i) {
                auto const& c = contact(p_, i);
                Real const push = std::max(Real(0), impulses[3 * i] - slow_ * (motion[3 * i] - c.least));
                Vector2 const drag = impulses.segment<2>(3 * i + 1) - slow_ * motion.segment<2>(3 * i + 1);
                impulses[3 * i] = push;
                impulses.segment<2>(3 * i + 1) =
                    c.slips ? Vector2(-c.friction * push * c.along) : in_disc(drag, c.friction * push);
            }
        }
    }

    /// One step of Newton's method.
    void leap(Column& impulses) const {
        Column const motion = p_.motion + p_.mobility * impulses;
        Table slope = Table::Identity(3 * n_, 3 * n_);
        Column residual = impulses;
        for (Index i = 0; i < n_; ++i) contact_equations(i, impulses, motion, slope, residual);
        impulses -= least_norm(slope, residual, 1e-13L);
    }

private:
    [[nodiscard]] static Vector2 in_disc(Vector2 const& v, Real radius) {
        Real const length = v.norm();
        return length <= radius ? v : Vector2(v * (radius / length));
    }

    void contact_equations(Index i, Column const& impulses, Column const& motion, Table& slope,
                           Column& residual) const {
        auto const& c = contact(p_, i);
        Index const at = 3 * i, width = 3 * n_;
        Eigen::Matrix<Real, 1, Eigen::Dynamic> ahead = Table::Zero(1, width);
        Real const tried = impulses[at] - steps_[at] * (motion[at] - c.least), push = std::max(Real(0), tried);
        if (tried > 0) ahead = -steps_[at] * p_.mobility.row(at), ahead[at] += 1;
        residual[at] -= push;
        slope.row(at) -= ahead;
        Table across = Table::Zero(2, width);
        if (c.slips) {
            residual.segment<2>(at + 1) += c.friction * impulses[at] * c.along;
            across.col(at) = -c.friction * c.along;
        } else {
            Vector2 const pull = impulses.segment<2>(at + 1) - steps_[at + 1] * motion.segment<2>(at + 1);
            Table of_pull = -steps_[at + 1] * p_.mobility.middleRows(at + 1, 2);
            of_pull(0, at + 1) += 1, of_pull(1, at + 2) += 1;
            Real const radius = c.friction * push, length = pull.norm();
            residual.segment<2>(at + 1) -= in_disc(pull, radius);
            if (length <= radius)
                across = of_pull;
            else {
                Vector2 const unit = pull / length;
                across = radius / length * (of_pull - unit * (unit.transpose() * of_pull)) + c.friction * unit * ahead;
            }
        }
        slope.middleRows(at + 1, 2) -= across;
    }

    CoulombProblem const& p_;
    Index n_;
    Column steps_;
    Real slow_ = 0;
};

[[nodiscard]] Column by_projections(CoulombProblem const& p) {
    Projections const equations(p);
    Column sure = Column::Zero(3 * count(p)), best = sure;
    Real least = violation(p, best);
    for (int rounds = 50; rounds < 20'000 && least > rounding; rounds *= 2) {
        equations.walk(sure, rounds);
        Column impulses = sure;
        for (int i = 0; i < 30 && least > rounding / 1000; ++i) {
            equations.leap(impulses);
            Real const breaks = violation(p, impulses);
            if (breaks < least) least = breaks, best = impulses;
        }
    }
    return best;
}

}  // namespace

long double violation(CoulombProblem const& p, CoulombProblem::Column const& impulses) {
    Column const motion = p.motion + p.mobility * impulses;
    Real worst = 0;
    for (Index i = 0; i < count(p); ++i) {
        auto const& c = contact(p, i);
        Real const of_push = p.mobility(3 * i, 3 * i),
                   of_drag = (p.mobility(3 * i + 1, 3 * i + 1) + p.mobility(3 * i + 2, 3 * i + 2)) / 2;
        Real const push = impulses[3 * i] * of_push, rate = motion[3 * i] - c.least;
        worst = std::max(worst, std::abs(std::min(push, rate)));
        Vector2 const drag = impulses.segment<2>(3 * i + 1) * of_drag, slip = motion.segment<2>(3 * i + 1);
        Real const bound = c.friction * impulses[3 * i] * of_drag;
        if (c.slips)
            worst = std::max(worst, (drag + bound * c.along).norm());
        else {
            // Coulomb's law: drag is the point of the disc that is nearest to drag − slip.
            Vector2 const pull = drag - slip;
            Real const length = pull.norm(), radius = std::max(Real(0), bound);
            worst = std::max(worst, (drag - (length <= radius ? pull : Vector2(pull * (radius / length)))).norm());
        }
        if (!std::isfinite(push) || !std::isfinite(drag.norm())) return std::numeric_limits<Real>::infinity();
    }
    return worst / largest_motion(p);
}

CoulombSolution solve(CoulombProblem const& p) {
    CoulombSolution s;
    bool const normal_alone = std::ranges::all_of(p.contacts, [](auto const& c) { return c.friction == 0 || c.slips; });
    s.impulses = normal_alone && count(p) <= 12 ? by_enumeration(p) : by_projections(p);
    s.after = p.motion + p.mobility * s.impulses;
    s.violation = violation(p, s.impulses);
    s.solved = s.violation < rounding;
    return s;
}

}  // namespace oracle::detail
