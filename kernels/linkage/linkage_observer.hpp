#pragma once

#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/linkage/linkage_report.hpp"
#include "kernels/observers/slider_observer.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The quantities of linkages, and behind them the work of each load, spring and stop on the bodies: integrals that count where one of them is asked for.
template <class Real> class LinkageObserver : public SliderObserver<Real, LinkageReport> {
    using Base = SliderObserver<Real, LinkageReport>;
    static constexpr int most = LinkagePlan::most_loads;
    static constexpr Selection works = ((Selection{1} << most) - 1) << quantity_count;

public:
    static constexpr int columns = Base::columns + most, integrals = Base::integrals + most;

    SLIDEWAY_HD static constexpr bool needs_stages(Selection q) { return Base::needs_stages(q) || (q & works) != 0; }
    SLIDEWAY_HD static constexpr bool integrates_more(Selection q) { return Base::integrates_more(q) || (q & works) != 0; }

    SLIDEWAY_FN static void integrands(LinkageReport<Real> const& r, Real* values) {
        Base::integrands(r, values);
        for (int i = 0; i < most; ++i) values[Base::integrals + i] = r.load[i].power;
    }

    SLIDEWAY_FN void start(Mask<Real> fresh, LinkageReport<Real> const& r, Real const* state, bool switches) {
        Base::start(fresh, r, state, switches);
        for (auto& one : work_) one = select(fresh, Real(0.0), one);
    }

    SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Real const* integral, LinkageReport<Real> const& r, Real const* state, bool switches) {
        Base::accept(accepted, h, integral, r, state, switches);
        for (int i = 0; i < most; ++i) work_[i] = select(accepted, fma(h, integral[Base::integrals + i], work_[i]), work_[i]);
    }

    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        Base::finish(index, time, selected, row);
        for (int i = 0; i < most; ++i) {
            if ((selected >> (quantity_count + i) & 1u) != 0) row[Base::columns + i] = lane(work_[i], index);
        }
    }

private:
    Real work_[most];
};

}  // namespace slideway::inline SLIDEWAY_ISA
