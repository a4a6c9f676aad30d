#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
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

/// Beside those it counts how often contact with each face begins.
template <class Real> class ForceRecord : public SideRecord<Real, ToldForces> {
    using Base = SideRecord<Real, ToldForces>;

public:
    template <class Report> SLIDEWAY_FN void start(Mask<Real> fresh, Report const& r) {
        Base::start(fresh, r);
        for (int i = 0; i < face_count; ++i) {
            onsets_[i] = select(fresh, Real(0.0), onsets_[i]);
            touching_[i] = select(fresh, touches(r.contact.penetration[i]), touching_[i]);
        }
    }
    /// At the end of an accepted step, where contacts go by depths.
    template <class Report> SLIDEWAY_FN void see_faces(Mask<Real> accepted, Report const& r) {
        for (int i = 0; i < face_count; ++i) see_face(accepted, i, touches(r.contact.penetration[i]));
    }
    /// Where other contacts are held from here on.  @param held apices, of each face
    SLIDEWAY_FN void turn(Mask<Real> in, Quad<Real> const* held) {
        for (int i = 0; i < face_count; ++i) see_face(in, i, min(sum(held[i]), Real(1.0)));
    }

    /// Writes the selected quantities of one lane.  @param time [s] the member was integrated.
    SLIDEWAY_HD void finish(int index, double time, Selection selected, double* row) const {
        using enum Quantity;
        for (int i = 0; i < face_count; ++i) {
            this->put(selected, row, peak_face_force, i, this->peak(i, index));
            this->put(selected, row, peak_pressure, i, this->peak(ToldForces::pressures + i, index));
            this->put(selected, row, peak_pv, i, this->peak(ToldForces::products + i, index));
            this->put(selected, row, mean_pv, i, time > 0 ? this->integral(i, index) / time : 0.0);
            this->put(selected, row, face_onsets, i, lane(onsets_[i], index));
        }
        this->put(selected, row, peak_friction_force, 0, this->peak(ToldForces::vectors, index));
        this->put(selected, row, peak_rod_force, 0, this->peak(ToldForces::vectors + 1, index));
        this->put(selected, row, peak_crank_pin_force, 0, this->peak(ToldForces::vectors + 2, index));
    }

private:
    /// 1 where an apex touches, else 0.
    SLIDEWAY_FN static Real touches(Quad<Real> const& depth) { return select(largest(depth) > Real(0.0), Real(1.0), Real(0.0)); }
    SLIDEWAY_FN void see_face(Mask<Real> in, int face, Real touches) {
        onsets_[face] = onsets_[face] + slideway::count<Real>(in & (touches > touching_[face]));
        touching_[face] = select(in, touches, touching_[face]);
    }

    Real onsets_[face_count];
    Real touching_[face_count];  // 1 or 0, where the last step ended
};

}  // namespace slideway::inline SLIDEWAY_ISA
