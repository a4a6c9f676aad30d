#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Records the impacts of rigid contacts, where a section asks for them: the state before an impact and the state after it, at one time.
/// What is known where they are settled need not be searched for: at a bounce a gap touches zero and never changes its sign.
template <class Model, class Real> struct ImpactRows {
    /// @param changed lanes whose contacts have been settled at the members' time and state  @param before their state before that
    SLIDEWAY_HD static void take(Pack<Model, Real>& pack, Results<Model>& results, Mask<Real> changed, Real const* before) {
        if constexpr (Model::has_crossings) {
            using Way = CrossingPlan::Direction;
            CrossingPlan const& plan = results.crossings();
            if (plan.room == 0 || !plan.of_impacts()) return;
            auto const& c = pack.state.course;
            auto const& books = pack.state.contacts.memory.books;
            Mask<Real> at = changed & (books.count > Real(0.0)) & results.records_at(pack.state, c.t, c.y);
            if (none(at)) return;
            if (plan.on != CrossingPlan::On::impacts) at = at & met(books.met, Model::met_bit(plan.on == CrossingPlan::On::impacts_z, plan.index));
            if (plan.wants(Way::falling)) results.take_crossing(pack, at, c.t, before);
            if (plan.wants(Way::rising)) results.take_crossing(pack, at, c.t, c.y);
        }
    }

private:
    /// Lanes whose number has a bit.
    SLIDEWAY_HD static Mask<Real> met(Real const& bits, int bit) {
        Real has(0.0);
        for (int i = 0; i < lanes<Real>; ++i) {
            if ((static_cast<unsigned>(lane(bits, i)) >> bit & 1u) != 0) set_lane(has, i, 1.0);
        }
        return has > Real(0.5);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
