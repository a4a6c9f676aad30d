#pragma once

#include "kernels/block.hpp"
#include "kernels/mechanisms/slider_crank_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Writes the time series of a pack's members into the block's memory.
class Sampler {
public:
    SLIDEWAY_HD explicit Sampler(Block const& block) : block_(block) {
        for (int i = 0; i < series_count; ++i) selected_ += selects(block.series, static_cast<Series>(i)) ? 1 : 0;
        beyond_state_ = (block.series >> state_series) != 0;
    }

    SLIDEWAY_HD bool beyond_state() const { return beyond_state_; }

    /// @param report read only where a series beyond the state is selected.
    template <class Real>
    SLIDEWAY_HD void write(int index, std::size_t member, std::size_t sample, Real const* state,
                           SliderCrankReport<Real> const& report) const {
        std::size_t row = 0;
        for (int i = 0; i < series_count; ++i) {
            auto const series = static_cast<Series>(i);
            if (!selects(block_.series, series)) continue;
            double const value = i < state_series ? lane(state[i], index) : reported(series, index, report);
            block_.series_values[(row * block_.members + member) * block_.samples + sample] = value;
            ++row;
        }
    }

    /// Marks the samples that a failed member never reached.
    SLIDEWAY_HD void fill_missing(std::size_t member, std::size_t from) const {
        for (std::size_t row = 0; row < selected_; ++row) {
            auto* const values = block_.series_values + (row * block_.members + member) * block_.samples;
            for (std::size_t i = from; i < block_.samples; ++i) values[i] = follows;
        }
    }

private:
    template <class Real>
    SLIDEWAY_HD static double reported(Series series, int index, SliderCrankReport<Real> const& r) {
        switch (series) {
            case Series::x:
                return lane(r.x, index);
            case Series::vx:
                return lane(r.vx, index);
            case Series::normal_force:
                return lane(r.contact.total_force(), index);
            case Series::crank_torque:
                return lane(r.drive_torque, index);
            case Series::rod_angular_velocity:
                return lane(r.rod_spin_z, index);
            case Series::surfaces:
                return lane(r.contact.surfaces, index);
            case Series::lines:
                return lane(r.contact.lines, index);
            case Series::points:
                return lane(r.contact.points, index);
            default:
                return follows;
        }
    }

    Block const& block_;
    std::size_t selected_ = 0;
    bool beyond_state_ = false;
};

}  // namespace slideway::inline SLIDEWAY_ISA
