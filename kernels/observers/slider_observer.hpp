#pragma once

#include "kernels/block.hpp"
#include "kernels/mechanisms/slider_report.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/quantity_places.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The scalar quantities of a pack of mechanisms with one slider: those of the table whose keeper is `mechanism`.  Only the energy
/// audit has a say in the steps: its integrals meet the tolerance too.  Integrals run over the stages with the stepper's own weights, so
/// they have its order; mode times and onsets go by the accepted steps, peaks by what is inside of them
/// too (PeakSearch).
/// @tparam Report_ SliderReport or PlanarReport
template <class Real, template <class> class Report_ = SliderReport> class SliderObserver {
public:
    using Report = Report_<Real>;
    using Places = QuantityPlaces<Keeper::mechanism, Report::apices>;
    static constexpr int columns = quantity_columns;  // of a member's row
    /// Integrands: |power| of what drives and the contacts' springs' power, of which a law that switches keeps books, then those of the energy audit, of
    /// which those of loads are the last, then those of other quantities.
    static constexpr int first_audited = 2, audit_integrals = Places::audit_integrals, of_loads = 4;
    static constexpr int integrals = Places::integrals + first_audited;

    /// What a quantity is the peak, mean or integral of: a line each.
    /// @param state at the accepted steps; AtStage for integrals, which have the report alone
    template <Quantity q, class State>
    SLIDEWAY_FN static Real value(Report const& r, [[maybe_unused]] State const& state, [[maybe_unused]] int column) {
        using enum Quantity;
        if constexpr (q == peak_normal_force || q == mean_normal_force) return r.contact.total_force();
        else if constexpr (q == peak_apex_force || q == mean_apex_force) return r.contact.apex_force(column);
        else if constexpr (q == drive_work) return r.crank_power;
        else if constexpr (q == friction_loss) return r.contact.friction_power;
        else if constexpr (q == damping_loss) return r.contact.damping_power;
        else if constexpr (q == load_work) return r.load_power;
        else if constexpr (q == ground_work) return r.ground_power;
        else if constexpr (q == spring_loss) return r.spring_loss;
        else if constexpr (q == film_loss) return r.film_loss;
        else if constexpr (q == peak_crank_torque || q == rms_crank_torque) return r.drive_torque;
        else if constexpr (q == peak_position_error || q == rms_position_error) return r.position_error;
        else if constexpr (q == peak_rod_angular_velocity || q == rms_rod_angular_velocity) return r.rod_spin;
        else if constexpr (q == peak_tilt) return Report::tilt(state, column);
        else static_assert(q == Quantity::count, "SliderObserver::value has no line for a quantity of the table");
    }
    struct AtStage {};

    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) {
        constexpr Selection integrating = quantities_where([](QuantityInfo const& info) {
            return info.keeper == Keeper::mechanism && (info.integrates() || info.audits());
        });
        return (q & integrating) != 0;
    }
    /// The quantities of the energy audit; any of them brings the whole of it along.
    static constexpr Selection audit_quantities = quantities_where([](QuantityInfo const& info) { return info.audits(); });
    /// Whether the audit's integrals are asked for and must meet the tolerance themselves.
    SLIDEWAY_HD static constexpr bool audits(Selection q) { return (q & audit_quantities) != 0; }
    /// Whether anything else is to be integrated.
    SLIDEWAY_HD static constexpr bool integrates_more(Selection q) {
        constexpr Selection others = quantities_where([](QuantityInfo const& info) {
            return info.keeper == Keeper::mechanism && info.integrates() && !info.audits();
        });
        return (q & others) != 0;
    }
    /// Whether a report is needed at the accepted steps.
    SLIDEWAY_HD static constexpr bool needs_reports(Selection q) { return q != 0; }

    /// Whether peaks are asked for.
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection q) {
        constexpr Selection peaking = quantities_where([](QuantityInfo const& info) {
            return info.keeper == Keeper::mechanism && info.statistic == Statistic::peak;
        });
        return (q & peaking) != 0;
    }

    /// As many integrands, the first ones, are powers of the energy audit: reports may tell them alone.
    static constexpr int powers = first_audited + audit_integrals;
    SLIDEWAY_FN static void powers_of(Report const& r, Real* values) {
        for_each_quantity([&]<Quantity q>(Named<q>) {
            if constexpr (Places::is_audited(q)) values[place_of<q>] = value<q>(r, AtStage{}, 0);
        });
        values[turnover] = (abs(r.crank_power) + abs(r.load_power)) + abs(r.ground_power);
        values[springs] = r.contact.elastic_power;
    }

    SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        powers_of(r, values);
        for_each_quantity([&]<Quantity q>(Named<q>) {
            if constexpr (Places::integrates(q) && !Places::is_audited(q)) {
                constexpr bool squared = Places::info(q).statistic == Statistic::root_mean_square;
                for (int i = 0; i < Places::columns(q); ++i) {
                    Real const x = value<q>(r, AtStage{}, i);
                    values[place_of<q> + i] = squared ? x * x : x;
                }
            }
        });
    }

    /// As many peaks are kept.
    static constexpr int peaks = Places::peaks;
    SLIDEWAY_FN static void tell_peaks(Report const& r, Real const* state, Real* values) {
        for_each_quantity([&]<Quantity q>(Named<q>) {
            if constexpr (Places::is_peak(q)) {
                constexpr int width = Places::columns(q);
                for (int i = 0; i < width; ++i) values[Places::template peak_of<q> + i] = abs(value<q>(r, state, i));
            }
        });
    }
    SLIDEWAY_FN void raise_peaks(Mask<Real> in, Real const* values) {
        for (int i = 0; i < peaks; ++i) peak_[i] = select(in, max(values[i], peak_[i]), peak_[i]);
    }
    /// Lanes whose step of length h ends with a force that may have passed a new peak inside: half of one and more, and it changes.
    SLIDEWAY_FN Mask<Real> comes_near_peaks(Mask<Real> accepted, Real h, Report const& r) const {
        Real const two(2.0);
        Mask<Real> near = two * r.contact.total_force() > peak_[Places::template peak_of<Quantity::peak_normal_force>];
        if constexpr (Places::keeps(Quantity::peak_apex_force)) {
            for (int i = 0; i < Report::apices; ++i) {
                near = near | (two * r.contact.apex_force(i) > peak_[Places::template peak_of<Quantity::peak_apex_force> + i]);
            }
        }
        return accepted & near & (h * abs(r.contact.elastic_power) > Real(1e-3) * r.contact.potential);
    }

    /// Begins the members in the lanes of the mask.
    /// @param switches of the law: it makes energy.  The same in all calls.
    SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r, Real const* state, bool switches) {
        Real const zero(0.0);
        for (auto* value : {&onsets_, &largest_potential_, &made_, &astray_, &exchanged_, &switched_}) {
            *value = select(fresh, zero, *value);
        }
        for (auto& value : integral_) value = select(fresh, zero, value);
        for (auto& value : peak_) value = select(fresh, zero, value);
        for (auto& value : mode_time_) value = select(fresh, zero, value);
        start_energy_ = select(fresh, r.energy, start_energy_);
        resume(fresh, r, switches);
        mode_ = select(fresh, mode_class(r), mode_);
        depth_ = select(fresh, r.contact.deepest(), depth_);
        take_peaks(fresh, r, state);
    }

    /// What the impulses of a step make, where steps have some (RigidObserver).
    SLIDEWAY_FN static void take_impulses(Mask<Real>, Report_<Real> const&) {}
    /// One accepted step of the lanes in the mask.  @param integral Σ b_s · integrand of the step's stages.
    SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Real const* integral, Report const& r, Real const* state,
                            bool switches) {
        Real const zero(0.0), half(0.5);
        for (int i = 0; i < integrals; ++i) {
            integral_[i] = select(accepted, fma(h, integral[i], integral_[i]), integral_[i]);
        }
        audit_step(accepted, h, integral, r, switches);
        resume(accepted, r, switches);
        Real const mode = mode_class(r), depth = r.contact.deepest();
        // Contact begins or ends where the deepest pair meets its face, by the chord of its depths; other modes share their step by halves.
        auto const crosses = (mode_ * mode == zero) & (mode_ + mode > zero) & (depth_ * depth < zero);
        Real former = half * h;
        if (any(crosses)) former = select(crosses, h * depth_ / select(crosses, depth_ - depth, Real(1.0)), former);
        former = select(accepted, former, zero);
        Real const latter = select(accepted, h, zero) - former;
        for (int i = 0; i < 4; ++i) {
            Real const number(static_cast<double>(i));
            mode_time_[i] = mode_time_[i] + select(mode_ == number, former, zero) + select(mode == number, latter, zero);
        }
        depth_ = select(accepted, depth, depth_);
        auto const onset = accepted & (mode_ == zero) & (mode > zero);
        onsets_ = onsets_ + count<Real>(onset);
        mode_ = select(accepted, mode, mode_);
        take_peaks(accepted, r, state);
    }

    /// What the next step starts from, in the lanes of the mask.
    SLIDEWAY_FN void resume(Mask<Real> in, Report const& r, bool switches) {
        energy_ = select(in, r.energy, energy_);
        potential_ = select(in, r.contact.potential, potential_);
        if (switches) pattern_ = select(in, r.contact.pattern(), pattern_);
    }

    /// The same where the law has changed at the same state: what its potential jumps by is energy that nobody supplied (model.md 8).
    SLIDEWAY_FN void switch_over(Mask<Real> in, Report const& r, bool switches) {
        switched_ = select(in, switched_ + (r.contact.potential - potential_), switched_);
        resume(in, r, switches);
        turn_mode(in, r);
    }

    /// Where other contacts are held from here on: the mode of the step that follows.  Its share of that step would else be of the mode
    /// before, and steps by the clocks of impacts are long.
    SLIDEWAY_FN void turn_mode(Mask<Real> in, Report const& r) {
        Real const zero(0.0), mode = mode_class(r);
        onsets_ = onsets_ + count<Real>(in & (mode_ == zero) & (mode > zero));
        mode_ = select(in, mode, mode_);
    }

    /// Integral of an integrand up to the last accepted step.
    SLIDEWAY_FN Real integral(int i) const { return integral_[i]; }

    /// The energy audit up to the last accepted step, where it ran.
    SLIDEWAY_FN EnergyAudit<Real> audit() const {
        Real const drive_work = integral_[place_of<Quantity::drive_work>];
        Real const friction_loss = integral_[place_of<Quantity::friction_loss>];
        Real const damping_loss = integral_[place_of<Quantity::damping_loss>];
        Real const works = integral_[place_of<Quantity::load_work>] + integral_[place_of<Quantity::ground_work>];
        return {energy_ - start_energy_, drive_work, friction_loss, damping_loss, works, integral_[place_of<Quantity::spring_loss>],
                integral_[place_of<Quantity::film_loss>], integral_[turnover], largest_potential_, made_, astray_, exchanged_,
                max(abs(energy_), abs(start_energy_))};
    }

    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        double const mean = time > 0 ? 1 / time : 0;
        for_each_quantity([&]<Quantity q>(Named<q>) {
            if constexpr (Places::keeps(q)) {
                if (!selects(selected, q)) return;
                constexpr int first = quantity_column(q), width = Places::columns(q);
                for (int i = 0; i < width; ++i) row[first + i] = result<q>(index, i, mean);
            }
        });
    }

