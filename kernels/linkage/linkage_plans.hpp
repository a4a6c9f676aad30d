#pragma once

#include <algorithm>
#include <utility>

#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/loads/drive_plan.hpp"
#include "kernels/loads/load_list.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A plan that is looked up, and how kernels go through it.
struct PlanTable {
    static constexpr int most_coordinates = LinkagePlan::most_coordinates, most_loops = LinkagePlan::most_loops;
    LinkagePlan const* table = nullptr;

    explicit constexpr PlanTable(LinkagePlan const& plan) : table(&plan) {}
    SLIDEWAY_FN LinkagePlan const& operator*() const { return *table; }
    SLIDEWAY_FN LinkagePlan const* operator->() const { return table; }
    /// Whether the drive gives coordinate 0.
    SLIDEWAY_FN bool is_given(DrivePlan const& drive) const { return table->is_driven && !drive.turns_freely(); }
    /// Whether something acts beside weight, drive and joints.
    SLIDEWAY_FN static bool is_loaded(LoadList const& loads) { return loads.count > 0; }

    /// Has a function see 0 … count − 1, upwards or downwards.
    template <class See> SLIDEWAY_FN static void up(int count, See const& see) {
        for (int i = 0; i < count; ++i) see(i);
    }
    template <class See> SLIDEWAY_FN static void down(int count, See const& see) {
        for (int i = count - 1; i >= 0; --i) see(i);
    }
    /// Has it see a body and those that it hangs on, towards the ground.
    template <class See> SLIDEWAY_FN void bodies_from(int body, See const& see) const {
        for (; body != LinkageBody::ground; body = table->body[body].parent) see(body);
    }
    /// Has it see a coordinate and those towards the ground that are not below `first`.
    template <class See> SLIDEWAY_FN void coordinates_from(int coordinate, int first, See const& see) const {
        for (; coordinate >= first; coordinate = table->above[coordinate]) see(coordinate);
    }
};

/// A plan that the compiler knows: loops are written out, so that looking it up costs nothing.  The same sums in the same order as by PlanTable.
/// @tparam Source has a `static constexpr LinkagePlan plan`
template <class Source> struct PlanConstant {
    static constexpr int most_coordinates = Source::plan.coordinates, most_loops = Source::plan.loops();
    static constexpr int room = std::max({Source::plan.coordinates, Source::plan.bodies, Source::plan.closures, 2 * Source::plan.loops()});

    explicit constexpr PlanConstant(LinkagePlan const&) {}
    SLIDEWAY_FN constexpr LinkagePlan const& operator*() const { return Source::plan; }
    SLIDEWAY_FN constexpr LinkagePlan const* operator->() const { return &Source::plan; }
    SLIDEWAY_FN static constexpr bool is_given(DrivePlan const&) { return Source::plan.is_driven && !Source::plan.turns_freely; }
    SLIDEWAY_FN static constexpr bool is_loaded(LoadList const&) { return Source::plan.is_loaded; }

    template <class See> SLIDEWAY_FN static void up(int count, See const& see) {
        [&]<int... i>(std::integer_sequence<int, i...>) SLIDEWAY_INLINED { ((i < count ? see(i) : void()), ...); }(std::make_integer_sequence<int, room>());
    }
    template <class See> SLIDEWAY_FN static void down(int count, See const& see) {
        [&]<int... i>(std::integer_sequence<int, i...>) SLIDEWAY_INLINED {
            ((room - 1 - i < count ? see(room - 1 - i) : void()), ...);
        }(std::make_integer_sequence<int, room>());
    }
    template <class See> SLIDEWAY_FN static void bodies_from(int body, See const& see) {
        down(Source::plan.bodies, [&](int i) SLIDEWAY_INLINED {
            if (i != body) return;
            see(i);
            body = Source::plan.body[i].parent;
        });
    }
    template <class See> SLIDEWAY_FN static void coordinates_from(int coordinate, int first, See const& see) {
        down(Source::plan.coordinates, [&](int i) SLIDEWAY_INLINED {
            if (i != coordinate || i < first) return;
            see(i);
            coordinate = Source::plan.above[i];
        });
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
