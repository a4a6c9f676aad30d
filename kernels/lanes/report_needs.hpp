#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Whether an observer can do with the powers of the energy audit, where nothing else is asked for that is integrated.
template <class Observer> inline constexpr bool integrates_powers = requires { Observer::powers; };

/// Whether an observer keeps peaks that are looked for inside of steps too (PeakSearch).
template <class Observer> inline constexpr bool keeps_peaks = requires { Observer::peaks; };

/// Which of a model's reports a block needs.
struct ReportNeeds {
    bool quantities = false;     // the observer is at work
    bool stages = false;         // at every stage, for integrals
    bool accelerations = false;  // their record is at work
    bool peaks = false;          // inside of steps too
    bool powers_alone = false;   // which are the energy audit's alone
    bool audit = false;          // the audit's integrals meet the tolerance too
    bool switches = false;       // the law does: the audit keeps books of it
    Watching watching = Watching::nothing;
    bool ends = false;  // at the accepted steps

    SLIDEWAY_HD bool watch() const { return watching != Watching::nothing; }
    /// Whether an event ends a step that has been made.
    SLIDEWAY_HD bool cuts() const { return watch() && watching != Watching::gaps; }

    template <class Model, class Real>
    SLIDEWAY_HD static ReportNeeds of(Model const& model, Selection quantities, IntegratorSettings const& settings) {
        using Observer = typename Model::template Observer<Real>;
        ReportNeeds needs;
        needs.quantities = quantities != 0;
        needs.stages = Observer::needs_stages(quantities);
        if constexpr (HasAccelerations<Model>) {
            using Accelerations = typename Model::template Accelerations<Real>;
            needs.accelerations = (quantities & Accelerations::quantities) != 0;
            needs.stages = needs.stages || Accelerations::needs_stages(quantities);
        }
        if constexpr (keeps_peaks<Observer>) needs.peaks = Observer::needs_peaks(quantities);
        if constexpr (HasAccelerations<Model>) {
            needs.peaks = needs.peaks || Model::template Accelerations<Real>::needs_peaks(quantities);
        }
        needs.audit = Observer::audits(quantities);
        if constexpr (integrates_powers<Observer>) {
            needs.powers_alone = needs.stages && !needs.accelerations && !Observer::integrates_more(quantities);
        }
        if constexpr (Model::has_contacts) {
            needs.watching = model.watching(settings.locate_modes, Model::has_shadows);
            if (HasClocks<Model> && settings.method == Method::verner65) needs.watching = Watching::impacts;
            needs.switches = model.switches();
        }
        needs.ends = needs.stages || Observer::needs_reports(quantities) || needs.watch();
        return needs;
    }

    /// Nobody observes a shadow, and one with rigid contacts has no events of its own.
    template <class Model> SLIDEWAY_HD ReportNeeds of_shadows() const {
        ReportNeeds needs;
        needs.watching = watching;
        needs.ends = cuts() && !HasImpacts<Model>;
        return needs;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
