// The structural Jacobian of the slider-crank against differences of the contacts' part of its derivative.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>

#include "kernels/mechanisms/list.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "tests/oracle/golden_table.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/compiled_laws.hpp"

namespace slideway::joint_stiffness_test {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Contacts without force: what is left of the derivative is not the joint's.
struct Forceless {
    template <class Real>
    static FaceNormals<Real> normals(FaceMotion<Real> const&, FaceContact<Real> const&, ContactParameters<Real> const&) {
        return {{Real(0.0), Real(0.0), Real(0.0), Real(0.0)}, mask_of<Real>(false)};
    }
    static bool of_touching_alone() { return true; }
    static constexpr bool continuous() { return false; }
};

/// The slider-crank of a case, with and without its contacts' forces.
class Contacts {
public:
    Contacts(oracle::Case const& c, SliderParameters<double> const& p)
        : c_(c), p_(p), block_(testing::conditions_of<double>(c.parts)), forceless_({}, block_.switches, c.parts) {
        start_memory(memory_);
        for (int face = 0; face < face_count; ++face) {
            auto const speed = [&](int k) {
                return c.impact_speeds[static_cast<std::size_t>((face < 2 ? 0 : 8) + face_apex(face, k))];
            };
            memory_.impact_speed[face] = {speed(0), speed(1), speed(2), speed(3)};
        }
        forceless_.friction = false;  // without forces there is none
    }

    [[nodiscard]] SliderLinearisation<double> linearised() const {
        SliderLinearisation<double> at;
        SliderCrank::linearise(c_.t, c_.state.data(), p_, memory_, block_, at);
        return at;
    }
    void rates(oracle::State const& state, double (&rates)[10]) const {
        SliderCrank::derivative<false, double>(c_.t, state.data(), p_, memory_, block_, rates, nullptr);
    }
    void rates_without_force(oracle::State const& state, double (&rates)[10]) const {
        SliderCrank::derivative<false, double>(c_.t, state.data(), p_, memory_, forceless_, rates, nullptr);
    }

private:
    oracle::Case const& c_;
    SliderParameters<double> const& p_;
    Conditions<LawFunctions<double>> block_;
    Conditions<Forceless> forceless_;
    ContactMemory<double> memory_;
};

/// One case: the state, its model and what the differences need.
class Linearised {
public:
    explicit Linearised(oracle::Case const& c)
        : c_(c), p_(slider_parameters(c.inputs)), contacts_(c, p_), at_(contacts_.linearised()) {
        mass_.setZero();
        mass_(0, 0) = at_.mass_y, mass_(1, 1) = at_.mass_z, mass_(0, 1) = mass_(1, 0) = at_.mass_yz;
        mass_(2, 2) = at_.inertia.x, mass_(3, 3) = at_.inertia.y, mass_(4, 4) = at_.inertia.z;
    }

    [[nodiscard]] Matrix5 by_place() const { return matrix(at_.joint.by_place); }
    [[nodiscard]] Matrix5 by_rate() const { return matrix(at_.joint.by_rate); }
    [[nodiscard]] double touching() const { return at_.touching; }

    /// M (ν'(state) − ν' without contact forces): the generalized force of the contacts.
    [[nodiscard]] Vector5 contact_force(oracle::State const& state) const {
        double with[10], without[10];
        contacts_.rates(state, with);
        contacts_.rates_without_force(state, without);
        Vector5 a;
        for (int i : {0, 1, 2, 3, 4}) a(i) = with[place(i)] - without[place(i)];
        // The forces see the pose's own κ; it hardly changes over a difference.
        return mass_ * a;
    }

    /// The state moved by ∫ν = step along direction j: q += G e_j step.
    [[nodiscard]] oracle::State moved(int j, double step) const {
        auto s = c_.state;
        double const sr = std::sin(s[4]), cr = std::cos(s[4]), ty = std::tan(s[5]), cy = std::cos(s[5]);
        if (j < 2) s[static_cast<std::size_t>(j)] += step;
        if (j == 2) s[4] += step;
        if (j == 3) s[4] += step * sr * ty, s[5] += step * cr, s[6] += step * sr / cy;
        if (j == 4) s[4] += step * cr * ty, s[5] -= step * sr, s[6] += step * cr / cy;
        return s;
    }
    [[nodiscard]] oracle::State pushed(int j, double step) const {
        auto s = c_.state;
        s[place(j)] += step;
        return s;
    }

private:
    static std::size_t place(int i) { return static_cast<std::size_t>(i < 2 ? i + 2 : i + 5); }
    static Matrix5 matrix(double const (&m)[5][5]) {
        Matrix5 r;
        for (int i = 0; i < 5; ++i) {
            for (int j = 0; j < 5; ++j) r(i, j) = m[i][j];
        }
        return r;
    }

