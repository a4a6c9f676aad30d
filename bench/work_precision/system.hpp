// The right-hand sides as the peers take them: one trajectory, plain arrays.  Included by one unit alone, which is built with
// the flags of the scalar kernels and an ISA namespace of its own, so that the peers' code and the kernels' optimise together.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "bench/work_precision/method.hpp"
#include "kernels/laws/conservative.hpp"
#include "kernels/laws/foundation.hpp"
#include "kernels/laws/kelvin_voigt.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/mechanisms/free_slider.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/mechanisms/slider_crank.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One member of an ensemble of sliders.
template <class Mechanism, class Law, class Damping, bool friction, bool misaligned_way = false> class SliderSystem {
public:
    using Model = Mechanism;
    static constexpr int size = Model::size;
    static constexpr int audits = 3;  // W, D_f, D_d

    explicit SliderSystem(Inputs const& inputs) : p_(Model::parameters(inputs)) {
        Model::initial_state(inputs, start.data());
        Model::scales(p_, scale.data());
        std::fill(scale.begin() + size, scale.end(), Model::energy_scale(p_));
        start_memory(memory_);
    }

    void rates(double t, double const* x, double* dxdt) const {
        ++evaluations;
        Model::template derivative<false>(t, x, p_, memory_, block_, dxdt, &report_);
    }
    /// The derivative and behind it the powers of the audit.
    void audited_rates(double t, double const* x, double* dxdt) const {
        ++evaluations;
        Model::template derivative<true>(t, x, p_, memory_, block_, dxdt, &report_);
        store_powers(dxdt + size);
    }
    void powers(double t, double const* x, double* power) const {
        double unused[size];
        ++evaluations;
        Model::template derivative<true>(t, x, p_, memory_, block_, unused, &report_);
        store_powers(power);
    }
    double energy(double t, double const* x) const {
        double unused[size];
        Model::template derivative<true>(t, x, p_, memory_, block_, unused, &report_);
        return report_.energy;
    }

    std::array<double, size> start;
    std::array<double, size + audits> scale;  // what the absolute tolerance is relative to
    mutable std::uint64_t evaluations = 0;

private:
    void store_powers(double* power) const {
        power[0] = report_.crank_power;
        power[1] = report_.contact.friction_power;
        power[2] = report_.contact.damping_power;
    }

    SliderParameters<double> p_;
    Conditions<OneLaw<Law, Damping>> block_{{}, Law::info.switches, {.friction = friction, .misaligned_way = misaligned_way}};
    ContactMemory<double> memory_;
    mutable SliderReport<double> report_;
};

class LorenzSystem {
public:
    static constexpr int size = 3;
    static constexpr int audits = 0;

    explicit LorenzSystem(bench::LorenzMember const& member) : start(member.start), scale{1, 1, 1}, p_(member) {}

    void rates(double, double const* x, double* dxdt) const {
        ++evaluations;
        dxdt[0] = p_.sigma * (x[1] - x[0]);
        dxdt[1] = x[0] * (p_.rho - x[2]) - x[1];
        dxdt[2] = x[0] * x[1] - p_.beta * x[2];
    }

    std::array<double, size> start;
    std::array<double, size> scale;
    mutable std::uint64_t evaluations = 0;

private:
    bench::LorenzMember p_;
};

/// Calls `use` with the type of system that an ensemble's members are, and the members.
template <class Use> auto with_systems(bench::Ensemble const& ensemble, Use const& use) {
    struct Visitor {
        Use const& use;
        auto operator()(bench::SliderEnsemble const& e) const {
            if (e.parts == Parts{Law::paper, Damping::point, true}) {
                return use.template operator()<SliderSystem<SliderCrank, PaperLaw, PointDamping, true>>(e.members);
            }
            if (e.parts == Parts{Law::conservative, Damping::rate, true}) {
                return use.template operator()<SliderSystem<SliderCrank, ConservativeLaw, RateDamping, true>>(e.members);
            }
            if (e.parts == Parts{Law::conservative, Damping::rate, true, true}) {
                return use.template operator()<SliderSystem<SliderCrank, ConservativeLaw, RateDamping, true, true>>(e.members);
            }
            if (e.parts == Parts{Law::foundation, Damping::rate, true}) {
                return use.template operator()<SliderSystem<SliderCrank, Foundation, RateDamping, true>>(e.members);
            }
            if (e.parts == Parts{.law = Law::kelvin_voigt, .mechanism = Mechanism::free_slider}) {
                return use.template operator()<SliderSystem<FreeSlider, KelvinVoigt, PointDamping, false>>(e.members);
            }
            throw std::logic_error("the peers have no equations of these parts");
        }
        auto operator()(bench::LorenzEnsemble const& e) const {
            return use.template operator()<LorenzSystem>(e.members);
        }
        bench::Outcome operator()(bench::ValveEnsemble const&) const { return {}; }  // has events: see valve_peer.cpp
        bench::Outcome operator()(bench::BouncingEnsemble const&) const { return {}; }
    };
    return std::visit(Visitor{use}, ensemble);
}

}  // namespace slideway::inline SLIDEWAY_ISA
