// What mechanisms in space have in common of their contacts: compiled once per instruction set (cpu_joint.cpp) for those of the program.  Modules bring
// their own.
#pragma once

#include "kernels/isa_real.hpp"
#include "kernels/joint/held_contacts.hpp"
#include "kernels/joint/joint_stiffness.hpp"
#include "kernels/joint/oil_film.hpp"
#include "kernels/joint/way_profile.hpp"
#include "kernels/laws/one_law.hpp"

#define SLIDEWAY_JOINT_TEMPLATES(prefix)                                                                     \
    prefix template class HeldContacts<IsaReal, LawFunctions<IsaReal>, false, JointMotion<IsaReal>>;         \
    prefix template class HeldContacts<IsaReal, LawFunctions<IsaReal>, true, JointMotion<IsaReal>>;          \
    prefix template class HeldContacts<IsaReal, LawFunctions<IsaReal>, false, ProfiledMotion<IsaReal>>;      \
    prefix template class HeldContacts<IsaReal, LawFunctions<IsaReal>, true, ProfiledMotion<IsaReal>>;       \
    prefix template class JointLinearisation<IsaReal, LawFunctions<IsaReal>>;                                \
    prefix template struct FilmStiffness<IsaReal>;                                                           \
    prefix template struct OilFilm<IsaReal>;                                                                 \
    prefix template struct WayProfile<IsaReal>;