    oracle::Case const& c_;
    SliderParameters<double> p_;
    Contacts contacts_;
    SliderLinearisation<double> at_;
    Matrix5 mass_;
};

/// Turns rotations into displacements at the apices, so that all entries are N/m (or N s/m).
Matrix5 in_lengths(Matrix5 m, double lever) {
    for (int i = 2; i < 5; ++i) m.row(i) /= lever, m.col(i) /= lever;
    return m;
}

constexpr double rate_step = 1e-7;  // [m/s]
constexpr double rounding = 2e-15;  // of a generalized force, against the normal loads and 1 N

/// Both sides of a difference are as far apart as a twentieth of what is measured.
bool is_bent(double bend, double slope, double noise) { return bend > 0.05 * slope + 4 * noise; }

void compare(oracle::Case const& c, std::string const& what, int& compared, int& bent) {
    oracle::Result const r = oracle::evaluate(c.inputs, c.parts, c.t, c.state, &c.impact_speeds);
    if (r.geometry || r.contact_domain) return;
    double nearest = 1;
    for (auto const* depths : {&r.pen_y, &r.pen_z}) {
        for (double const d : *depths) nearest = std::min(nearest, std::abs(d));
    }
    Linearised const at(c);
    if (at.touching() == 0) return;
    double const lever = 0.5 * c.inputs.slider_length;
    double const step = 1e-3 * nearest;  // crosses no contact's border
    Matrix5 const k = at.by_place(), d = at.by_rate();
    Matrix5 k_difference, d_difference, k_bend, d_bend;
    Vector5 const here = at.contact_force(c.state);
    for (int j = 0; j < 5; ++j) {
        double const unit = j < 2 ? 1 : 1 / lever;
        double const h = step * unit;
        Vector5 const up = at.contact_force(at.moved(j, h)), down = at.contact_force(at.moved(j, -h));
        k_difference.col(j) = (up - down) / (2 * h);
        k_bend.col(j) = (up - 2 * here + down) / h;
        double const dv = rate_step * unit;
        Vector5 const faster = at.contact_force(at.pushed(j, dv)), slower = at.contact_force(at.pushed(j, -dv));
        d_difference.col(j) = (faster - slower) / (2 * dv);
        d_bend.col(j) = (faster - 2 * here + slower) / dv;
    }
    double load = 0;
    for (auto const* forces : {&r.fn_y, &r.fn_z}) load = std::accumulate(forces->begin(), forces->end(), load);
    auto const largest = [&](Matrix5 const& m) { return in_lengths(m, lever).cwiseAbs().maxCoeff(); };
    // Left out: the turning of the forces with the pose, load/lever, and of slips and rates, D · speed/lever.
    auto const& s = c.state;
    double const spin = std::hypot(s[7], s[8], s[9]);
    double const speed = std::hypot(std::hypot(r.vx, s[2], s[3]), lever * spin);
    double const turning = (load + largest(d) * speed) / lever;
    // A penetration is good to about 1e-18 m.
    double const noise = 1e-18 / step * largest(k) + rounding * (load + 1) / step;
    // Where a contact begins or ceases to pull within a difference, the two sides of it differ by a part of what they are.
    if (is_bent(largest(k_bend), largest(k), noise) || is_bent(largest(d_bend), largest(d), rounding * (load + 1) / rate_step)) {
        ++bent;
        return;
    }
    EXPECT_LE(largest(k - k_difference), 2e-5 * largest(k) + 4 * turning + noise) << what;
    EXPECT_LE(largest(d - d_difference), 1e-5 * largest(d) + rounding * (load + 1) / rate_step) << what;
    ++compared;
}

// The differences hold what the structure leaves out, the turning of normals, arms and slips with the pose.  It grows with the
// loads, not with the stiffness: at rest it is 1e-7 of it.  By rates nothing is left out.
TEST(JointStiffness, IsTheDerivativeOfTheContactForces) {
    int compared = 0, bent = 0;
    auto const cases = oracle::make_cases(11, 2400);
    for (std::size_t i = 0; i < cases.size(); ++i) compare(cases[i], "case " + std::to_string(i), compared, bent);
    EXPECT_GT(compared, 1500);
    EXPECT_EQ(bent, 0);
}

TEST(JointStiffness, IsTheDerivativeOfTheContactForcesOfEveryLaw) {
    for (Law const law : oracle::every_law()) {
        int compared = 0, bent = 0;
        auto const cases = oracle::make_cases(11, 2400, Mechanism::slider_crank, law);
        for (std::size_t i = 0; i < cases.size(); ++i)
            compare(cases[i], oracle::name_of(law) + ", case " + std::to_string(i), compared, bent);
        EXPECT_GT(compared, 1500) << oracle::name_of(law);
        EXPECT_LT(bent, 10) << oracle::name_of(law);
    }
}

TEST(JointStiffness, IsTheDerivativeOfTheContactForcesOnTheGoldenStates) {
    int compared = 0, bent = 0;
    for (auto const* name : {"rhs_paper.csv", "rhs_conservative.csv", "rhs_parameters.csv", "rhs_kelvin_voigt.csv", "rhs_kelvin_voigt_parameters.csv",
                             "rhs_foundation.csv", "rhs_foundation_parameters.csv"}) {
        auto const table = golden::Table::read(std::filesystem::path(SLIDEWAY_TEST_DATA) / "golden" / name);
        for (std::size_t row = 0; row < table.rows(); ++row) {
            auto const g = golden::case_of(table, row);
            oracle::Case c{g.inputs, g.parts, g.t, g.state, {}};
            c.impact_speeds.fill(least_impact_speed);
            compare(c, std::string(name) + " row " + std::to_string(row), compared, bent);
        }
    }
    EXPECT_GT(compared, 50);
    EXPECT_EQ(bent, 0);
}

}  // namespace
}  // namespace slideway::joint_stiffness_test
