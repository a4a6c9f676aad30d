// A state that a result has stored, to be probed.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "host/config/scene.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

struct StoredState {
    std::uint64_t member;
    double time;                  // [s]
    std::string_view of;          // "sample", "section" or "end"
    std::vector<double> numbers;  // of the mechanism's state
};

/// The one that is nearest in time.  @param mechanism of the result  @param member nothing: the first of the file  @param time [s]; nothing: the end
/// @throws SceneError if there is no such member, or no state of it
StoredState stored_state(ResultView const& results, Mechanism mechanism, std::optional<std::uint64_t> member, std::optional<double> time);

/// Gives the inputs of the result's scene the numbers with which a member ran.
void take_member(Scene& scene, ResultView const& results, std::uint64_t member);

}  // namespace slideway
