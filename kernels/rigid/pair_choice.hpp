#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_problem.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What two contacts may do, and under which conditions it is right.
template <class Real> struct PairQuestion {
    PairOf<Real> before;   // without forces in the contacts
    Real target[2];        // of the normal velocity or acceleration of a contact that pushes; one that does not may exceed it
    Mask<Real> present[2];
    Mask<Real> slips[2];   // already, and which way is known
    Real way[2];           // sign of its slip, if so
    Real kinetic, holding; // coefficients of friction of a contact that slips, and up to which one sticks

    /// Of contacts that are to come to rest along their normals, whose slip is not known, and which have one coefficient of friction.
    SLIDEWAY_FN static PairQuestion of(PairOf<Real> const& before, Mask<Real> front, Mask<Real> rear, Real coefficient) {
        Real const zero(0.0);
        auto const no = mask_of<Real>(false);
        return {before, {zero, zero}, {front, rear}, {no, no}, {zero, zero}, coefficient, coefficient};
    }
};

template <class Real> struct PairAnswer {
    ContactState<Real> state[2];
    PairOf<Real> force;
    Real violation;  // of the worst condition, in units of the question's motion; NaN where nothing is finite

    SLIDEWAY_FN Mask<Real> fits(Real scale) const { return violation <= Real(most_violation) * scale; }
};

/// Answers it by trying all states of both contacts in a fixed order, the least violation of the conditions winning and of equal ones
/// the first: a fixed amount of work that always ends.  Conditions, for γ after the forces and with N and T along the normal and the wall:
///   open: γ_N ≥ target;   closed: γ_N = target, N ≥ 0;   slip: T = −μ N sign(γ_T);   stick: γ_T = 0, |T| ≤ μ N.
/// That both stick is never tried: the forces would not be unique, and wherever that is right so is one sticking beside one whose slip is 0.
template <class Real> class PairChoice {
public:
    SLIDEWAY_HD PairChoice(ContactPair<Real> const& pair, PairQuestion<Real> const& question) : pair_(pair), question_(question) {
        auto const no = mask_of<Real>(false);
        for (auto& state : best_.state) state = {no, no, Real(0.0), Real(0.0)};
        best_.violation = Real(2e300);
        rounding_ = Real(most_violation) * question.before.size();
    }

    SLIDEWAY_HD PairAnswer<Real> answer(bool friction) {
        friction_ = friction;
        if (friction) {
            for (int i = 0; i < 4; ++i) {
                for (int j = 0; j < 4; ++j) {
                    if ((i != stick || j != stick) && any(unanswered())) attempt(i, j);
                }
            }
        } else {
            for (int i : {static_cast<int>(open), static_cast<int>(forwards)}) {
                for (int j : {static_cast<int>(open), static_cast<int>(forwards)}) attempt(i, j);
            }
        }
        return best_;
    }

private:
    enum Doing { open, forwards, backwards, stick };

    /// Lanes where a later state may still be better than the best so far.
    SLIDEWAY_FN Mask<Real> unanswered() const { return best_.violation > Real(0.0); }

    SLIDEWAY_FN ContactState<Real> state_of(int contact, int doing) const {
        auto const no = mask_of<Real>(false);
        auto const present = question_.present[contact];
        Real const zero(0.0);
        if (doing == open) return {no, no, zero, zero};
        if (doing == stick) return {present, present, zero, zero};
        Real const way = doing == forwards ? Real(1.0) : Real(-1.0);
        return {present, no, select(present, way, zero), select(present, way * question_.kinetic, zero)};
    }

    /// What should be 0 counts where it is more than rounding: forces of a nearly singular state are huge and fulfil nothing.
    SLIDEWAY_FN Real missed(Real rest) const { return select(abs(rest) <= rounding_, Real(0.0), abs(rest)); }

    /// By how much a contact breaks its conditions.  @param allowed whether the state is one that the question allows
    SLIDEWAY_FN Real broken(int contact, int doing, PairOf<Real> const& force, PairOf<Real> const& after) const {
        Real const zero(0.0), impossible(1e300);
        auto const& q = question_;
        Real const normal = force.normal[contact], along = force.along[contact];
        if (doing == open) return q.target[contact] - after.normal[contact];
        Real const pull = max(negated(normal) * pair_.nn[contact][contact], missed(after.normal[contact] - q.target[contact]));
        if (doing == stick) {
            Real const excess = max((abs(along) - q.holding * normal) * pair_.tt[contact][contact], missed(after.along[contact]));
            return select(q.slips[contact], impossible, max(pull, excess));
        }
        Real const way = doing == forwards ? Real(1.0) : Real(-1.0);
        Real const wrong = select(q.slips[contact], select(q.way[contact] == way, zero, impossible), negated(way * after.along[contact]));
        // Without friction there is but one slip, and no way of it.
        return friction_ ? max(pull, wrong) : pull;
    }

    SLIDEWAY_HD void attempt(int first, int second) {
        Real const zero(0.0), impossible(1e300);
        int const doing[2] = {first, second};
        ContactState<Real> const state[2] = {state_of(0, first), state_of(1, second)};
        auto const force = pair_.solve(question_.before, question_.target, state);
        auto const after = pair_.after(question_.before, force);
        Real violation(0.0);
        for (int i = 0; i < 2; ++i) {
            // Of an absent contact all states are alike, and the first of them counts.
            Real const own = select(question_.present[i], broken(i, doing[i], force, after), doing[i] == open ? zero : impossible);
            violation = max(own, violation);
            violation = select(own == own, violation, impossible);
        }
        auto const better = violation < best_.violation;
        best_.violation = select(better, violation, best_.violation);
        best_.force = select(better, force, best_.force);
        for (int i = 0; i < 2; ++i) best_.state[i] = select(better, state[i], best_.state[i]);
    }

    ContactPair<Real> const& pair_;
    PairQuestion<Real> const& question_;
    PairAnswer<Real> best_;
    bool friction_ = false;
    Real rounding_;  // of its motion
};

}  // namespace slideway::inline SLIDEWAY_ISA
