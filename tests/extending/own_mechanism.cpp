// A mechanism of one's own, outside the tree: a slider that a cam drives along its way.
#include <cmath>
#include <cstdio>

#include "kernels/integrate.hpp"
#include "kernels/laws/kelvin_voigt.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/drive.hpp"
#include "kernels/mechanisms/mechanism_info.hpp"
#include "kernels/mechanisms/spatial_slider.hpp"
#include "kernels/models/mechanism_model.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A cam on a shaft of constant speed: x = r (cos θ + ⅛ cos 2θ), θ = θ0 + ω t.
struct TwoHarmonicsDrive : DrivenGuide<TwoHarmonicsDrive> {
    using Base = DrivenBase;
    static constexpr bool is_free = false;
    static constexpr MechanismInfo info = [] {
        auto info = spatial_slider_info();
        info.name = "two_harmonics";
        info.meaning = "slider moved along the way by a cam of two harmonics";
        info.keys |= groups_of(KeyGroup::crank);
        info.drive = DriveKind::crank;
        return info;
    }();

    template <class Real>
    SLIDEWAY_FN static AlongWay<Real> motion(Real t, Real const*, SliderParameters<Real> const& p) {
        Real const angle = fma(p.crank_speed, t, p.start_angle);
        auto const first = sincos(angle), second = sincos(angle + angle);
        Real const radius = p.crank_length, speed = radius * p.crank_speed, eighth(0.125);
        return {radius * fma(eighth, second.cos, first.cos), negated(speed) * fma(Real(0.25), second.sin, first.sin),
                negated(speed * p.crank_speed) * fma(Real(0.5), second.cos, first.cos)};
    }
};

using TwoHarmonics = SpatialSlider<TwoHarmonicsDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA

namespace {

using namespace slideway;

Inputs standard_inputs() {
    Inputs in;
    in.crank_length = 0.05;
    in.crank_speed = 20;
    in.start_angle = 0.3;
    in.slider_mass = 0.1872;
    in.slider_inertia_x = 2.028e-5;
    in.slider_inertia_y = 3.9e-5;
    in.slider_inertia_z = 3.12e-5;
    in.thickness_y = in.way_width;
    in.thickness_z = in.way_depth;
    in.law_a = 1e7;  // contact.apex_stiffness
    return in;
}

constexpr std::size_t samples = 33;

/// One member from its start to `end` [s].
struct Run {
    MemberRecord record;
    double state[TwoHarmonics::size], quantities[quantity_columns];
    double times[samples], series[3][samples];  // x, vx, ax

    Run(Inputs const& in, bool friction, double end) {
        using Laws = OneLaw<KelvinVoigt, PointDamping>;
        using Model = MechanismModel<TwoHarmonics, SliderBase, Laws>;
        for (std::size_t i = 0; i < samples; ++i) times[i] = end * static_cast<double>(i) / (samples - 1);
        Block block;
        block.members = 1;
        block.inputs = &in;
        block.settings = {.rtol = 1e-9, .atol = 1e-9, .end_time = end};
        block.quantities = selections::of({Quantity::energy_residual, Quantity::crank_work, Quantity::friction_loss});
        block.series = selections::of({Series::x, Series::vx, Series::ax});
        block.sample_times = times;
        block.samples = samples;
        block.records = &record;
        block.final_states = state;
        block.quantity_values = quantities;
        block.series_values = series[0];
        Parts parts;
        parts.friction = friction;
        integrate<Model, double>(block, Model{Conditions<Laws>{{}, KelvinVoigt::info.switches, parts}});
    }
    double operator[](Quantity q) const { return quantities[quantity_column(q)]; }
};

/// Without weight the slider stays in the middle: kinematics and the drive's work are those of a point.
bool moves_as_the_cam() {
    auto in = standard_inputs();
    in.gravity = 0;
    double const end = 0.2, r = in.crank_length, w = in.crank_speed;
    Run const run(in, false, end);
    double worst = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        double const a = in.start_angle + w * run.times[i];
        worst = std::fmax(worst, std::fabs(run.series[0][i] / r - (std::cos(a) + std::cos(2 * a) / 8)));
        worst = std::fmax(worst, std::fabs(run.series[1][i] / (r * w) + std::sin(a) + std::sin(2 * a) / 4));
        worst = std::fmax(worst, std::fabs(run.series[2][i] / (r * w * w) + std::cos(a) + std::cos(2 * a) / 2));
    }
    auto const kinetic = [&](double a) { return 0.5 * in.slider_mass * std::pow(r * w * (std::sin(a) + std::sin(2 * a) / 4), 2); };
    double const work = kinetic(in.start_angle + w * end) - kinetic(in.start_angle);
    std::printf("weightless: kinematics %s 1e-12; the drive's work %.9f J, in closed form %.9f J\n",
                worst < 1e-12 ? "within" : "beyond", run[Quantity::crank_work], work);
    return run.record.status == Status::finished && worst < 1e-12 && std::fabs(run[Quantity::crank_work] - work) < 1e-9;
}

bool balances_its_energy() {
    auto in = standard_inputs();
    in.y = -1e-4;
    Run const run(in, true, 0.05);
    bool const balanced = std::fabs(run[Quantity::energy_residual]) < 1e-9;
    std::printf("on its way: friction took %.1e J of the drive's %.1e J; energy residual %s 1e-9 J\n",
                run[Quantity::friction_loss], run[Quantity::crank_work], balanced ? "below" : "above");
    return run.record.status == Status::finished && run[Quantity::friction_loss] > 1e-3 && balanced;
}

}  // namespace

int main() { return moves_as_the_cam() && balances_its_energy() ? 0 : 1; }
