#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/observers/onset_counts.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/observers/side_record.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of each face its normal force, pressure and p·v, of which the last is integrated, too; magnitudes of friction and of the forces at the rod's ends.
struct ToldForces {
    static constexpr Keeper keeper = Keeper::forces;
    static constexpr int integrals = face_count, pressures = face_count, products = 2 * face_count, vectors = 3 * face_count, peaks = vectors + 3;

    template <class Real, class Report> SLIDEWAY_FN static void tell_peaks(Report const& r, Real* values) {
        auto const& forces = r.forces;
        for (int i = 0; i < face_count; ++i) {
            values[i] = forces.force[i];
            values[pressures + i] = forces.pressure[i];
            values[products + i] = forces.pv[i];
        }
        Real* magnitude = values + vectors;
        for (auto const* v : {&forces.friction, &forces.rod, &forces.crank_pin}) *magnitude++ = sqrt(dot(*v, *v));
    }
    template <class Real, class Report> SLIDEWAY_FN static void integrands(Report const& r, Real* values) {
        for (int i = 0; i < face_count; ++i) values[i] = r.forces.pv[i];
    }
};

/// Beside those it counts how often contact with each face begins, and how fast the slider comes.
template <class Real> class ForceRecord : public SideRecord<Real, ToldForces> {
    using Base = SideRecord<Real, ToldForces>;

public:
    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r) {
        Base::start(fresh, r);
        onsets_.start(fresh);
        for (int i = 0; i < face_count; ++i) {
            touching_[i] = select(fresh, touches(r.contact.penetration[i]), touching_[i]);
        }
        stand(fresh, r);
    }
    /// At the end of an accepted step, where contacts go by depths.  @param step its length [s]
    template <class Report> SLIDEWAY_FN void see_faces(Mask<Real> accepted, Real step, Report const& r) {
        for (int i = 0; i < face_count; ++i) {
            auto const begins = see_face(accepted, i, touches(r.contact.penetration[i]));
            if (any(begins)) onsets_.add(begins, i, speed_of_touch(i, step, r.contact.penetration[i], r.forces.approach[i]));
        }
        stand(accepted, r);
    }
    /// Where other contacts are held from here on.  @param held apices, of each face  @param r where they turn
    template <class Report> SLIDEWAY_FN void turn(Mask<Real> in, Quad<Real> const* held, Report const& r) {
        for (int i = 0; i < face_count; ++i) {
            auto const begins = see_face(in, i, min(sum(held[i]), Real(1.0)));
            if (none(begins)) continue;
            Real fastest(0.0);
            each_of_four([&](Real const& is_held, Real const& rate) { fastest = max(fastest, is_held * rate); }, held[i], r.forces.approach[i]);
            onsets_.add(begins, i, fastest);
        }
    }

    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        using enum Quantity;
        for (int i = 0; i < face_count; ++i) {
            this->put(selected, row, peak_face_force, i, this->peak(i, index));
            this->put(selected, row, peak_pressure, i, this->peak(ToldForces::pressures + i, index));
            this->put(selected, row, peak_pv, i, this->peak(ToldForces::products + i, index));
            this->put(selected, row, mean_pv, i, time > 0 ? this->integral(i, index) / time : 0.0);
        }
        onsets_.finish(index, selected, row);
        this->put(selected, row, peak_friction_force, 0, this->peak(ToldForces::vectors, index));
        this->put(selected, row, peak_rod_force, 0, this->peak(ToldForces::vectors + 1, index));
        this->put(selected, row, peak_crank_pin_force, 0, this->peak(ToldForces::vectors + 2, index));
    }

private:
    /// 1 where an apex touches, else 0.
    SLIDEWAY_FN static Real touches(Quad<Real> const& depth) { return select(largest(depth) > Real(0.0), Real(1.0), Real(0.0)); }
    /// @return lanes in which contact begins
    SLIDEWAY_FN Mask<Real> see_face(Mask<Real> in, int face, Real touches) {
        auto const begins = in & (touches > touching_[face]);
        touching_[face] = select(in, touches, touching_[face]);
        return begins;
    }
    /// What the next step starts from.
    template <class Report> SLIDEWAY_FN void stand(Mask<Real> in, Report const& r) {
        for (int i = 0; i < face_count; ++i) {
            depth_[i] = select(in, r.contact.penetration[i], depth_[i]);
            approach_[i] = select(in, r.forces.approach[i], approach_[i]);
        }
    }
    /// δ' where the apex that is deepest at the end of the step came to its face, by the cubic through both ends' depths and rates.
    SLIDEWAY_FN Real speed_of_touch(int face, Real step, Quad<Real> const& depth, Quad<Real> const& approach) const {
        Real d0(-1.0), v0(0.0), d1(-1.0), v1(0.0);
        auto const take = [&](Real const& d, Real const& v, Real const& at_end, Real const& v_at_end) {
            auto const deeper = at_end > d1;
            d0 = select(deeper, d, d0), v0 = select(deeper, v, v0), d1 = select(deeper, at_end, d1), v1 = select(deeper, v_at_end, v1);
        };
        each_of_four(take, depth_[face], approach_[face], depth, approach);
        Real const s0 = step * v0, s1 = step * v1, change = d1 - d0, three(3.0), half(0.5);
        Real const square = fms(three, change, s0 + (s0 + s1)), cube = fnma(Real(2.0), change, s0 + s1);
        Real low(0.0), high(1.0);
        for (int halvings = 0; halvings < 40; ++halvings) {
            Real const middle = half * (low + high);
            auto const is_deep = fma(middle, fma(middle, fma(middle, cube, square), s0), d0) > Real(0.0);
            low = select(is_deep, low, middle), high = select(is_deep, middle, high);
        }
        return fma(high, fma(high, three * cube, square + square), s0) / step;
    }

    OnsetCounts<Real> onsets_;
    Real touching_[face_count];                              // 1 or 0, where the last step ended
    Quad<Real> depth_[face_count], approach_[face_count];  // there
};

}  // namespace slideway::inline SLIDEWAY_ISA
