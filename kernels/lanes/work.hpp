#pragma once

namespace slideway {

/// What the lanes do next with a member: one that is new is evaluated; then it makes steps of one of three sorts, between which `auto` changes
/// it (kernels/lanes/method_choice.hpp).
enum class Work : unsigned char {
    none,
    fresh,
    plain,    // explicit steps by time, or of a fixed length
    stiff,    // of the linearly implicit method
    clocked,  // explicit steps by the clocks of impacts
};
inline constexpr int work_count = 5;

}  // namespace slideway
