// The kernels as a library: mechanisms, contact laws, and what integrates blocks of members of them.  For units that slideway_add_kernels()
// compiles, or for one member at a time with -DSLIDEWAY_NO_SIMD.
//
//     using Laws = OneLaw<ConservativeLaw, PointDamping>;
//     using Model = MechanismModel<SliderCrank, SliderBase, Laws>;
//     integrate<Model, IsaReal>(block, Model{Conditions<Laws>{{}, ConservativeLaw::info.switches, Parts{}}});
//
// Functions outside of a unit's namespace are static (kernels/members), so that no program takes a unit's copy, of wider instructions, for its own.
// kernels/block.hpp says what a block is, kernels/inputs.hpp what a member is; complete_inputs() fills in masses and inertias.
#pragma once

#include "kernels/all_laws.hpp"
#include "kernels/all_mechanisms.hpp"
#include "kernels/block.hpp"
#include "kernels/integrate.hpp"
#include "kernels/isa_real.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/laws/one_law.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "kernels/members/start.hpp"
#include "kernels/models/mechanism_model.hpp"
