#pragma once

#include "kernels/block.hpp"
#include "kernels/joint/contact_totals.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/mechanisms/mechanism_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What touches in the joints of a linkage: pairs as the plan counts them.
template <class Real> struct LinkageContact : ContactTotals<Real> {
    static constexpr int quads = LinkagePlan::most_pairs / 4;
    Quad<Real> penetration[quads];   // [m]
    Quad<Real> rate[quads];          // [m/s]
    Quad<Real> normal_force[quads];  // [N]
    // Of each closure: the journal's place in its bearing along the ground's axes [m], or a block's across its walls [m] and its tilt [rad]; and its force.
    Vec2<Real> offset[LinkagePlan::most_closures];
    Real force[LinkagePlan::most_closures];

    /// What a pair has of the quads.
    template <class Quads> SLIDEWAY_FN static auto& at(Quads& of, int pair) {
        auto& quad = of[pair / 4];
        return pair % 4 == 0 ? quad.a : pair % 4 == 1 ? quad.b : pair % 4 == 2 ? quad.c : quad.d;
    }

    /// Nothing touches.
    SLIDEWAY_FN void start() {
        Real const zero(0.0), apart(-1.0);
        for (int i = 0; i < quads; ++i) {
            penetration[i] = {apart, apart, apart, apart};
            rate[i] = normal_force[i] = {zero, zero, zero, zero};
        }
        for (int i = 0; i < LinkagePlan::most_closures; ++i) offset[i] = {zero, zero}, force[i] = zero;
        this->clear_totals();
    }
    SLIDEWAY_FN Real deepest() const {
        Real depth = largest(penetration[0]);
        for (int i = 1; i < quads; ++i) depth = max(depth, largest(penetration[i]));
        return depth;
    }
    SLIDEWAY_FN Real total_force() const {
        Real force = sum(normal_force[0]);
        for (int i = 1; i < quads; ++i) force = force + sum(normal_force[i]);
        return force;
    }
    /// Of a closure: observers keep the forces of closures where those of sliders have their apices'.
    SLIDEWAY_FN Real apex_force(int closure) const { return force[closure]; }
    /// Nothing switches.
    SLIDEWAY_FN Real pattern() const { return Real(0.0); }

    /// Pairs of one lane, in the places of as many apices.
    SLIDEWAY_HD void put(int index, ProbeResult& result) const {
        for (int i = 0; i < LinkagePlan::most_pairs; ++i) {
            result.penetration_y[i] = lane(at(penetration, i), index);
            result.normal_force_y[i] = lane(at(normal_force, i), index);
            result.penetration_z[i] = result.normal_force_z[i] = not_a_number;
        }
    }
};

/// Columns of a sample of a linkage: the state, then these, then three of each closure: where its journal or block is, and the force; then two of each load:
/// its force or torque, and what a spring or stop stores or else the power of the load.
enum class LinkageSeries {
    drive_torque = LinkagePlan::most_states,
    normal_force,
    first_of_closures,
    first_of_loads = first_of_closures + 3 * LinkagePlan::most_closures,
    count = first_of_loads + 2 * LinkagePlan::most_loads,
};
inline constexpr int linkage_series_count = static_cast<int>(LinkageSeries::count);
static_assert(linkage_series_count <= selection_bits && quantity_count + LinkagePlan::most_loads <= selection_bits);

/// All that a state of a linkage tells beside its derivative.
template <class Real> struct LinkageReport : MechanismReport<Real> {
    static constexpr int apices = LinkagePlan::most_closures;  // as many forces are kept
    LinkageContact<Real> contact;
    /// Of a spring its tension and of a stop its push, or the torque of either, and what they store; of another load its power; and of each the power of what
    /// it does to the bodies.
    struct Told { Real force, shown, power; };
    Told load[LinkagePlan::most_loads];

    /// Nothing touches, and nothing acts.
    SLIDEWAY_FN void start() {
        Real const zero(0.0);
        contact.start();
        this->load_power = this->spring_loss = this->spring_potential = zero;
        for (auto& one : load) one = {zero, zero, zero};
    }

    /// No angle is small by nature.
    SLIDEWAY_FN static Real tilt(Real const*, int) { return Real(0.0); }

    /// Value of a column beyond the state.
    SLIDEWAY_FN Real series_value(int column) const {
        if (column == static_cast<int>(LinkageSeries::drive_torque)) return this->drive_torque;
        if (column == static_cast<int>(LinkageSeries::normal_force)) return contact.total_force();
        if (column >= static_cast<int>(LinkageSeries::first_of_loads)) {
            int const of_loads = column - static_cast<int>(LinkageSeries::first_of_loads);
            Told const& one = load[of_loads / 2];
            return of_loads % 2 == 0 ? one.force : one.shown;
        }
        int const of_closures = column - static_cast<int>(LinkageSeries::first_of_closures), closure = of_closures / 3;
        if (of_closures % 3 == 2) return contact.force[closure];
        return of_closures % 3 == 0 ? contact.offset[closure].x : contact.offset[closure].y;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
