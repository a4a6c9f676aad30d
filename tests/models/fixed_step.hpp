#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernels/lane_copy.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Members that take the same number of equal steps.  Views of memory that the caller owns.
template <class Model> struct FixedStepBlock {
    typename Model::Inputs const* inputs = nullptr;  // [members]
    std::size_t members = 0;
    double step = 0;           // h
    std::uint64_t steps = 0;   // from t = 0
    double* states = nullptr;  // [members][size] at t = steps · h, the result; not finite where a member diverged
};

/// How a group of packs shares a core.  A step of one pack is a chain of dependent operations that keeps a core a third busy.  Packs
/// `abreast` take each stage together, as many as the registers hold; `rows` of them follow one another within a step and overlap
/// because the processor runs ahead.
struct PackGroup {
    int abreast, rows;
};

/// The fastest group for a model of three components: 32 registers of 8 lanes, 16 of fewer (bench/lorenz).
template <class Real> inline constexpr PackGroup pack_group = lanes<Real> == 8 ? PackGroup{4, 2} : PackGroup{2, 3};

namespace detail {

/// One group of packs and its members.  The counts are small constants and every loop over them is a fold, for g++ keeps an array of
/// packs in registers only if it sees no loop; and they are functions, for it inlines lambdas as it likes.
template <class Model, class Real, int abreast, int rows> class FixedStepGroup {
public:
    static constexpr int packs = abreast * rows;
    static constexpr int members = packs * lanes<Real>;

    /// Integrates members [first, first + members); lanes beyond the block repeat its last member.
    SLIDEWAY_HD static void run(FixedStepBlock<Model> const& block, std::size_t first) {
        Parameters p[packs];
        Real y[packs][size];
        load(block, first, p, y);
        FixedStepGroup group(p, y, block.step);
        for (std::uint64_t n = 0; n < block.steps; ++n) group.step(static_cast<double>(n) * block.step);
        copy(group.y_, y, Indices<packs>{});
        store(block, first, y);
    }

private:
    static constexpr int size = Model::size;
    using Parameters = typename Model::template Parameters<Real>;
    template <int n> using Indices = std::make_integer_sequence<int, n>;
    static_assert(!Model::has_contacts, "equal steps locate nothing that a model could remember");

    SLIDEWAY_HD static void load(FixedStepBlock<Model> const& block, std::size_t first, Parameters* p,
                                 Real (*y)[size]) {
        for (int i = 0; i < members; ++i) {
            std::size_t const wanted = first + static_cast<std::size_t>(i);
            auto const& inputs = block.inputs[wanted < block.members ? wanted : block.members - 1];
            int const pack = i / lanes<Real>, index = i % lanes<Real>;
            load_lane(p[pack], index, Model::parameters(inputs));
            double start[size];
            Model::initial_state(inputs, start);
            for (int j = 0; j < size; ++j) put(y[pack][j], index, start[j]);
        }
    }

    /// Lanes are filled in order; the first sets them all.
    SLIDEWAY_FN static void put(Real& x, int index, double value) {
        if (index == 0) {
            x = Real(value);
        } else {
            set_lane(x, index, value);
        }
    }

    SLIDEWAY_HD static void store(FixedStepBlock<Model> const& block, std::size_t first, Real const (*y)[size]) {
        for (int i = 0; i < members; ++i) {
            std::size_t const member = first + static_cast<std::size_t>(i);
            if (member >= block.members) return;
            for (int j = 0; j < size; ++j) {
                block.states[member * size + static_cast<std::size_t>(j)] =
                    lane(y[i / lanes<Real>][j], i % lanes<Real>);
            }
        }
    }

    SLIDEWAY_FN FixedStepGroup(Parameters const* p, Real const (*y)[size], double h)
        : p_(p), half_length_(0.5 * h), h_(h), half_(0.5 * h), sixth_(h * (1.0 / 6)) {
        copy(y, y_, Indices<packs>{});
    }

    template <int... pack>
    SLIDEWAY_FN static void copy(Real const (*from)[size], Real (*to)[size], std::integer_sequence<int, pack...>) {
        (copy(from[pack], to[pack], Indices<size>{}), ...);
    }
    template <int... i> SLIDEWAY_FN static void copy(Real const* from, Real* to, std::integer_sequence<int, i...>) {
        ((to[i] = from[i]), ...);
    }

    SLIDEWAY_FN void step(double t) { each_row(t, Indices<rows>{}); }

    template <int... row> SLIDEWAY_FN void each_row(double t, std::integer_sequence<int, row...>) {
        (step_row<row * abreast>(t), ...);
    }

    /// One step of the packs that begin with `lead`.
    template <int lead> SLIDEWAY_FN void step_row(double t) {
        double const middle = t + half_length_, end = middle + half_length_;
        stage<0, lead>(Real(t), half_, Indices<abreast>{});
        stage<1, lead>(Real(middle), half_, Indices<abreast>{});
        stage<2, lead>(Real(middle), h_, Indices<abreast>{});
        stage<3, lead>(Real(end), sixth_, Indices<abreast>{});
    }

    template <int s, int lead, int... index>
    SLIDEWAY_FN void stage(Real t, Real reach, std::integer_sequence<int, index...>) {
        (stage<s, lead + index>(t, reach), ...);
    }

    /// Slope of one pack at stage `s`, and the state that follows: the next stage's, or the end of the step.
    template <int s, int pack> SLIDEWAY_FN void stage(Real t, Real reach) {
        Real k[size];
        Model::template derivative<false>(t, s == 0 ? y_[pack] : at_[pack], p_[pack], memory_, k, &report_);
        move_on<s>(reach, k, y_[pack], at_[pack], sum_[pack], Indices<size>{});
    }

    template <int s, int... i>
    SLIDEWAY_FN static void move_on(Real reach, Real const* k, Real* y, Real* at, Real* sum,
                                    std::integer_sequence<int, i...>) {
        if constexpr (s == 0) {
            ((sum[i] = k[i]), ...);
        } else {
            ((sum[i] = s < 3 ? fma(Real(2.0), k[i], sum[i]) : sum[i] + k[i]), ...);
        }
        if constexpr (s < 3) {
            ((at[i] = fma(reach, k[i], y[i])), ...);
        } else {
            ((y[i] = fma(reach, sum[i], y[i])), ...);
        }
    }

    Parameters const* p_;
    double half_length_;
    Real h_, half_, sixth_;
    Real y_[packs][size], at_[packs][size], sum_[packs][size];
    typename Model::template Memory<Real> memory_;
    typename Model::template Report<Real> report_;
};

}  // namespace detail

/// Integrates a block with equal steps of the classical Runge–Kutta method, one member per lane; nothing is decided on the way.
/// A member's bits are those of any other group, pack or instruction set with fused multiply-add.
template <class Model, class Real, PackGroup group = pack_group<Real>>
SLIDEWAY_HD void fixed_step(FixedStepBlock<Model> const& block) {
    using Group = detail::FixedStepGroup<Model, Real, group.abreast, group.rows>;
    for (std::size_t first = 0; first < block.members; first += Group::members) Group::run(block, first);
}

}  // namespace slideway::inline SLIDEWAY_ISA
