#include "host/study/verification.hpp"

#include <algorithm>
#include <cmath>

#include "host/study/continued_sweep.hpp"
#include "host/study/member_check.hpp"

namespace slideway {
namespace {

/// Of a study that keeps no members: whether some run again to be compared.
bool runs_members_anew(std::optional<std::uint64_t> asked, std::uint64_t all) {
    return asked || all >= 100 * least_members;
}

/// Nothing varies: all members are one.
bool is_one_member(Scene const& scene) {
    bool const varies = std::ranges::any_of(scene.variations, [](Variation const& one) {
        return one.column != Variation::no_column || one.distribution.kind != Distribution::Kind::constant;
    });
    return member_count(scene) == 1 || (!varies && scene.study != StudyKind::sweep);
}

}  // namespace

double foreseen_check(Scene const& scene, std::optional<std::uint64_t> asked, std::uint64_t all) {
    if (asked == 0u || is_continued(scene)) return 0;
    std::vector<CheckMethod> const methods = check_methods(scene);
    double cost = 0;
    for (CheckMethod const& method : methods) cost += method.cost;
    double const of_a_member = cost / static_cast<double>(methods.size());
    if (is_one_member(scene)) return asked ? 1 + cost : 0;
    bool const stored = scene.stores_members();
    if (!stored && !runs_members_anew(asked, all)) return 0;
    auto const members = static_cast<double>(all);
    if (asked) return static_cast<double>(std::min(*asked, all)) * (of_a_member + (stored ? 0 : 1));
    double const room = MemberCheck::of_the_study * members;
    return room < 0.5 * MemberCheck::at_hand * methods.front().cost * least_members ? 0 : room;
}

Verification verify(ResultView const& results, Scene const& scene, Backend const& backend,
                    VerificationRequest const& request) {
    Verification v;
    v.settings = words_of(scene.integrator);
    auto const not_checked = [&](std::string const& why) {
        v.resolution = Resolution::not_checked;
        v.summary = "not checked against tighter tolerances: " + why;
        return v;
    };
    if (request.members == 0u) return not_checked("study.verify is 0");
    if (is_continued(scene)) return not_checked("columns of this sweep go on from one another");
    if (is_one_member(scene)) {
        if (!request.members) return not_checked("there is one member; run --verify compares its orbit");
        return verify_orbit(scene, backend, request);
    }
    std::optional<ToleranceMembers> stored;
    MemberCheck check(v, scene, backend, request);
    if (results.stores_members()) {
        stored.emplace(results, design_width(scene), member_count(scene));
        check.look_at(*stored);
    } else if (runs_members_anew(request.members, member_count(scene))) {
        check.run_some_anew();
    }
    if (!(check.total() > 0))
        return not_checked(stored ? "no member ran" : "members are not stored; run --verify does it");
    if (!check.compares()) return not_checked("the study has no number that is compared: ask for study.quantities");
    check.run();
    if (check.stopped()) return not_checked("the run was stopped");
    if (v.pairs.empty()) {
        bool const nobody = std::ranges::count(v.study.finished, 1) == 0;
        return not_checked(nobody ? "no member finished" : "a tenth of the study's work is not enough for six members; run --verify does it");
    }
    conclude(v, scene, request);
    return v;
}

}  // namespace slideway
