#pragma once

#include "kernels/observers/quantities.hpp"
#include "kernels/observers/side_record.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Accelerations of a slider's centre along X, Y and Z, and of the sensors top and front: their magnitudes, and ax², ay², az², |top|, |front| to be integrated.
struct ToldAccelerations {
    static constexpr Keeper keeper = Keeper::accelerations;
    static constexpr int integrals = 5, peaks = integrals;

    template <class Real, class Report> SLIDEWAY_FN static void tell_peaks(Report const& r, Real* values) {
        auto const& a = r.acceleration;
        values[0] = abs(a.x);
        values[1] = abs(a.y);
        values[2] = abs(a.z);
        values[3] = abs(r.top);
        values[4] = abs(r.front);
    }
    template <class Real, class Report> SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        auto const& a = r.acceleration;
        values[0] = a.x * a.x;
        values[1] = a.y * a.y;
        values[2] = a.z * a.z;
        values[3] = abs(r.top);
        values[4] = abs(r.front);
    }
};

template <class Real> class AccelerationRecord : public SideRecord<Real, ToldAccelerations> {
public:
    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        for (int i = 0; i < 3; ++i) {
            // Weights of stages may be negative: of next to nothing the sum may be less than nothing.
            this->put(selected, row, Quantity::peak_acceleration, i, this->peak(i, index));
            this->put(selected, row, Quantity::rms_acceleration, i, time > 0 ? sqrt(max(this->integral(i, index), 0.0) / time) : 0.0);
        }
        for (int i = 0; i < 2; ++i) {
            this->put(selected, row, Quantity::peak_channel_acceleration, i, this->peak(3 + i, index));
            this->put(selected, row, Quantity::acceleration_area, i, this->integral(3 + i, index));
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
