#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernels/real.hpp"
#include "kernels/steppers/runge_kutta4.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Members that take the same number of equal steps.  Plain views of memory that the caller owns.
template <class Model> struct FixedStepBlock {
    typename Model::Inputs const* inputs = nullptr;  // [members]
    std::size_t members = 0;
    double step = 0;             // h
    std::uint64_t steps = 0;     // from t = 0
    double* states = nullptr;    // [members][size], the result; not finite where a member left the numbers
};

namespace detail {

/// `packs` packs of members that step side by side: while one waits for its last operation, the others keep the units busy.  The
/// counts are small constants and every loop over them is a fold, so that states and slopes live in registers.
template <class Model, class Real, int packs> class FixedStepGroup {
public:
    /// Integrates members [first, first + packs · lanes); what the block lacks repeats its last member.
    SLIDEWAY_HD static void run(FixedStepBlock<Model> const& block, std::size_t first) {
        Start start;
        load(block, first, start);
        Stepper group(start, block.step);
        for (std::uint64_t i = 0; i < block.steps; ++i) group.step(i);
        group.keep(start.y);
        store(block, first, start.y);
    }

private:
    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    using Parameters = typename Model::template Parameters<Real>;
    using Packs = std::make_integer_sequence<int, packs>;
    using Components = std::make_integer_sequence<int, size>;
    static_assert(!Model::has_memory, "a step of fixed size locates nothing that could be remembered");

    struct Start {
        Parameters p[packs];
        Real y[packs][size];
    };

    SLIDEWAY_HD static void load(FixedStepBlock<Model> const& block, std::size_t first, Start& start) {
        for (int i = 0; i < packs * width; ++i) {
            std::size_t const wanted = first + static_cast<std::size_t>(i);
            auto const& inputs = block.inputs[wanted < block.members ? wanted : block.members - 1];
            auto const parameters = Model::parameters(inputs);
            auto const* from = reinterpret_cast<double const*>(&parameters);
            auto* to = reinterpret_cast<Real*>(&start.p[i / width]);
            for (std::size_t j = 0; j < sizeof(parameters) / sizeof(double); ++j) set_lane(to[j], i % width, from[j]);
            double y[size];
            Model::initial_state(inputs, y);
            for (int j = 0; j < size; ++j) set_lane(start.y[i / width][j], i % width, y[j]);
        }
    }

    SLIDEWAY_HD static void store(FixedStepBlock<Model> const& block, std::size_t first, Real const (*y)[size]) {
        for (int i = 0; i < packs * width; ++i) {
            std::size_t const member = first + static_cast<std::size_t>(i);
            if (member >= block.members) return;
            for (int j = 0; j < size; ++j) block.states[member * size + j] = lane(y[i / width][j], i % width);
        }
    }

    class Stepper {
    public:
        SLIDEWAY_FN Stepper(Start const& start, double h)
            : p_(start.p), length_(h), h_(h), half_(0.5 * h), sixth_(h * (1.0 / 6)) {
            each_pack([&](auto p) { each_component([&](auto i) { y_[p][i] = start.y[p][i]; }); });
        }

        /// The step from t = n h.
        SLIDEWAY_FN void step(std::uint64_t n) {
            double const t = static_cast<double>(n) * length_;
            stage<0>(Real(t), half_);
            stage<1>(Real(t + 0.5 * length_), half_);
            stage<2>(Real(t + 0.5 * length_), h_);
            stage<3>(Real(t + length_), sixth_);
        }

        SLIDEWAY_FN void keep(Real (*y)[size]) const {
            each_pack([&](auto p) { each_component([&](auto i) { y[p][i] = y_[p][i]; }); });
        }

    private:
        /// The slope of every pack at the stage, and the state after it: the next stage's, or the end.
        template <int s> SLIDEWAY_FN void stage(Real t, Real reach) {
            each_pack([&](auto p) {
                Real k[size];
                Model::template derivative<false>(t, s == 0 ? y_[p] : at_[p], p_[p], memory_, k, &report_);
                each_component([&](auto i) {
                    sum_[p][i] = RungeKutta4::accumulate<s>(sum_[p][i], k[i]);
                    if constexpr (s < 3) {
                        at_[p][i] = fma(reach, k[i], y_[p][i]);
                    } else {
                        y_[p][i] = fma(reach, sum_[p][i], y_[p][i]);
                    }
                });
            });
        }

        template <class Each> SLIDEWAY_FN static void each_pack(Each each) { over(each, Packs{}); }
        template <class Each> SLIDEWAY_FN static void each_component(Each each) { over(each, Components{}); }
        template <class Each, int... i> SLIDEWAY_FN static void over(Each each, std::integer_sequence<int, i...>) {
            (each(std::integral_constant<int, i>{}), ...);
        }

        Parameters const* p_;
        double length_;
        Real h_, half_, sixth_;
        Real y_[packs][size], at_[packs][size], sum_[packs][size];
        typename Model::template Memory<Real> memory_;
        typename Model::template Report<Real> report_;
    };
};

}  // namespace detail
}  // namespace slideway::inline SLIDEWAY_ISA
