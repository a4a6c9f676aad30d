#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which of a model's reports a block needs.
struct ReportNeeds {
    bool quantities = false;     // the observer is at work
    bool stages = false;         // at every stage, for integrals
    bool accelerations = false;  // their record is at work
    bool forces = false;         // that of forces is
    bool peaks = false;          // inside of steps too
    bool powers_alone = false;   // which are the energy audit's alone
    bool audit = false;          // the audit's integrals meet the tolerance too
    bool loads = false;          // there are some, whose works are the last of these integrals
    bool switches = false;       // the law does: the audit keeps books of it
    Watching watching = Watching::nothing;
    bool ends = false;  // at the accepted steps

    SLIDEWAY_HD bool watch() const { return watching != Watching::nothing; }
    /// Whether an event ends a step that has been made.
    SLIDEWAY_HD bool cuts() const { return watch() && watching != Watching::gaps; }

    template <class Model, class Real>
    SLIDEWAY_HD static ReportNeeds of(Model const& model, Selection quantities, IntegratorSettings const& settings) {
        using Observer = typename Model::template Observer<Real>;
        using Accelerations = typename AccelerationsOf<Model, Real>::Type;
        using Forces = typename ForcesOf<Model, Real>::Type;
        ReportNeeds needs;
        needs.quantities = quantities != 0;
        needs.accelerations = (quantities & Accelerations::quantities) != 0;
        needs.forces = (quantities & Forces::quantities) != 0;
        needs.stages = Observer::needs_stages(quantities) || Accelerations::needs_stages(quantities) || Forces::needs_stages(quantities);
        needs.peaks = Observer::needs_peaks(quantities) || Accelerations::needs_peaks(quantities) || Forces::needs_peaks(quantities);
        needs.audit = Observer::audits(quantities);
        needs.loads = model.has_loads();
        needs.powers_alone = needs.stages && !needs.accelerations && !needs.forces && !Observer::integrates_more(quantities);
        needs.watching = model.watching(settings.locate_modes, Model::has_shadows);
        if (HasClocks<Model> && settings.method == Method::verner65) needs.watching = Watching::clocks;
        // Contacts are held by steps that may end where they change.
        if (holds_contacts(needs.watching) && settings.method != Method::automatic && !is_explicit_pair(settings.method)) needs.watching = Watching::nothing;
        needs.switches = model.switches();
        needs.ends = needs.stages || Observer::needs_reports(quantities) || needs.watch();
        return needs;
    }

    /// Nobody observes a shadow, and one with rigid contacts has no events of its own.
    template <class Model> SLIDEWAY_HD ReportNeeds of_shadows() const {
        ReportNeeds needs;
        needs.watching = watching;
        needs.ends = cuts() && !IsRigid<Model>;
        return needs;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
