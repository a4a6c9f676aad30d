#pragma once

#include "kernels/loads/load_list.hpp"
#include "kernels/loads/table_value.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What loads are read over in a state.
template <class Real> struct LoadArguments {
    Real crank_angle, time, x, vx, crank_speed;

    SLIDEWAY_FN Real of(LoadArgument over) const {
        switch (over) {
            case LoadArgument::crank_angle: return crank_angle;
            case LoadArgument::x: return x;
            case LoadArgument::vx: return vx;
            case LoadArgument::crank_speed: return crank_speed;
            case LoadArgument::time:
            case LoadArgument::nothing: break;
        }
        return time;
    }
};

/// Numbers of a load in a state: those of the member, times what its table is there.
template <class Real> class LoadNumbers {
public:
    /// @param numbers of a member, Inputs::load_a …
    SLIDEWAY_FN LoadNumbers(Load const& load, Real const* numbers, LoadArguments<Real> const& arguments) : numbers_(numbers), factor_(Real(1.0)) {
        if (load.scale != Load::none) factor_ = numbers[load.scale];
        if (load.over != LoadArgument::nothing) factor_ = factor_ * table_value(load.table, arguments.of(load.over));
    }

    SLIDEWAY_FN Real scaled(int place) const { return place == Load::none ? Real(0.0) : factor_ * numbers_[place]; }
    SLIDEWAY_FN Vec3<Real> scaled(int const (&places)[3]) const { return {scaled(places[0]), scaled(places[1]), scaled(places[2])}; }
    SLIDEWAY_FN Real as_given(int place) const { return place == Load::none ? Real(0.0) : numbers_[place]; }
    SLIDEWAY_FN Vec3<Real> as_given(int const (&places)[3]) const { return {as_given(places[0]), as_given(places[1]), as_given(places[2])}; }

private:
    Real const* numbers_;
    Real factor_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
