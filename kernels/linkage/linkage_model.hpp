#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/lanes/model.hpp"
#include "kernels/linkage/block.hpp"
#include "kernels/linkage/journal.hpp"
#include "kernels/linkage/linkage_loads.hpp"
#include "kernels/linkage/linkage_motion.hpp"
#include "kernels/linkage/linkage_observer.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_plans.hpp"
#include "kernels/linkage/linkage_report.hpp"
#include "kernels/linkage/linkage_start.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/models/mechanism_model.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Points have one force law, which does not switch and begins at 0.
struct LawOfPoints {
    SLIDEWAY_HD static constexpr bool ends_steps() { return false; }
    SLIDEWAY_HD static constexpr bool continuous() { return true; }
};

/// A linkage as the lanes integrate it: its plan is the same for all members of a block.
/// @tparam Plan PlanTable or a PlanConstant
template <class Plan> struct LinkageModel : ContactLanes<LinkageModel<Plan>>, ConditionsOfBlock<LawOfPoints> {
    using Inputs = slideway::Inputs;
    static constexpr int size = 2 * Plan::most_coordinates, series = linkage_series_count;
    static constexpr int crank_state[] = {0, 1};
    static constexpr bool has_patterns = false, has_linearisation = false;
    template <class Real> using Parameters = LinkageParameters<Real>;
    template <class Real> using Report = LinkageReport<Real>;
    template <class Real> using Observer = LinkageObserver<Real>;
    template <class Real> using Memory = ContactMemory<Real, LinkageContact<Real>::quads>;
    template <class Real> using Watch = ContactWatch<Real, LinkageContact<Real>::quads>;
    template <class Real> using Accelerations = NoRecord<Keeper::accelerations>;

    template <class Real> using Motion = LinkageMotion<Plan, Real>;

    Plan plan;

    explicit constexpr LinkageModel(Parts const& parts) : ConditionsOfBlock<LawOfPoints>{{}, {{}, false, parts}}, plan(*parts.linkage) {}

    SLIDEWAY_HD int states() const { return plan->states(); }
    SLIDEWAY_HD int state_of_series(int column) const { return column < plan->states() ? column : -1; }
    SLIDEWAY_HD bool is_driven() const { return plan.is_given(this->block.drive); }
    SLIDEWAY_HD unsigned prescribed() const { return is_driven() ? 0b11u : 0u; }
    SLIDEWAY_HD LinkageParameters<double> parameters(Inputs const& in) const {
        auto p = linkage_parameters(*plan, in);
        put_linkage_loads(this->block.loads, in, p);
        return p;
    }
    SLIDEWAY_HD void initial_state(Inputs const& in, double* state) const {
        put_linkage_start(*plan, in, state);
    }
    SLIDEWAY_HD void scales(LinkageParameters<double> const& p, double* scale) const {
        for (int c = 0; c < plan->coordinates; ++c) {
            scale[2 * c] = plan->is_angle(c) ? p.play / p.body[plan->owner[c]].reach : p.play;
            scale[2 * c + 1] = scale[2 * c] * p.rate_scale;
        }
    }
    /// Between the energy of a motion within the clearance and that of the bodies: most of that is of motions as large as they [J].
    template <class Real> SLIDEWAY_FN static Real energy_scale(LinkageParameters<Real> const& p) {
        return p.mass * ((p.play * p.reach) * (p.rate_scale * p.rate_scale));
    }
    template <class Real> SLIDEWAY_FN static Real touch_speed(LinkageParameters<Real> const& p) { return p.play * p.rate_scale; }
    template <class Real> SLIDEWAY_FN static Real touch_scale(LinkageParameters<Real> const& p) { return p.play; }
    template <class Real> SLIDEWAY_FN static Real touch_rounding(LinkageParameters<Real> const& p) { return Real(2e-15) * p.reach; }

    /// Time derivative of the state.  @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE Faults<Real> derivative(Real t, Real const* s, LinkageParameters<Real> const& p,
                                              ContactMemory<Real, LinkageContact<Real>::quads> const& memory, Real* rates, LinkageReport<Real>* report) const {
        bool const driven = is_driven();
        auto const crank = crank_of(t, s, p);
        Motion<Real> motion(plan, p, s, driven, crank);
        LinkageContact<Real>* told = nullptr;
        if constexpr (Full) told = &report->contact, report->start();
        push(motion, memory, told);
        Real const time = t + p.start_time;
        if (plan.is_loaded(this->block.loads)) {
            LinkageReport<Real>* of_loads = nullptr;
            if constexpr (Full) of_loads = report;
            LinkageLoads<Motion<Real>>(motion, of_loads).push(this->block.loads, {crank.place, time, Real(0.0), Real(0.0), crank.velocity});
        }
        Real motor(0.0);
        if (plan->is_driven && !driven) {
            motor = motor_torque(this->block.drive, p.motor, time, crank.place, crank.velocity);
            motion.turn(0, motor);
        }
        motion.gather();
        auto faults = Faults<Real>::none();
        faults.geometry = motion.close_loops();
        Real acceleration[Plan::most_coordinates];
        motion.accelerate(acceleration);
        plan.up(plan->coordinates, [&](int c) SLIDEWAY_INLINED {
            rates[2 * c] = motion.rate(c);
            rates[2 * c + 1] = acceleration[c];
        });
        if (driven) rates[1] = crank.acceleration;
        if constexpr (Full) tell(motion, acceleration, driven, crank, motor, *report);
        return faults;
    }

    /// Takes back what steps leave loops open by.
    template <class Real>
    SLIDEWAY_NOINLINE void project(Mask<Real> in, Real t, Real* s, LinkageParameters<Real> const& p) const {
        if (plan->loops() == 0) return;
        Motion<Real> motion(plan, p, s, is_driven(), crank_of(t, s, p));
        motion.gather();
        auto const singular = motion.close_loops();
        motion.project(in & !singular, s);
    }

    /// Gap of a pair: its penetration negated [m].
    template <class Real> SLIDEWAY_FN Real gap(Real t, Real const* s, LinkageParameters<Real> const& p, bool, int pair) const {
        Motion<Real> const motion(plan, p, s, is_driven(), crank_of(t, s, p));
        Real depth(-1.0);
        plan.up(plan->closures, [&](int k) SLIDEWAY_INLINED {
            LinkageClosure const& of = plan->closure[k];
            int const own = pair - of.pair;
            if (own < 0 || own >= of.pairs()) return;
            if (of.kind == ClosureKind::journal) {
                depth = Journal<Motion<Real>>(motion, k).depth;
            } else {
                auto const corners = BlockInWalls<Motion<Real>>(motion, k).corners.depth;
                depth = own == 0 ? corners.a : own == 1 ? corners.b : own == 2 ? corners.c : corners.d;
            }
        });
        return negated(depth);
    }