protected:
    static constexpr int turnover = 0, springs = 1;
    template <Quantity q> static constexpr int place_of = first_audited + Places::template integral_of<q>;
    static_assert(place_of<Quantity::load_work> == powers - of_loads && place_of<Quantity::film_loss> == powers - 1);

    /// A quantity of one lane.  @param mean 1/t, of the time integrated.
    template <Quantity q> SLIDEWAY_HD double result(int index, int column, double mean) const {
        constexpr QuantityInfo info = Places::info(q);
        if constexpr (info.statistic == Statistic::peak) {
            return lane(peak_[Places::template peak_of<q> + column], index);
        } else if constexpr (info.integrates()) {
            double const total = lane(integral_[place_of<q> + column], index);
            if constexpr (info.statistic == Statistic::mean) return total * mean;
            else if constexpr (info.statistic == Statistic::root_mean_square) return sqrt(total * mean);
            else return total;
        } else {
            return lane(counted<q>(column), index);
        }
    }
    template <Quantity q> SLIDEWAY_FN Real counted([[maybe_unused]] int column) const {
        using enum Quantity;
        if constexpr (q == mode_time) return mode_time_[column];
        else if constexpr (q == contact_onsets) return onsets_;
        else if constexpr (q == capped_impacts) return Real(0.0);  // RigidObserver has them
        else if constexpr (q == switching_energy) return switched_;
        else if constexpr (q == energy_change) return audit().change;
        else if constexpr (q == energy_residual) return audit().residual();
        else static_assert(q == Quantity::count, "SliderObserver::counted has no line for a quantity of the table");
    }

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
        using enum Quantity;
        Real const supplied = (integral[place_of<drive_work>] - integral[place_of<friction_loss>] - integral[place_of<damping_loss>]) +
                              ((integral[place_of<load_work>] + integral[place_of<ground_work>]) - (integral[place_of<spring_loss>] + integral[place_of<film_loss>]));
        Real made = fnma(h, supplied, r.energy - energy_);
        Real exchanged = r.contact.potential - potential_;
        if (switches) {
            Real const taken_up = h * integral[springs];
            Real const pattern = r.contact.pattern();
            auto const may_switch = (pattern != pattern_) & (pattern != zero) & (pattern_ != zero);
            made = made - select(may_switch, exchanged - taken_up, zero);
            exchanged = taken_up;
        }
        made_ = select(accepted, made_ + made, made_);
        astray_ = select(accepted, astray_ + abs(made), astray_);
        exchanged_ = select(accepted, exchanged_ + abs(exchanged), exchanged_);
    }

    SLIDEWAY_FN void take_peaks(Mask<Real> taken, Report const& r, Real const* state) {
        largest_potential_ = select(taken, max(r.contact.potential + r.spring_potential, largest_potential_), largest_potential_);
        Real values[peaks];
        tell_peaks(r, state, values);
        raise_peaks(taken, values);
    }

    Real integral_[integrals];
    Real peak_[Places::peaks];
    Real mode_time_[4];
    Real onsets_, mode_, start_energy_, largest_potential_;
    Real energy_, potential_, pattern_, depth_;  // where the next step starts
    Real made_, astray_, exchanged_;
    Real switched_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
