// What a member's run cost, as numbers of a result.
#pragma once

#include <array>
#include <cstdint>

#include "kernels/block.hpp"

namespace slideway {

struct WorkCounter {
    char const* name;  // of the member variable
    char const* meaning;
    std::uint64_t MemberRecord::*of;
};

inline constexpr std::array<WorkCounter, 5> work_table{{
    {"steps_accepted", "accepted steps", &MemberRecord::steps_accepted},
    {"steps_rejected", "rejected steps", &MemberRecord::steps_rejected},
    {"rhs_evaluations", "evaluations of the right-hand side", &MemberRecord::rhs_evaluations},
    {"jacobian_evaluations", "evaluations of the Jacobian", &MemberRecord::jacobian_evaluations},
    {"stiff_steps", "accepted steps of the stiff method", &MemberRecord::stiff_steps},
}};

}  // namespace slideway