private:
    /// Coordinate 0, as a drive gives it or as it is.
    template <class Real> SLIDEWAY_FN GivenMotion<Real> crank_of(Real t, Real const* s, LinkageParameters<Real> const& p) const {
        return plan->is_driven ? given_crank(this->block.drive, t, s[0], s[1], p) : GivenMotion<Real>{s[0], s[1], Real(0.0)};
    }

    template <class Real, class Memory>
    SLIDEWAY_FN void push(Motion<Real>& motion, Memory const& memory, LinkageContact<Real>* told) const {
        using Contact = LinkageContact<Real>;
        plan.up(plan->closures, [&](int k) SLIDEWAY_INLINED {
            LinkageClosure const& of = plan->closure[k];
            if (of.kind == ClosureKind::journal) {
                Journal<Motion<Real>> const journal(motion, k);
                if (told != nullptr) {
                    Contact::at(told->penetration, of.pair) = journal.depth;
                    Contact::at(told->rate, of.pair) = journal.rate;
                    told->offset[k] = journal.distance * journal.outward;
                }
                if (none(journal.depth > Real(0.0))) return motion.require(k, journal.depth);
                journal.push(motion, Contact::at(memory.impact_speed, of.pair), this->block.remembers, this->block.friction, told);
            } else if (of.kind == ClosureKind::block) {
                BlockInWalls<Motion<Real>> const block(motion, k);
                if (told != nullptr) {
                    told->penetration[of.pair / 4] = block.corners.depth;
                    told->rate[of.pair / 4] = block.corners.rate;
                    told->offset[k] = {block.pose.place.y, block.pose.tilt};
                }
                if (none(block.corners.deepest() > Real(0.0))) return motion.require(k, block.corners.push_of_nothing().torque);
                block.push(motion, memory.impact_speed[of.pair / 4], this->block.remembers, this->block.friction, told);
            }
        });
    }

    template <class Real>
    SLIDEWAY_FN void tell(Motion<Real> const& motion, Real const* acceleration, bool driven, GivenMotion<Real> const& crank, Real motor,
                          LinkageReport<Real>& report) const {
        Real const zero(0.0);
        report.x = report.vx = report.top = report.front = report.position_error = report.rod_spin = zero;
        report.acceleration = {zero, zero, zero};
        report.drive_torque = report.crank_torque = driven ? motion.drive_torque(acceleration) : motor;
        report.crank_power = report.drive_torque * crank.velocity;
        report.energy = motion.energy() + (report.contact.potential + report.spring_potential);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
