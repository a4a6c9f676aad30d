#pragma once

#include "kernels/lane_copy.hpp"
#include "kernels/math/gram_schmidt.hpp"
#include "kernels/math/offset_growth.hpp"
#include "kernels/real.hpp"
#include "tests/models/map_block.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One pack of a map's orbits, each with its shadows (kernels/lanes/shadows.hpp has those of flows).
/// A `Map` states `Inputs`, `size`, `Parameters<Real>`, `parameters(inputs)`, `initial_state(inputs, state)` and
/// `step(state, parameters, next)`.
template <class Map, class Real> class MapOrbits {
public:
    using Block = MapBlockOf<typename Map::Inputs>;

    /// Takes members [first, first + lanes); lanes beyond the block repeat its last member.
    SLIDEWAY_HD MapOrbits(Block const& block, std::size_t first) : block_(block), first_(first) {
        for (int i = 0; i < lanes<Real>; ++i) {
            std::size_t const member = member_of(i) < block.members ? member_of(i) : block.members - 1;
            auto const& inputs = block.inputs[member];
            auto const parameters = Map::parameters(inputs);
            load_lane(parameters_, i, parameters);
            double y[size];
            Map::initial_state(inputs, y);
            for (int j = 0; j < size; ++j) set_lane(y_[j], i, y[j]);
            ShadowPlan const& plan = block.shadows;
            auto const shadows = static_cast<std::size_t>(plan.count);
            for (int s = 0; s < plan.count; ++s) {
                double const* const direction =
                    plan.directions + (member * shadows + static_cast<std::size_t>(s)) * size;
                for (int j = 0; j < size; ++j) set_lane(shadow_[s][j], i, fma(plan.d0, direction[j], y[j]));
            }
        }
        for (int s = 0; s < block.shadows.count; ++s) {
            distance_[s] = Real(block.shadows.d0);
            growth_[s] = Real(0.0);
        }
        whole_ = Real(1.0);
    }

    SLIDEWAY_HD void run() {
        for (std::size_t stop = 0; stop < block_.stops.count; ++stop) {
            std::uint64_t const steps = stop == 0 ? block_.first_stop : block_.period;
            for (std::uint64_t n = 0; n < steps; ++n) step();
            meet(stop);
        }
        write(block_.final_states, 1, 0, size, y_);
    }

private:
    static constexpr int size = Map::size;

    SLIDEWAY_HD std::size_t member_of(int lane) const { return first_ + static_cast<std::size_t>(lane); }

    SLIDEWAY_HD void step() {
        step(y_);
        for (int s = 0; s < block_.shadows.count; ++s) step(shadow_[s]);
    }
    SLIDEWAY_HD void step(Real* y) const {
        Real next[size];
        Map::step(y, parameters_, next);
        for (int i = 0; i < size; ++i) y[i] = next[i];
    }

    SLIDEWAY_HD void meet(std::size_t stop) {
        StopPlan const& plan = block_.stops;
        int const count = block_.shadows.count;
        check(y_);
        for (int s = 0; s < count; ++s) check(shadow_[s]);
        std::size_t const section = plan.section_at(stop);
        if (block_.section_values != nullptr && section != StopPlan::nowhere) {
            write(block_.section_values, plan.sections(), section, size, y_);
        }
        if (count == 0) return;
        rescale();
        std::size_t const record = plan.growths_at(stop);
        if (record == StopPlan::nowhere) return;
        if (record > 0) write(block_.growth_values, plan.growths(), record - 1, count, growth_);
        for (int s = 0; s < count; ++s) growth_[s] = Real(0.0);
    }

    SLIDEWAY_HD void rescale() {
        ShadowPlan const& plan = block_.shadows;
        Real w[most_shadows][size], length[most_shadows];
        for (int s = 0; s < plan.count; ++s) {
            for (int i = 0; i < size; ++i) w[s][i] = shadow_[s][i] - y_[i];
        }
        orthonormalise(w, plan.count, size, Real(least_distance), 0, length);
        for (int s = 0; s < plan.count; ++s) {
            auto const found = offset_growth(plan, mask_of<Real>(true), length[s], distance_[s], Real(least_distance));
            growth_[s] = growth_[s] + found.growth;
            distance_[s] = found.distance;
            for (int i = 0; i < size; ++i) {
                shadow_[s][i] = select(found.moved, fma(Real(plan.d0), w[s][i], y_[i]), shadow_[s][i]);
            }
        }
    }

    /// An orbit that escaped does not come back.
    SLIDEWAY_HD void check(Real const* y) {
        Real sum(0.0);
        for (int i = 0; i < size; ++i) sum = fma(y[i], Real(0.0), sum);
        whole_ = select(sum == Real(0.0), whole_, Real(not_a_number));
    }

    /// One row of every member's `rows`; an escaped member's is NaN.
    SLIDEWAY_HD void write(double* values, std::size_t rows, std::size_t row, int width, Real const* numbers) const {
        for (int i = 0; i < lanes<Real> && member_of(i) < block_.members; ++i) {
            double* const to = values + (member_of(i) * rows + row) * static_cast<std::size_t>(width);
            for (int j = 0; j < width; ++j) to[j] = lane(numbers[j], i) * lane(whole_, i);
        }
    }

    Block const& block_;
    std::size_t first_;
    typename Map::template Parameters<Real> parameters_;
    Real y_[size], shadow_[most_shadows][size], distance_[most_shadows];
    Real growth_[most_shadows];  // ln, since the last record
    Real whole_;                 // 1, NaN in lanes that left the finite numbers
};

/// Iterates a block of members of a map, one per lane.  A member's results depend on its own inputs alone.
template <class Map, class Real> SLIDEWAY_HD void map_orbit(MapBlockOf<typename Map::Inputs>& block) {
    for (std::size_t first = 0; first < block.members; first += lanes<Real>) {
        MapOrbits<Map, Real>(block, first).run();
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
