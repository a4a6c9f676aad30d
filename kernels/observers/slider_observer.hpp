#pragma once

#include <initializer_list>

#include "kernels/block.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The scalar quantities of a pack of mechanisms with one slider.  Only the energy audit has a say in the steps:
/// its integrals meet the tolerance too.  Integrals run over the stages with the stepper's own weights, so they have its order; peaks, mode times and onsets go by
/// the accepted steps.
/// @tparam Report_ SliderReport or PlanarReport
template <class Real, template <class> class Report_ = SliderReport> class SliderObserver {
public:
    using Report = Report_<Real>;
    /// Integrands: crank, friction and damping power, total force, torque², error², rod spin², |crank power|, the apices' forces, and
    /// the springs' power, of which a law that switches keeps books.
    static constexpr int integrals = 8 + Report::apices + 1;
    static constexpr int columns = quantity_columns;  // of a member's row
    /// The first of them are the energy audit's.
    static constexpr int audit_integrals = 3;

    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) {
        for (auto const i :
             {Quantity::mean_normal_force, Quantity::mean_apex_force, Quantity::energy_residual, Quantity::crank_work,
              Quantity::friction_loss, Quantity::damping_loss, Quantity::rms_crank_torque, Quantity::rms_position_error,
              Quantity::rms_rod_angular_velocity}) {
            if (selects(q, i)) return true;
        }
        return false;
    }
    /// The quantities of the energy audit; any of them brings the whole of it along.
    static constexpr Selection audit_quantities =
        selection_of(Quantity::energy_residual) | selection_of(Quantity::crank_work) |
        selection_of(Quantity::friction_loss) | selection_of(Quantity::damping_loss);
    /// Whether the audit's integrals are asked for and must meet the tolerance themselves.
    SLIDEWAY_HD static constexpr bool audits(Selection q) { return (q & audit_quantities) != 0; }
    /// Whether a report is needed at the accepted steps.
    SLIDEWAY_HD static constexpr bool needs_reports(Selection q) { return q != 0; }

    SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        values[0] = r.crank_power;
        values[1] = r.contact.friction_power;
        values[2] = r.contact.damping_power;
        values[3] = r.contact.total_force();
        values[4] = r.drive_torque * r.drive_torque;
        values[5] = r.position_error * r.position_error;
        values[6] = r.rod_spin * r.rod_spin;
        values[7] = abs(r.crank_power);
        if constexpr (Report::apices > 0) {
            for (int apex = 0; apex < Report::apices; ++apex) values[8 + apex] = r.contact.apex_force(apex);
        }
        values[integrals - 1] = r.contact.elastic_power;
    }

    /// Begins the members in the lanes of the mask.
    /// @param switches of the law: it makes energy.  The same in all calls.
    SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r, Real const* state, bool switches) {
        Real const zero(0.0);
        for (auto* value : {&force_, &torque_, &error_, &spin_, &roll_, &yaw_, &pitch_, &onsets_, &largest_potential_,
                            &made_, &astray_, &exchanged_}) {
            *value = select(fresh, zero, *value);
        }
        for (auto& value : integral_) value = select(fresh, zero, value);
        for (auto& value : apex_) value = select(fresh, zero, value);
        for (auto& value : mode_time_) value = select(fresh, zero, value);
        start_energy_ = select(fresh, r.energy, start_energy_);
        resume(fresh, r, switches);
        mode_ = select(fresh, mode_class(r), mode_);
        take_peaks(fresh, r, state);
    }

    /// One accepted step of the lanes in the mask.  @param integral Σ b_s · integrand of the step's stages.
    SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Real const* integral, Report const& r, Real const* state,
                            bool switches) {
        Real const zero(0.0), half(0.5);
        for (int i = 0; i < integrals; ++i) {
            integral_[i] = select(accepted, fma(h, integral[i], integral_[i]), integral_[i]);
        }
        audit_step(accepted, h, integral, r, switches);
        resume(accepted, r, switches);
        Real const mode = mode_class(r);
        // A step between two modes is shared by halves; contact ends such steps within a small part of an impact.
        Real const share = select(accepted, half * h, zero);
        for (int i = 0; i < 4; ++i) {
            Real const number(static_cast<double>(i));
            mode_time_[i] = mode_time_[i] + select(mode_ == number, share, zero) + select(mode == number, share, zero);
        }
        auto const onset = accepted & (mode_ == zero) & (mode > zero);
        onsets_ = onsets_ + count<Real>(onset);
        mode_ = select(accepted, mode, mode_);
        take_peaks(accepted, r, state);
    }

    /// What the next step starts from, in the lanes of the mask; again where the law changes there without a step.
    SLIDEWAY_FN void resume(Mask<Real> in, Report const& r, bool switches) {
        energy_ = select(in, r.energy, energy_);
        potential_ = select(in, r.contact.potential, potential_);
        if (switches) pattern_ = select(in, r.contact.pattern(), pattern_);
    }

    /// Integral of an integrand up to the last accepted step.
    SLIDEWAY_FN Real integral(int i) const { return integral_[i]; }

    /// The energy audit up to the last accepted step, where it ran.
    SLIDEWAY_FN EnergyAudit<Real> audit() const {
        return {energy_ - start_energy_, integral_[0], integral_[1], integral_[2], integral_[7],
                largest_potential_,      made_,        astray_,      exchanged_};
    }

    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        auto const put = [&](Quantity q, int column, double value) {
            if (selects(selected, q)) row[quantity_column(q) + column] = value;
        };
        double const mean = time > 0 ? 1 / time : 0;
        auto const total = [&](int i) { return lane(integral_[i], index); };
        auto const energies = audit();
        put(Quantity::peak_normal_force, 0, lane(force_, index));
        put(Quantity::mean_normal_force, 0, total(3) * mean);
        for (int apex = 0; apex < Report::apices; ++apex) {
            put(Quantity::peak_apex_force, apex, lane(apex_[apex], index));
            put(Quantity::mean_apex_force, apex, total(8 + apex) * mean);
        }
        for (int i = 0; i < 4; ++i) put(Quantity::mode_time, i, lane(mode_time_[i], index));
        put(Quantity::contact_onsets, 0, lane(onsets_, index));
        put(Quantity::energy_residual, 0, lane(energies.residual(), index));
        put(Quantity::energy_change, 0, lane(energies.change, index));
        put(Quantity::crank_work, 0, lane(energies.crank_work, index));
        put(Quantity::friction_loss, 0, lane(energies.friction_loss, index));
        put(Quantity::damping_loss, 0, lane(energies.damping_loss, index));
        put(Quantity::peak_crank_torque, 0, lane(torque_, index));
        put(Quantity::rms_crank_torque, 0, sqrt(total(4) * mean));
        put(Quantity::peak_position_error, 0, lane(error_, index));
        put(Quantity::rms_position_error, 0, sqrt(total(5) * mean));
        put(Quantity::peak_rod_angular_velocity, 0, lane(spin_, index));
        put(Quantity::rms_rod_angular_velocity, 0, sqrt(total(6) * mean));
        put(Quantity::peak_tilt, 0, lane(roll_, index));
        put(Quantity::peak_tilt, 1, lane(yaw_, index));
        put(Quantity::peak_tilt, 2, lane(pitch_, index));
    }

