#pragma once

#include <algorithm>

#include "kernels/joint/contact_memory.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How often contact with each face begins, and how fast the slider comes.
template <class Real> class OnsetCounts {
public:
    SLIDEWAY_FN void start(Mask<Real> fresh) {
        for (auto& face : bins_) {
            for (auto& bin : face) bin = select(fresh, Real(0.0), bin);
        }
    }
    /// @param speed of the approach [m/s]
    SLIDEWAY_FN void add(Mask<Real> in, int face, Real speed) {
        constexpr double from[] = {0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1};  // device code cannot index a constant of the host
        static_assert(std::ranges::equal(from, impact_speed_bins));
        Real above = slideway::count<Real>(in);
        for (int k = 0; k < impact_speed_count; ++k) {
            Real const beyond = k + 1 < impact_speed_count ? slideway::count<Real>(in & (speed >= Real(from[k + 1]))) : Real(0.0);
            bins_[face][k] = bins_[face][k] + (above - beyond);
            above = beyond;
        }
    }
    /// The selected quantities of one lane.
    SLIDEWAY_HD void finish(int index, Selection selected, double* row) const {
        for (int i = 0; i < face_count; ++i) {
            double onsets = 0;
            for (int k = 0; k < impact_speed_count; ++k) {
                double const number = lane(bins_[i][k], index);
                onsets += number;
                if (selects(selected, Quantity::impact_speeds)) row[quantity_column(Quantity::impact_speeds) + i * impact_speed_count + k] = number;
            }
            if (selects(selected, Quantity::face_onsets)) row[quantity_column(Quantity::face_onsets) + i] = onsets;
        }
    }

private:
    Real bins_[face_count][impact_speed_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
