// Seeded cases for holding a kernel against the oracle: all kernel parts, every parameter varied, and states placed
// so that each contact mode that the joint can take occurs.  Only raw bits of std::mt19937_64 are used, so the cases
// are the same with every standard library.
#pragma once

#include "kernels/mechanisms/list.hpp"
#include "oracle.hpp"

#include <cstdint>
#include <vector>

namespace oracle {

struct Case {
    slideway::Inputs inputs;  // completed
    slideway::Parts parts;
    double t = 0;
    State state{};
    Pairs impact_speeds{};  // v0 >= 1e-4 m/s; read by Damping::restitution alone
};

/// Cases in order; a longer list begins with the shorter one.  Case i has the parts number i mod 24 of
/// the 2 laws of model.md 4 x 3 dampings x friction x way pose, and one of these states:
/// - settled (half): five of the pairs 1e-10 to 1e-5 m deep or clear of their face, whatever touches then;
/// - wedged (a quarter): clearances below 3 µm and tilts of their order; the patterns of the Y and the Z faces run
///   through all 8 x 8 combinations, opposite faces at once included;
/// - loose (a quarter): any place and tilt within the clearance, mostly free; some lie flat, without any tilt.
/// Rates run from zero, also exactly, to impacts; sliding speeds from zero over the range of friction and beyond.
/// A carriage is anywhere on its way, at constant speed or turning round; a free slider moves along the way as well.
/// Where there is no rod every other point stiffness is given and does not follow from the apex.
/// @param mechanism a spatial one
std::vector<Case> make_cases(std::uint64_t seed, int count,
                             slideway::Mechanism mechanism = slideway::Mechanism::slider_crank);

/// The same cases, all of them under one law, with numbers drawn for what the law has of its own: of kelvin_voigt the
/// stiffness follows or is 1e5 to 1e10 N/m, the damping is 0 or 1 to 1e4 N s/m.
std::vector<Case> make_cases(std::uint64_t seed, int count, slideway::Mechanism mechanism, slideway::Law law);

}  // namespace oracle