private:
    /// 0 free, 1 point, 2 line, 3 surface: the hardest contact of the configuration.
    SLIDEWAY_FN static Real mode_class(Report const& r) {
        Real const zero(0.0);
        Real const soft = select(r.contact.points > zero, Real(1.0), zero);
        return select(r.contact.surfaces > zero, Real(3.0), select(r.contact.lines > zero, Real(2.0), soft));
    }

    /// What the method made in a step, for the audit.  The books of a step in which the law may have switched take what its springs
    /// did for what they hold: E − U must follow from the powers, whatever U does.  Where the apices that touch stay the same no
    /// switch is made; nor at the border to free flight, where U is 0 on both sides: a step that leaps into the way or out of it has
    /// no such excuse.
    SLIDEWAY_FN void audit_step(Mask<Real> accepted, Real h, Real const* integral, Report const& r, bool switches) {
        Real const zero(0.0);
        Real made = fnma(h, integral[0] - integral[1] - integral[2], r.energy - energy_);
        Real exchanged = r.contact.potential - potential_;
        if (switches) {
            Real const taken_up = h * integral[integrals - 1];
            Real const pattern = r.contact.pattern();
            auto const may_switch = (pattern != pattern_) & (pattern != zero) & (pattern_ != zero);
            made = made - select(may_switch, exchanged - taken_up, zero);
            exchanged = taken_up;
        }
        made_ = select(accepted, made_ + made, made_);
        astray_ = select(accepted, astray_ + abs(made), astray_);
        exchanged_ = select(accepted, exchanged_ + abs(exchanged), exchanged_);
    }

    SLIDEWAY_FN void take_peaks(Mask<Real> lanes_taken, Report const& r, Real const* state) {
        auto const raise = [&](Real& peak, Real value) { peak = select(lanes_taken, max(value, peak), peak); };
        raise(force_, r.contact.total_force());
        raise(largest_potential_, r.contact.potential);
        if constexpr (Report::apices > 0) {
            for (int apex = 0; apex < Report::apices; ++apex) raise(apex_[apex], r.contact.apex_force(apex));
        }
        raise(torque_, abs(r.drive_torque));
        raise(error_, r.position_error);
        raise(spin_, r.rod_spin);
        raise(roll_, abs(Report::tilt(state, 0)));
        raise(yaw_, abs(Report::tilt(state, 1)));
        raise(pitch_, abs(Report::tilt(state, 2)));
    }

    Real integral_[integrals];
    Real apex_[Report::apices > 0 ? Report::apices : 1];
    Real mode_time_[4];
    Real force_, torque_, error_, spin_, roll_, yaw_, pitch_;
    Real onsets_, mode_, start_energy_, largest_potential_;
    Real energy_, potential_, pattern_;  // where the next step starts
    Real made_, astray_, exchanged_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
