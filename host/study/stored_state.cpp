#include "host/study/stored_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/config/descriptors.hpp"
#include "host/store/result_layout.hpp"
#include "host/study/series_file.hpp"

namespace slideway {
namespace {

/// The stored states of one member, of which one is taken.
class MemberStates {
public:
    MemberStates(ResultView const& results, Mechanism mechanism, std::uint64_t place) : results_(results), mechanism_(info(mechanism)), place_(place) {}

    /// Takes what is nearer in time than what there is; a state with a NaN, behind a failure, is none.
    void look(std::string_view of, double wanted) {
        if (of == "end") offer(of, wanted, results_.rows("end_time", place_, 1)[0], [&](std::string const& name) { return results_.rows("final_" + name, place_, 1)[0]; });
        if (of == "sample") look_at_samples(wanted);
        if (of == "section") look_at_sections(wanted);
    }
    StoredState const& nearest() const { return nearest_; }
    bool found() const { return std::isfinite(distance_); }

private:
    std::string name(int i) const { return state_info(mechanism_, i).name; }
    bool has_all(std::string const& prefix) const {
        for (int i = 0; i < mechanism_.states; ++i) {
            if (!results_.has(prefix + name(i))) return false;
        }
        return true;
    }

    template <class Of> void offer(std::string_view of, double wanted, double time, Of const& value) {
        double const distance = std::abs(time - wanted);
        if (!(distance < distance_)) return;
        std::vector<double> numbers;
        for (int i = 0; i < mechanism_.states; ++i) numbers.push_back(value(name(i)));
        if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) return;
        distance_ = distance;
        nearest_.time = time, nearest_.of = of, nearest_.numbers = std::move(numbers);
    }

    void look_at_samples(double wanted) {
        if (!results_.has("time") || !has_all("")) return;
        std::vector<std::vector<double>> columns;
        for (int i = 0; i < mechanism_.states; ++i) columns.push_back(results_.rows(name(i), place_, 1));
        std::vector<double> const times = results_.has("turned") ? results_.rows("time", place_, 1) : results_.values("time");
        for (std::size_t k = 0; k < times.size(); ++k) {
            std::size_t i = 0;
            offer("sample", wanted, times[k], [&](std::string const&) { return columns[i++].at(k); });
        }
    }

    void look_at_sections(double wanted) {
        if (!results_.has("section_count") || !has_all("section_")) return;
        std::vector<double> const counts = results_.values("section_count");
        std::size_t first = 0;
        for (std::size_t i = 0; i < place_; ++i) first += count_of(counts.at(i));
        std::size_t const count = count_of(counts.at(place_));
        if (count == 0) return;
        std::vector<double> const times = results_.rows("section_time", first, count);
        for (std::size_t k = 0; k < count; ++k)
            offer("section", wanted, times[k], [&](std::string const& state) { return results_.rows("section_" + state, first + k, 1)[0]; });
    }

    ResultView const& results_;
    MechanismInfo const& mechanism_;
    std::uint64_t place_;
    double distance_ = std::numeric_limits<double>::infinity();
    StoredState nearest_{};
};

}  // namespace

StoredState stored_state(ResultView const& results, Mechanism mechanism, std::optional<std::uint64_t> member, std::optional<double> time) {
    if (!results.stores_members()) {
        throw SceneError(fmt::format("{}: keeps statistics, no states of members; run one with --member K --set study.store=members", results.path()));
    }
    std::uint64_t const place = member_place(results, member);
    MemberStates states(results, mechanism, place);
    // Where a sample is at the end, or a section, both are the same state.
    for (std::string_view const of : {"end", "sample", "section"}) {
        if (time || of == "end") states.look(of, time.value_or(results.rows("end_time", place, 1)[0]));
    }
    StoredState state = states.nearest();
    state.member = count_of(results.rows("member", place, 1)[0]);
    if (states.found()) return state;
    throw SceneError(fmt::format("{}: has no state of member {}, which ended as {}{}", results.path(), state.member,
                                 name_of(status_of(results.rows("status", place, 1)[0])), time ? "" : "; ask for an earlier one with --time"));
}

void take_member(Scene& scene, ResultView const& results, std::uint64_t member) {
    std::uint64_t const place = member_place(results, member);
    std::vector<Key const*> keys;
    if (scene.study == StudyKind::sweep) keys.push_back(scene.chaos.parameter);
    for (Variation const& variation : scene.variations) keys.push_back(variation.key);
    for (Key const* const key : keys) key->set(scene.inputs, results.rows(variable_name(key->name), place, 1)[0]);
}

}  // namespace slideway
