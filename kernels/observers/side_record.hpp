#pragma once

#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Peaks and integrals beside those of a pack's observer, for a member that asks for none carries nothing of it along.  Peaks go by the accepted
/// steps, and by what is inside of them; of integrals each step takes the mean over its stages with the stepper's weights.
/// @tparam Told has `keeper`, `integrals`, `peaks`, and of a report `integrands(report, values)` and `tell_peaks(report, values)`
template <class Real, class Told> class SideRecord : public Told {
public:
    using Told::integrals, Told::peaks;
    static constexpr Selection quantities = quantities_where([](QuantityInfo const& info) { return info.keeper == Told::keeper; });
    /// Whether the integrals are asked for, and the peaks.
    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) {
        constexpr Selection integrating = quantities & quantities_where([](QuantityInfo const& info) { return info.integrates(); });
        return (q & integrating) != 0;
    }
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection q) {
        constexpr Selection peaking = quantities & quantities_where([](QuantityInfo const& info) { return info.statistic == Statistic::peak; });
        return (q & peaking) != 0;
    }

    /// Begins the members in the lanes of the mask.
    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r) {
        Real const zero(0.0);
        for (int i = 0; i < peaks; ++i) peak_[i] = select(fresh, zero, peak_[i]);
        for (int i = 0; i < integrals; ++i) {
            for (auto* number : {&integral_[i], &at_start_[i], &mean_[i]}) *number = select(fresh, zero, *number);
        }
        raise(fresh, r);
    }

    /// Begins a step with the stage at its start.
    SLIDEWAY_FN void begin_step(double weight) {
        for (int i = 0; i < integrals; ++i) mean_[i] = Real(weight) * at_start_[i];
    }
    template <class Report> SLIDEWAY_FN void add_stage(double weight, Report const& r) {
        Real values[integrals];
        Told::integrands(r, values);
        for (int i = 0; i < integrals; ++i) mean_[i] = fma(Real(weight), values[i], mean_[i]);
    }
    /// Sets the means over a step, of a stepper that makes them itself.
    SLIDEWAY_FN void set_means(Mask<Real> in, Real const* means) {
        for (int i = 0; i < integrals; ++i) mean_[i] = select(in, means[i], mean_[i]);
    }
    SLIDEWAY_FN void integrands_at_start(Real* values) const {
        for (int i = 0; i < integrals; ++i) values[i] = at_start_[i];
    }
    /// What the next step starts from, in the lanes of the mask.
    template <class Report> SLIDEWAY_FN void begin_next(Mask<Real> in, Report const& r) {
        Real values[integrals];
        Told::integrands(r, values);
        for (int i = 0; i < integrals; ++i) at_start_[i] = select(in, values[i], at_start_[i]);
    }
    /// One accepted step of the lanes in the mask.
    template <class Report> SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Report const& r) {
        for (int i = 0; i < integrals; ++i) integral_[i] = select(accepted, fma(h, mean_[i], integral_[i]), integral_[i]);
        raise(accepted, r);
    }
    SLIDEWAY_FN void raise_peaks(Mask<Real> in, Real const* values) {
        for (int i = 0; i < peaks; ++i) peak_[i] = select(in, max(values[i], peak_[i]), peak_[i]);
    }

protected:
    /// Of one lane.
    SLIDEWAY_HD double peak(int i, int index) const { return lane(peak_[i], index); }
    SLIDEWAY_HD double integral(int i, int index) const { return lane(integral_[i], index); }
    /// A quantity's column in a member's row, where it is selected.
    SLIDEWAY_HD static void put(Selection selected, double* row, Quantity q, int column, double value) {
        if (selects(selected, q)) row[quantity_column(q) + column] = value;
    }

private:
    template <class Report> SLIDEWAY_FN void raise(Mask<Real> taken, Report const& r) {
        Real values[peaks];
        Told::tell_peaks(r, values);
        raise_peaks(taken, values);
    }

    Real peak_[peaks], integral_[integrals];
    Real at_start_[integrals], mean_[integrals];  // of the integrands, of the step that is tried
};

/// In the place of one that nobody may ask for.
template <Keeper> struct NoRecord {
    static constexpr int integrals = 0, peaks = 0;
    static constexpr Selection quantities = 0;
    SLIDEWAY_HD static constexpr bool needs_stages(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection) { return false; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
