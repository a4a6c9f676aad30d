#pragma once

#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A model whose accelerations nobody may ask for.
struct NoAccelerations {
    static constexpr int integrals = 0, peaks = 0;
    static constexpr Selection quantities = 0;
    SLIDEWAY_HD static constexpr bool needs_stages(Selection) { return false; }
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection) { return false; }
};

/// Peaks and integrals of the accelerations of a pack's sliders: of the centre along X, Y and Z, and of the sensors top and front.  Apart
/// from the other quantities, for a member that asks for none carries nothing of it along.  Peaks go by the accepted steps; of the
/// integrals ∫ax², ∫ay², ∫az², ∫|top|, ∫|front| each step takes the mean over its stages with the stepper's weights.
template <class Real> class AccelerationRecord {
public:
    static constexpr int integrals = 5;
    static constexpr Selection quantities =
        quantities_where([](QuantityInfo const& info) { return info.keeper == Keeper::accelerations; });
    /// Whether the integrals are asked for.
    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) {
        constexpr Selection integrating = quantities & quantities_where([](QuantityInfo const& info) { return info.integrates(); });
        return (q & integrating) != 0;
    }

    /// Begins the members in the lanes of the mask.
    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r) {
        Real const zero(0.0);
        for (int i = 0; i < count; ++i) {
            for (auto* number : {&peak_[i], &integral_[i], &at_start_[i], &mean_[i]}) {
                *number = select(fresh, zero, *number);
            }
        }
        raise(fresh, r);
    }

    /// Begins a step with the stage at its start.
    SLIDEWAY_FN void begin_step(double weight) {
        for (int i = 0; i < count; ++i) mean_[i] = Real(weight) * at_start_[i];
    }
    template <class Report> SLIDEWAY_FN void add_stage(double weight, Report const& r) {
        Real values[count];
        integrands(r, values);
        for (int i = 0; i < count; ++i) mean_[i] = fma(Real(weight), values[i], mean_[i]);
    }
    /// Sets the means over a step, of a stepper that makes them itself.
    SLIDEWAY_FN void set_means(Mask<Real> in, Real const* means) {
        for (int i = 0; i < count; ++i) mean_[i] = select(in, means[i], mean_[i]);
    }
    SLIDEWAY_FN void integrands_at_start(Real* values) const {
        for (int i = 0; i < count; ++i) values[i] = at_start_[i];
    }
    /// What the next step starts from, in the lanes of the mask.
    template <class Report> SLIDEWAY_FN void begin_next(Mask<Real> in, Report const& r) {
        Real values[count];
        integrands(r, values);
        for (int i = 0; i < count; ++i) at_start_[i] = select(in, values[i], at_start_[i]);
    }
    /// One accepted step of the lanes in the mask.
    template <class Report> SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Report const& r) {
        for (int i = 0; i < count; ++i) integral_[i] = select(accepted, fma(h, mean_[i], integral_[i]), integral_[i]);
        raise(accepted, r);
    }

    static constexpr int peaks = integrals;
    template <class Report> SLIDEWAY_FN static void tell_peaks(Report const& r, Real* values) {
        auto const& a = r.acceleration;
        values[0] = abs(a.x);
        values[1] = abs(a.y);
        values[2] = abs(a.z);
        values[3] = abs(r.top);
        values[4] = abs(r.front);
    }
    SLIDEWAY_FN void raise_peaks(Mask<Real> in, Real const* values) {
        for (int i = 0; i < peaks; ++i) peak_[i] = select(in, max(values[i], peak_[i]), peak_[i]);
    }
    SLIDEWAY_HD static constexpr bool needs_peaks(Selection q) {
        constexpr Selection peaking = quantities & quantities_where([](QuantityInfo const& info) { return info.statistic == Statistic::peak; });
        return (q & peaking) != 0;
    }

    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        auto const put = [&](Quantity q, int column, double value) {
            if (selects(selected, q)) row[quantity_column(q) + column] = value;
        };
        for (int i = 0; i < 3; ++i) {
            put(Quantity::peak_acceleration, i, lane(peak_[i], index));
            put(Quantity::rms_acceleration, i, time > 0 ? sqrt(lane(integral_[i], index) / time) : 0.0);
        }
        for (int i = 0; i < 2; ++i) {
            put(Quantity::peak_channel_acceleration, i, lane(peak_[3 + i], index));
            put(Quantity::acceleration_area, i, lane(integral_[3 + i], index));
        }
    }

    template <class Report> SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        auto const& a = r.acceleration;
        values[0] = a.x * a.x;
        values[1] = a.y * a.y;
        values[2] = a.z * a.z;
        values[3] = abs(r.top);
        values[4] = abs(r.front);
    }

private:
    static constexpr int count = integrals;

    template <class Report> SLIDEWAY_FN void raise(Mask<Real> taken, Report const& r) {
        Real values[peaks];
        tell_peaks(r, values);
        raise_peaks(taken, values);
    }

    Real peak_[count], integral_[count];
    Real at_start_[count], mean_[count];  // of the integrands, of the step that is tried
};

}  // namespace slideway::inline SLIDEWAY_ISA
