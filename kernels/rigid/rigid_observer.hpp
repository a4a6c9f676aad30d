#pragma once

#include <type_traits>

#include "kernels/lanes/model.hpp"
#include "kernels/observers/energy_audit.hpp"
#include "kernels/observers/onset_counts.hpp"
#include "kernels/observers/slider_observer.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What is alike in the lanes of all mechanisms with rigid contacts.
template <class Base> struct RigidLanes : Base, ModelDefaults {
    static constexpr int series = series_count;
    static constexpr bool has_contacts = true, is_rigid = true, has_shadows = false, has_crossings = true, has_linearisation = false;
    static constexpr bool switches() { return false; }
    static constexpr Watching watching(bool, bool) { return Watching::touches; }
    template <class Real, class Parameters>
    SLIDEWAY_HD static Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, Parameters const& p) {
        return slideway::left_stable_range(audit, Base::energy_scale(p));
    }
};

/// The quantities of a mechanism with rigid contacts: what impacts do is no integral over time, and booked by itself.
/// @tparam Report_ RigidPlanarReport or RigidSliderReport  @tparam of_faces it counts impacts of the faces, too
template <class Real, template <class> class Report_, bool of_faces = false> class RigidObserver : public SliderObserver<Real, Report_> {
public:
    using Report = Report_<Real>;

    SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r, Real const* state, bool switches) {
        Base::start(fresh, r, state, switches);
        owed_ = select(fresh, Real(0.0), owed_);
        capped_ = select(fresh, Real(0.0), capped_);
        if constexpr (of_faces) onsets_of_.start(fresh);
    }
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        Base::finish(index, time, selected, row);
        if (selects(selected, Quantity::capped_impacts)) row[quantity_column(Quantity::capped_impacts)] = lane(capped_, index);
        if constexpr (of_faces) onsets_of_.finish(index, selected, row);
    }

    SLIDEWAY_FN void accept(Mask<Real> accepted, Real h, Real const* integral, Report const& r, Real const* state, bool switches) {
        Real const before = this->mode_, zero(0.0);
        Base::accept(accepted, h, integral, r, state, switches);
        // Bounces that were ended would have gone on for a while: that part of the step was flight.
        Real const flight = select(accepted, min(owed_, h), zero), half = Real(0.5) * flight;
        owed_ = owed_ - flight;
        this->mode_time_[0] = this->mode_time_[0] + flight;
        for (int i = 0; i < 4; ++i) {
            Real const number(static_cast<double>(i));
            auto const share = [&](Real mode) { return select(mode == number, half, zero); };
            this->mode_time_[i] = this->mode_time_[i] - (share(before) + share(this->mode_));
        }
    }

    /// After an event.
    SLIDEWAY_FN void switch_over(Mask<Real> in, Report const& r, bool switches) {
        auto const& books = r.contact.books;
        book(in, books);
        // As of compliant contacts: from free flight, however many corners meet their walls.
        this->onsets_ = this->onsets_ + slideway::count<Real>(in & (books.count > Real(0.0)) & (this->mode_ == Real(0.0)));
        if constexpr (of_faces) {
            for (int face = 0; face < face_count; ++face) onsets_of_.add(in & (books.speed[face] > Real(0.0)), face, books.speed[face]);
        }
        this->mode_ = select(in, this->mode_class(r), this->mode_);
        owed_ = select(in & (books.count > Real(0.0)), books.flight, owed_);
        this->resume(in, r, switches);
    }

    /// Of a step that is about to be accepted and has the impulses in it: what they make of the energy is not the method's.
    SLIDEWAY_FN void take_impulses(Mask<Real> in, Report const& r) {
        auto const& books = r.contact.books;
        book(in, books);
        this->energy_ = select(in, this->energy_ + (books.work - books.friction - books.damping), this->energy_);
    }

private:
    using Base = SliderObserver<Real, Report_>;

    SLIDEWAY_FN void book(Mask<Real> in, ImpactBooks<Real> const& books) {
        using enum Quantity;
        auto const add = [&](Real& account, Real amount) { account = select(in, account + amount, account); };
        add(this->integral_[Base::template place_of<drive_work>], books.work);
        add(this->integral_[Base::template place_of<friction_loss>], books.friction);
        add(this->integral_[Base::template place_of<damping_loss>], books.damping);
        add(this->integral_[Base::template place_of<mean_normal_force>], books.impulse);
        add(capped_, books.capped);
    }

    Real owed_;    // flight that is still to come [s]
    Real capped_;  // impacts whose energy was bounded
    struct Nothing {};
    [[no_unique_address]] std::conditional_t<of_faces, OnsetCounts<Real>, Nothing> onsets_of_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
