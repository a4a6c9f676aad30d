#pragma once

#include "kernels/observers/slider_observer.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_planar_report.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The quantities of a mechanism with rigid contacts: what impacts do is no integral over time, and booked by itself.
template <class Real> class RigidObserver : public SliderObserver<Real, RigidPlanarReport> {
public:
    using Report = RigidPlanarReport<Real>;

    /// After an event.
    SLIDEWAY_FN void switch_over(Mask<Real> in, Report const& r, bool switches) {
        using enum Quantity;
        auto const& books = r.contact.books;
        auto const book = [in](Real& account, Real amount) { account = select(in, account + amount, account); };
        book(this->integral_[Places::template integral_of<crank_work>], books.work);
        book(this->integral_[Places::template integral_of<friction_loss>], books.friction);
        book(this->integral_[Places::template integral_of<damping_loss>], books.damping);
        book(this->integral_[Places::template integral_of<mean_normal_force>], books.impulse);
        book(this->onsets_, books.count);
        this->mode_ = select(in, this->mode_class(r), this->mode_);
        // Bounces that would have gone on are over at once for the state; their time is theirs.
        book(this->mode_time_[0], books.flight);
        for (int i = 1; i < 4; ++i) {
            book(this->mode_time_[i], select(this->mode_ == Real(static_cast<double>(i)), negated(books.flight), Real(0.0)));
        }
        this->resume(in, r, switches);
    }

private:
    using Places = typename SliderObserver<Real, RigidPlanarReport>::Places;
};

}  // namespace slideway::inline SLIDEWAY_ISA
