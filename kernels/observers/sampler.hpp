#pragma once

#include "kernels/block.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Writes the time series of a pack's members into the block's memory.
template <class Model> class Sampler {
public:
    SLIDEWAY_HD explicit Sampler(BlockBase const& block) : block_(block) {
        for (int i = 0; i < Model::series; ++i) selected_ += (block.series >> i) & 1u;
        beyond_state_ = (block.series >> Model::size) != 0;
    }

    SLIDEWAY_HD bool beyond_state() const { return beyond_state_; }

    /// @param report read only where a series beyond the state is selected.
    template <class Real>
    SLIDEWAY_HD void write(int index, std::size_t member, std::size_t sample, Real const* state,
                           typename Model::template Report<Real> const& report) const {
        std::size_t row = 0;
        for (int i = 0; i < Model::series; ++i) {
            if (!((block_.series >> i) & 1u)) continue;
            double value = not_a_number;
            if (i < Model::size) {
                value = lane(state[i], index);
            } else if constexpr (Model::series > Model::size) {
                value = lane(report.series_value(i), index);
            }
            block_.series_values[(row * block_.members + member) * block_.samples + sample] = value;
            ++row;
        }
    }

    /// Marks the samples that a failed member never reached.
    SLIDEWAY_HD void fill_missing(std::size_t member, std::size_t from) const {
        for (std::size_t row = 0; row < selected_; ++row) {
            auto* const values = block_.series_values + (row * block_.members + member) * block_.samples;
            for (std::size_t i = from; i < block_.samples; ++i) values[i] = not_a_number;
        }
    }

private:
    BlockBase const& block_;
    std::size_t selected_ = 0;
    bool beyond_state_ = false;
};

}  // namespace slideway::inline SLIDEWAY_ISA
