#pragma once

#include "kernels/block.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which component of a model's state a series is, from 0; -1 if none.
template <class Model> SLIDEWAY_HD constexpr int state_of_series([[maybe_unused]] Model const& model, int series) {
    constexpr bool says = requires { model.state_of_series(series); };
    static_assert(says || Model::series == Model::size,
                  "a model whose samples hold more than its state says where its state is: it lacks state_of_series(series), which a mechanism has of "
                  "its base (kernels/mechanisms/slider_base.hpp)");
    if constexpr (says) {
        return model.state_of_series(series);
    } else {
        return series;
    }
}

/// Whether the state of a model may have angle (0) and speed (1) of a crank, and where it then has them: its crank_state.
template <class Model> inline constexpr bool HasCrankState = requires { Model::crank_state[0]; };
template <class Model, int of> inline constexpr int crank_place = 0;
template <class Model, int of> requires HasCrankState<Model> inline constexpr int crank_place<Model, of> = Model::crank_state[of];

/// Writes the time series of a pack's members into the block's memory.
template <class Model> class Sampler {
public:
    SLIDEWAY_HD Sampler(BlockBase const& block, Model const& model) : block_(block) {
        for (int i = 0; i < Model::series; ++i) {
            if (!((block.series >> i) & 1u)) continue;
            ++selected_;
            beyond_state_ = beyond_state_ || state_of_series(model, i) < 0;
        }
    }

    SLIDEWAY_HD bool beyond_state() const { return beyond_state_; }
    SLIDEWAY_HD bool has_forces() const { return (block_.series & force_series) != 0; }

    /// @param report read only where a series beyond the state is selected.
    template <class Real>
    SLIDEWAY_HD void write(int index, std::size_t member, std::size_t sample, Real const& time, Real const* state,
                           typename Model::template Report<Real> const& report, Model const& model) const {
        SLIDEWAY_EXPECT(member < block_.members && sample < block_.samples);
        if (block_.by_turns) block_.sample_clock[member * block_.samples + sample] = lane(time, index);
        std::size_t row = 0;
        for (int i = 0; i < Model::series; ++i) {
            if (!((block_.series >> i) & 1u)) continue;
            double value = not_a_number;
            int const component = state_of_series(model, i);
            if (component >= 0) {
                value = lane(state[component], index);
            } else if constexpr (Model::series > Model::size) {
                value = lane(report.series_value(i), index);
            }
            block_.series_values[(row * block_.members + member) * block_.samples + sample] = value;
            ++row;
        }
    }

    /// Marks the samples that a failed member never reached.
    SLIDEWAY_HD void fill_missing(std::size_t member, std::size_t from) const {
        for (std::size_t i = from; block_.by_turns && i < block_.samples; ++i) block_.sample_clock[member * block_.samples + i] = not_a_number;
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
