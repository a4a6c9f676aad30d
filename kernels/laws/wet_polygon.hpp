// The part of a rectangular face that lies below its wall, and its moments in closed form.
#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// level + along ξ + across η over ξ (along), η (across) in [−1, 1]: the depth of a flat face, or its rate.
template <class Real> struct Plane { Real level, along, across; };

// Moments of what is wet: a number for each product ξⁱηʲ, named by ij.
/// Of a load: its shares by the bilinear weights of the apices need these.
template <class Real> struct LoadMoments { Real of_00, of_10, of_01, of_11; };
/// Shares of a load that follows a plane need these.
template <class Real> struct Moments : LoadMoments<Real> { Real of_20, of_02, of_21, of_12; };
/// Shares of a load that follows the product of two planes need these beside.
template <class Real> struct HigherMoments { Real of_30, of_03, of_31, of_13, of_22; };

/// Where the depth δ = m + pξ + qη of a face is above zero, seen with its axes turned and exchanged so that its slopes are P ≥ Q ≥ 0: the
/// apices then have depths d1 ≥ d2 ≥ d3 ≥ d4, the first at (1, 1).  What is wet is all but a corner at (−1, −1) (d3 ≥ 0), a corner at (1, 1)
/// or nothing (d2 < 0), or a strip between.  Lengths come from the depths of the apices beside them, where no difference cancels: what
/// a corner carries that is in by 1e-12 m has all its digits.  Source: model.md 4.
template <class Real> class WetPolygon {
public:
    SLIDEWAY_FN explicit WetPolygon(Quad<Real> const& depth) {
        Real const zero(0.0), quarter(0.25);
        Real const high_ac = max(depth.a, depth.c), high_bd = max(depth.b, depth.d);
        Real const low_ac = min(depth.a, depth.c), low_bd = min(depth.b, depth.d);
        Real const d1 = max(high_ac, high_bd), d2 = min(high_ac, high_bd), d3 = max(low_ac, low_bd), d4 = min(low_ac, low_bd);
        full_ = d3 >= zero;
        turn(depth);
        level_ = quarter * ((depth.a + depth.c) + (depth.b + depth.d));
        strip_ = (d2 >= zero) & (d3 < zero);
        cut_ = max(select(full_, negated(d4), d1), zero);
        set_lengths(d1, d2, select(full_, d2, negated(d3)), select(full_, d3, negated(d2)));
    }

    /// Λ = ¼∫∫ δ₊² dξdη [m²].
    SLIDEWAY_FN Real squares() const {
        Real const whole = fma(level_, level_, Real(1.0 / 3) * fma(slope_p_, slope_p_, slope_q_ * slope_q_));
        Real const corner = Real(0.5) * cut_ * corner_volume();
        Real const strip = (strip_p_ * strip_p_) * width_ * fma(width_, width_, skew_ * skew_) * Real(1.0 / 6);
        return select(strip_, strip, select(full_, whole - corner, corner));
    }

    /// L_ij = ¼∫∫ ξⁱηʲ δ₊ dξdη [m].
    SLIDEWAY_FN Moments<Real> volumes() const { return chosen(corner_volumes(), strip_volumes()); }

    /// S_ij = ¼∫∫ ξⁱηʲ dξdη over what is wet: ∂L_ij/∂m.
    SLIDEWAY_FN Moments<Real> areas() const { return chosen(corner_areas(), strip_areas()); }
    SLIDEWAY_FN HigherMoments<Real> higher_areas() const {
        auto const c = higher_corner_areas();
        auto const s = higher_strip_areas();
        return {select(strip_, s.of_30, c.of_30), select(strip_, s.of_03, c.of_03), select(strip_, s.of_31, c.of_31),
                select(strip_, s.of_13, c.of_13), select(strip_, s.of_22, c.of_22)};
    }

    /// A plane over the face, as it is seen here.
    SLIDEWAY_FN Plane<Real> seen(Plane<Real> const& of) const {
        return {of.level, sign_p_ * select(exchanged_, of.across, of.along), sign_q_ * select(exchanged_, of.along, of.across)};
    }
    /// And back: moments as the face has them.
    SLIDEWAY_FN LoadMoments<Real> of_face(LoadMoments<Real> const& m) const {
        Real const of_10 = sign_p_ * m.of_10, of_01 = sign_q_ * m.of_01;
        return {m.of_00, select(exchanged_, of_01, of_10), select(exchanged_, of_10, of_01), (sign_p_ * sign_q_) * m.of_11};
    }
    SLIDEWAY_FN Moments<Real> of_face(Moments<Real> const& m) const {
        Real const of_21 = sign_q_ * m.of_21, of_12 = sign_p_ * m.of_12;
        LoadMoments<Real> const& load = m;
        return {of_face(load), select(exchanged_, m.of_02, m.of_20), select(exchanged_, m.of_20, m.of_02), select(exchanged_, of_12, of_21),
                select(exchanged_, of_21, of_12)};
    }

private:
    SLIDEWAY_FN void turn(Quad<Real> const& depth) {
        Real const zero(0.0), plus(1.0), minus(-1.0), quarter(0.25);
        Real const ac = depth.a - depth.c, bd = depth.b - depth.d;  // 2(p + q), 2(p − q)
        Real const p = ac + bd, q = ac - bd;
        exchanged_ = abs(q) > abs(p);
        Mask<Real> const falls = select(exchanged_, q, p) < zero;
        sign_p_ = select(falls, minus, plus);
        slope_p_ = quarter * max(abs(p), abs(q));
        slope_q_ = quarter * min(abs(p), abs(q));
        // The sign of Q is that of an exact difference: of the two deepest apices, or of the two others where more than these are wet.
        Mask<Real> const is_a = (falls & full_) | negation(falls | full_);
        Real const beside_c = select(exchanged_, depth.d, depth.b), beside_a = select(exchanged_, depth.b, depth.d);
        sign_q_ = select(select(is_a, depth.a, beside_a) < select(is_a, beside_c, depth.c), minus, plus);
    }
    /// @param beyond_p how far the neighbours of the corner are from its plane's zero, on the other side
    SLIDEWAY_FN void set_lengths(Real d1, Real d2, Real beyond_p, Real beyond_q) {
        Real const zero(0.0), one(1.0), least(1e-150);  // what a lane has no use for stays finite
        Real const fall_p = max(cut_ + beyond_p, least), fall_q = max(cut_ + beyond_q, least);  // 2P, 2Q
        Real const both = one / (fall_p * fall_q);
        Real const by_p = both * fall_q, by_q = both * fall_p;
        corner_p_ = min(cut_ * by_p, one);
        corner_q_ = min(cut_ * by_q, one);
        strip_p_ = Real(0.5) * fall_p;
        width_ = min(max((d1 + d2) * by_p, zero), Real(2.0));
        skew_ = min((d1 - d2) * by_p, one);
    }

    SLIDEWAY_FN Moments<Real> chosen(Moments<Real> const& corner, Moments<Real> const& strip) const {
        return {{select(strip_, strip.of_00, corner.of_00), select(strip_, strip.of_10, corner.of_10),
                 select(strip_, strip.of_01, corner.of_01), select(strip_, strip.of_11, corner.of_11)},
                select(strip_, strip.of_20, corner.of_20), select(strip_, strip.of_02, corner.of_02),
                select(strip_, strip.of_21, corner.of_21), select(strip_, strip.of_12, corner.of_12)};
    }

    // ---- a corner with edges 2t and 2s of the face's, or all but that corner ----

    SLIDEWAY_FN Real corner_volume() const { return (cut_ * corner_p_) * (corner_q_ * Real(1.0 / 6)); }

    SLIDEWAY_FN Moments<Real> corner_volumes() const {
        Real const one(1.0), half(0.5), zero(0.0), third(1.0 / 3), ninth(1.0 / 9), t = corner_p_, s = corner_q_;
        Real const v = corner_volume(), odd = select(full_, negated(v), v), ts = t * s;
        Real const level = select(full_, level_, zero), p = select(full_, slope_p_, zero), q = select(full_, slope_q_, zero);
        Real const of_t = fma(fms(Real(0.4), t, one), t, one), of_s = fma(fms(Real(0.4), s, one), s, one);  // 1 − t + 2t²/5
        Real const bend_t = fnma(Real(1.0 / 3), t, one), bend_s = fnma(Real(1.0 / 3), s, one);
        Real const mixed = Real(0.4) * ts;
        return {{level + v, fma(odd, fnma(half, t, one), third * p), fma(odd, fnma(half, s, one), third * q),
                 v * fma(Real(0.2), ts, fnma(half, t + s, one))},
                fma(v, of_t, third * level),
                fma(v, of_s, third * level),
                fma(odd, fma(mixed, bend_t, fnma(half, s, of_t)), ninth * q),
                fma(odd, fma(mixed, bend_s, fnma(half, t, of_s)), ninth * p)};
    }
    SLIDEWAY_FN Moments<Real> corner_areas() const {
        Real const one(1.0), zero(0.0), third(1.0 / 3), t = corner_p_, s = corner_q_, ts = t * s;
        Real const area = Real(0.5) * ts, even = select(full_, negated(area), area);
        Real const all = select(full_, one, zero), all_squares = select(full_, third, zero);
        Real const two_thirds(2.0 / 3);
        Real const of_t = fma(two_thirds * t, t - Real(2.0), one), of_s = fma(two_thirds * s, s - Real(2.0), one);
        Real const bend_t = fnma(Real(0.4), t, one), bend_s = fnma(Real(0.4), s, one);
        return {{all + even, area * fnma(two_thirds, t, one), area * fnma(two_thirds, s, one),
                 even * fma(third, ts, fnma(two_thirds, t + s, one))},
                fma(even, of_t, all_squares),
                fma(even, of_s, all_squares),
                area * (fma(two_thirds * ts, bend_t, fnma(two_thirds, s, of_t))),
                area * (fma(two_thirds * ts, bend_s, fnma(two_thirds, t, of_s)))};
    }
    SLIDEWAY_FN HigherMoments<Real> higher_corner_areas() const {
        Real const one(1.0), two_thirds(2.0 / 3), t = corner_p_, s = corner_q_, ts = t * s, area = Real(0.5) * ts;
        Real const even = select(full_, negated(area), area);
        auto const cube = [&](Real x) { return fma(Real(2.0) * x, fma(x, fnma(Real(0.4), x, one), Real(-1.0)), one); };  // 1 − 2x + 2x² − 4x³/5
        auto const bent = [&](Real x) { return fma(x, fms(Real(4.0 / 15), x, Real(0.8)), one); };
        auto const square = [&](Real x) { return fma(two_thirds * x, x - Real(2.0), one); };
        Real const of_t = cube(t), of_s = cube(s);
        Real const of_22 = fma(ts, fma(Real(8.0 / 45), ts, fnma(Real(8.0 / 15), t + s, Real(4.0 / 3))), (square(t) + square(s)) - one);
        return {area * of_t, area * of_s, even * fma(ts, bent(t), fnma(two_thirds, s, of_t)), even * fma(ts, bent(s), fnma(two_thirds, t, of_s)),
                fma(even, of_22, select(full_, Real(1.0 / 9), Real(0.0)))};
    }

    // ---- a strip along the edge ξ = 1, whose width in halves of the face's length is ℓ = w + rη ----

    /// ∫ηʲℓⁿ dη/(2n(n − 1)), a to c for j = 0 to 2.
    struct Widths { Real a2, a3, a4, b2, b3, b4, c2, c3; };
    SLIDEWAY_FN Widths widths() const {
        Real const w = width_, r = skew_, third(1.0 / 3), fifth(0.2), sixth(1.0 / 6), half(0.5);
        Real const ww = w * w, rr = r * r, wr = w * r, even = fma(third, ww, fifth * rr);
        return {half * fma(third, rr, ww),
                sixth * (w * (ww + rr)),
                Real(1.0 / 12) * fma(ww, fma(Real(2.0), rr, ww), (fifth * rr) * rr),
                third * wr,
                sixth * (r * fma(fifth, rr, ww)),
                third * (wr * even),
                half * even,
                sixth * (w * fma(third, ww, Real(0.6) * rr))};
    }
    SLIDEWAY_FN Moments<Real> strip_volumes() const {
        auto const [a2, a3, a4, b2, b3, b4, c2, c3] = widths();
        Real const h = Real(0.5) * strip_p_, minus_two(-2.0);
        return {{h * a2, h * (a2 - a3), h * b2, h * (b2 - b3)}, h * fma(minus_two, a3, a2 + a4), h * c2, h * fma(minus_two, b3, b2 + b4), h * (c2 - c3)};
    }
    SLIDEWAY_FN Moments<Real> strip_areas() const {
        auto const [a2, a3, a4, b2, b3, b4, c2, c3] = widths();
        Real const half(0.5), sixth(1.0 / 6), a1 = half * width_, b1 = sixth * skew_, c1 = sixth * (Real(2.0) * a1);
        return {{a1, fnma(half, a2, a1), b1, fnma(half, b2, b1)}, (a1 - a2) + a3, c1, (b1 - b2) + b3, fnma(half, c2, c1)};
    }
    SLIDEWAY_FN HigherMoments<Real> higher_strip_areas() const {
        auto const [a2, a3, a4, b2, b3, b4, c2, c3] = widths();
        Real const a1 = Real(0.5) * width_, b1 = Real(1.0 / 6) * skew_, c1 = Real(1.0 / 6) * width_, d1 = Real(0.1) * skew_;
        Real const three_halves(1.5), three(3.0);
        return {fma(three, a3, fnma(three_halves, a2 + a4, a1)), d1, fma(three, b3, fnma(three_halves, b2 + b4, b1)), fnma(d1, width_, d1),
                (c1 - c2) + c3};
    }

    Mask<Real> full_, strip_, exchanged_;
    Real sign_p_, sign_q_;
    Real level_, slope_p_, slope_q_;   // m, P, Q [m]
    Real cut_, corner_p_, corner_q_;   // f [m], t, s: depth and edges of the corner
    Real strip_p_, width_, skew_;      // P [m], w, r of the strip
};

}  // namespace slideway::inline SLIDEWAY_ISA
