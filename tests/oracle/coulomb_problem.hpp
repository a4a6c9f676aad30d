// Impulses (or forces) of several contacts at once: Newton's restitution, or what holds lasting contact, with Coulomb's friction in a plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oracle::detail {

/// γ⁺ = motion + mobility Λ with the numbers (normal, tangent 1, tangent 2) of each contact.
struct CoulombProblem {
    using Real = long double;
    using Table = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
    using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

    struct Contact {
        Real least = 0;      // γ_N⁺ is this or more, and N ≥ 0, and one of the two an equation
        Real friction = 0;   // |T| ≤ friction N, and T against γ_T⁺ where that is not zero
        bool slips = false;  // T = −friction N along
        Eigen::Matrix<Real, 2, 1> along = Eigen::Matrix<Real, 2, 1>::Zero();
    };

    Table mobility;
    Column motion;
    std::vector<Contact> contacts;
};

struct CoulombSolution {
    CoulombProblem::Column impulses, after;  // Λ and γ⁺
    bool solved = false;                     // the conditions hold to rounding
    long double violation = 0;               // of the conditions, over the largest motion
};

CoulombSolution solve(CoulombProblem const& problem);

/// Largest violation of the conditions by impulses, in units of motion, over the largest motion.
long double violation(CoulombProblem const& problem, CoulombProblem::Column const& impulses);

}  // namespace oracle::detail
