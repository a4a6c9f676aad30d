// Members whose parameters differ.
#pragma once

#include "kernels/inputs.hpp"

namespace slideway::bench {

/// Spreads what the tolerances of manufacture and operation leave open.  @param factor of an irrational number: near 1, another for
/// each member
template <class Factor> void spread_inputs(Inputs& in, double chi, Factor const& factor) {
    in.clearance_y *= factor(0.3166247903553998);
    in.clearance_z *= factor(0.6055512754639891);
    in.crank_speed *= factor(0.1231056256176606);
    in.friction_static *= factor(0.3588989435406740);
    in.friction_kinetic *= factor(0.7958315233127191);
    in.eta *= factor(0.3851648071345037);
    in.chi_line = in.chi_surface = chi;
}

}  // namespace slideway::bench
