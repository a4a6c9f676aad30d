#pragma once

#include "kernels/linkage/block.hpp"
#include "kernels/linkage/linkage_motion.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_plan.hpp"
#include "kernels/math/cholesky.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How a linkage is put together at the start: each closure's points coincide, but for the offset that a journal is given in its bearing.  Newton's
/// method from the angles that bodies are given, with the least motion, each coordinate in the size of its body; rates likewise.
class LinkageStart {
public:
    /// @param given a state that is not to be moved: its loops close, or they are at fault; nullptr: none
    SLIDEWAY_HD LinkageStart(LinkagePlan const& plan, LinkageParameters<double> const& p, double speed, double const* given = nullptr)
        : plan_(plan), p_(p), speed_(speed) {
        if (given != nullptr) {
            for (int i = 0; i < plan.states(); ++i) state_[i] = given[i];
            look_at_loops();
            return;
        }
        for (int i = 0; i < plan.bodies; ++i) {
            LinkageBody const& of = plan.body[i];
            if (of.joint != TreeJoint::floating) {
                state_[2 * of.coordinate] = plan.is_driven && i == 0 ? p.start_angle : p.body[i].angle;
                state_[2 * of.coordinate + 1] = plan.is_driven && i == 0 ? speed : p.body[i].speed;
                weight_[of.coordinate] = of.joint == TreeJoint::prismatic ? 1 : 1 / p.body[i].reach;
                continue;
            }
            int const angle = of.coordinate + 2;
            state_[2 * angle] = p.body[i].angle;
            state_[2 * angle + 1] = p.body[i].speed;
            weight_[of.coordinate] = weight_[of.coordinate + 1] = 1;
            weight_[angle] = 1 / p.body[i].reach;
            waits_[i] = true;
        }
        for (int round = 0; round < plan.bodies; ++round) {
            for (int i = 0; i < plan.bodies; ++i) {
                if (waits_[i] && hang(i)) waits_[i] = false;
            }
        }
        close();
    }

    /// What is wrong, and where it is worst.
    SLIDEWAY_HD AssemblyFault fault() const { return fault_; }
    SLIDEWAY_HD int worst() const { return worst_; }
    SLIDEWAY_HD double distance() const { return distance_; }
    SLIDEWAY_HD double rate() const { return rate_; }
    /// Where a journal is in its bearing, along the ground's axes; or a block across its walls, and its tilt.
    SLIDEWAY_HD Vec2<double> place_in(int closure) const { return place_of(gap_of(motion(), closure), closure); }
    SLIDEWAY_HD void put_as_it_is(double* state) const {
        for (int i = 0; i < plan_.states(); ++i) state[i] = state_[i];
    }

    /// NaN where it cannot be put together.
    SLIDEWAY_HD void put(double* state) const {
        for (int i = 0; i < plan_.states(); ++i) state[i] = fault_ == AssemblyFault::none ? state_[i] : not_a_number;
    }

private:
    static constexpr int n = LinkagePlan::most_coordinates, rows = 2 * LinkagePlan::most_closures;

    using Motion = LinkageMotion<PlanTable, double>;

    SLIDEWAY_HD Motion motion() const { return {PlanTable(plan_), p_, state_, plan_.is_driven != 0, {state_[0], speed_, 0}}; }

    /// Moves a body that floats to where its first pin or journal on what stands already closes, with the rate of that.
    SLIDEWAY_HD bool hang(int body) {
        for (int k = 0; k < plan_.closures; ++k) {
            auto const& of = plan_.closure[k];
            int const side = of.body[0] == body ? 0 : of.body[1] == body ? 1 : -1;
            if (side < 0 || of.kind == ClosureKind::block) continue;
            int const other = of.body[1 - side];
            if (other != LinkageBody::ground && waits_[root_of(other)]) continue;
            auto const at = motion();
            auto const gap = gap_of(at, k), rate = rate_of(at, k);
            double const sign = side == 0 ? -1 : 1;
            double* const state = state_ + 2 * plan_.body[body].coordinate;
            state[0] += sign * gap.x, state[1] += sign * rate.x;
            state[2] += sign * gap.y, state[3] += sign * rate.y;
            return true;
        }
        return false;
    }
    /// The body of the tree that stands on the ground below another one, or floats.
    SLIDEWAY_HD int root_of(int body) const {
        while (plan_.body[body].parent != LinkageBody::ground) body = plan_.body[body].parent;
        return body;
    }
    /// Of a pin or journal along X and Y; of a block across its walls, and by how much it is tilted, in the size of its body.
    SLIDEWAY_HD Vec2<double> gap_of(Motion const& motion, int closure) const {
        auto const& offset = p_.closure[closure].offset;
        if (plan_.closure[closure].kind != ClosureKind::block) return motion.apart(closure).place - offset;
        BlockPose<Motion> const pose(motion, closure);
        return {pose.place.y - offset.x, size_of(closure) * ::remainder(pose.tilt - offset.y, 6.283185307179586)};
    }
    SLIDEWAY_HD Vec2<double> rate_of(Motion const& motion, int closure) const {
        if (plan_.closure[closure].kind != ClosureKind::block) return motion.apart(closure).velocity;
        BlockPose<Motion> const pose(motion, closure);
        return {pose.velocity.y, size_of(closure) * pose.spin};
    }
    SLIDEWAY_HD void put_rows(Motion const& motion, int closure, double* first, double* second) const {
        auto const& of = plan_.closure[closure];
        if (of.kind != ClosureKind::block) return motion.put_rows(closure, first, second);
        for (int c = 0; c < plan_.coordinates; ++c) first[c] = second[c] = 0;
        BlockPose<Motion> const pose(motion, closure);
        double const size = size_of(closure);
        motion.add_row(of.body[0], pose.centre.arm, pose.normal(), first);
        motion.add_row(of.body[1], pose.middle.arm + (pose.centre.place - pose.middle.place), -1.0 * pose.normal(), first);
        motion.add_turn(of.body[0], size, second);
        motion.add_turn(of.body[1], -size, second);
    }
    SLIDEWAY_HD double size_of(int block) const { return p_.closure[block].half_length; }

    /// Of a state that is given.
    SLIDEWAY_HD void look_at_loops() {
        auto const at = motion();
        double most = 1e-6;  // of the largest body; more than a few digits that were cut off come to
        for (int k = 0; k < plan_.closures; ++k) {
            if (plan_.closure[k].has_clearance()) continue;
            double const open = detail::length(gap_of(at, k)), opens = detail::length(rate_of(at, k));
            double const share = max(open, opens / p_.rate_scale) / p_.reach;
            if (share <= most) continue;
            most = share, worst_ = k, distance_ = open, rate_ = opens, fault_ = AssemblyFault::open;
        }
    }

    /// Exactly, journals and blocks where they are asked for; where lengths do not allow that, ideal joints exactly and those with clearance within it.
    SLIDEWAY_HD void close() {
        double begun[LinkagePlan::most_states];
        for (int i = 0; i < plan_.states(); ++i) begun[i] = state_[i];
        close_exactly();
        if (fault_ == AssemblyFault::none || !plan_.has_clearance()) return;
        for (int i = 0; i < plan_.states(); ++i) state_[i] = begun[i];
        fault_ = AssemblyFault::none;
        close_within();
    }

    SLIDEWAY_HD void close_exactly() {
        int const m = 2 * plan_.closures, first = plan_.is_driven ? 1 : 0;
        double const enough = 4e-16 * p_.reach, good = 1e-11 * p_.reach;
        double former = 1e300;
        for (int turn = 0; m > 0 && turn < 200; ++turn) {
            auto const at = motion();
            double gap[rows];
            distance_ = 0;
            for (int k = 0; k < plan_.closures; ++k) {
                auto const apart = gap_of(at, k);
                gap[2 * k] = apart.x, gap[2 * k + 1] = apart.y;
                double const away = ::sqrt(apart.x * apart.x + apart.y * apart.y);
                if (!(away <= distance_)) distance_ = away, worst_ = k;
            }
            if (distance_ <= enough || (distance_ <= good && !(distance_ < 0.5 * former))) break;
            former = distance_;
            if (!factor(at)) break;
            move(gap, 0, first);
        }
        if (!(distance_ <= good)) fault_ = AssemblyFault::open;
        if (m > 0 && fault_ == AssemblyFault::none) close_rates();
    }

    SLIDEWAY_HD void close_rates() {
        auto const at = motion();
        if (!factor(at)) {
            fault_ = AssemblyFault::redundant;
            return;
        }
        double gap[rows];
        for (int k = 0; k < plan_.closures; ++k) {
            auto const apart = rate_of(at, k);
            gap[2 * k] = apart.x, gap[2 * k + 1] = apart.y;
        }
        move(gap, 1, plan_.is_driven ? 1 : 0);
    }

    /// The least sum of squares of what joints with clearance are apart, each in its clearance and with a weight, ideal ones closed: Newton's method, with
    /// rows that give way, the more where it overshoots (Levenberg and Marquardt).  Weights grow where joints are farther out, which leads to the least largest share of a clearance.
    /// Source: Lawson (1961), in Rice, The approximation of functions, volume 2.
    SLIDEWAY_HD void close_within() {
        constexpr double least_weight = 1e-3, enough = 0.9;
        constexpr int turns = 400, turns_alike = 30, turns_of_rates = 20;
        int const first = plan_.is_driven ? 1 : 0;
        double weight[LinkagePlan::most_closures], share[LinkagePlan::most_closures], gap[rows], heaviest = 1, former = 1e300, last_cost = 1e300, caution = 1;
        for (int k = 0; k < plan_.closures; ++k) weight[k] = 1;
        for (int turn = 0;; ++turn) {
            auto const at = motion();
            double widest = 0, open = 0, farthest = 0, cost = 0;
            int worst = 0, ideal = 0;
            for (int k = 0; k < plan_.closures; ++k) {
                auto const apart = gap_of(at, k);
                gap[2 * k] = apart.x, gap[2 * k + 1] = apart.y;
                bool const plays = plan_.closure[k].has_clearance();
                double const out = plays ? reach_of(place_of(apart, k), k) : detail::length(apart);
                share[k] = plays ? out / p_.closure[k].clearance : 0;
                cost += weight[k] * share[k] * share[k];
                if (plays && !(share[k] <= widest)) widest = share[k], worst = k, farthest = out - p_.closure[k].clearance;
                if (!plays && !(out <= open)) open = out, ideal = k;
            }
            bool const closes = open <= 1e-11 * p_.reach, fits = widest <= 1 + 1e-9;
            worst_ = closes ? worst : ideal, distance_ = closes ? farthest : open;
            if (turn == turns || (closes && widest <= enough && ::fabs(widest - former) < 1e-6)) {
                if (!closes || !fits) fault_ = AssemblyFault::open;
                break;
            }
            former = widest;
            caution = cost > last_cost ? min(4 * caution, 1e6) : max(0.5 * caution, 1.0);
            last_cost = cost;
            double grown = 0;
            for (int k = 0; k < plan_.closures; ++k) {
                if (turn >= turns_alike && plan_.closure[k].has_clearance()) weight[k] = max(weight[k] / heaviest * share[k] / max(widest, 1e-300), least_weight);
                grown = max(grown, weight[k]);
                soften(k, caution / weight[k]);
            }
            heaviest = grown;
            if (!factor(at)) {
                fault_ = AssemblyFault::redundant;
                break;
            }
            move(gap, 0, first);
        }
        for (int k = 0; k < plan_.closures; ++k) soften(k, 1);
        for (int turn = 0; fault_ == AssemblyFault::none && turn < turns_of_rates; ++turn) close_rates();
    }
    SLIDEWAY_HD void soften(int closure, double times) {
        double const play = p_.closure[closure].clearance / p_.play;
        soft_[closure] = plan_.closure[closure].has_clearance() ? 1e-4 * times * play * play : 0;
    }
    SLIDEWAY_HD Vec2<double> place_of(Vec2<double> gap, int closure) const {
        if (plan_.closure[closure].kind == ClosureKind::block) gap.y = gap.y / size_of(closure);
        return gap + p_.closure[closure].offset;
    }
    /// How far a journal is from its bearing's centre, or a corner from where it is in the middle.
    SLIDEWAY_HD double reach_of(Vec2<double> place, int closure) const {
        return plan_.closure[closure].kind == ClosureKind::block ? ::fabs(place.x) + size_of(closure) * ::fabs(place.y) : detail::length(place);
    }

    /// J W Jᵀ, W the squared sizes of the coordinates, softer by what rows give way.  @return whether it has an inverse
    SLIDEWAY_HD bool factor(Motion const& at) {
        int const m = 2 * plan_.closures, first = plan_.is_driven ? 1 : 0;
        for (int k = 0; k < plan_.closures; ++k) put_rows(at, k, jacobian_[2 * k], jacobian_[2 * k + 1]);
        for (int i = 0; i < m; ++i) {
            for (int j = 0; j <= i; ++j) {
                double sum = 0;
                for (int c = first; c < plan_.coordinates; ++c) sum += jacobian_[i][c] * weight_[c] * weight_[c] * jacobian_[j][c];
                factors_.entry[i][j] = sum;
            }
        }
        double stiffest = 0;
        for (int i = 0; i < m; ++i) stiffest = max(stiffest, factors_.entry[i][i]);
        for (int i = 0; i < m; ++i) factors_.entry[i][i] += soft_[i / 2] * stiffest;
        bool whole = true;
        factors_.factor(PlanTable(plan_), m, 1e-10, [&](int row, bool singular) {
            if (singular && whole) worst_ = row / 2, whole = false;
        });
        return whole;
    }

    /// The least motion that closes gaps, of places (0) or rates (1).
    SLIDEWAY_HD void move(double* gap, int of, int first) {
        int const m = 2 * plan_.closures;
        factors_.solve(PlanTable(plan_), gap);
        // Far from where it closes, no angle by more than a third of a right one at once.
        double step[n], largest = 0;
        for (int c = first; c < plan_.coordinates; ++c) {
            double sum = 0;
            for (int i = 0; i < m; ++i) sum += jacobian_[i][c] * gap[i];
            step[c] = weight_[c] * weight_[c] * sum;
            if (plan_.is_angle(c)) largest = max(largest, ::fabs(step[c]));
        }
        double const share = of == 0 && largest > 0.5 ? 0.5 / largest : 1;
        for (int c = first; c < plan_.coordinates; ++c) state_[2 * c + of] -= share * step[c];
    }

    LinkagePlan const& plan_;
    LinkageParameters<double> const& p_;
    double speed_;  // of the crank
    double state_[LinkagePlan::most_states] = {};
    double weight_[n] = {};
    bool waits_[LinkagePlan::most_bodies] = {};  // bodies that float and have no place yet
    double jacobian_[rows][n];
    CholeskyFactors<rows, double> factors_;
    double soft_[LinkagePlan::most_closures] = {};  // by how much rows give way, over the stiffest
    double distance_ = 0, rate_ = 0;
    int worst_ = 0;
    AssemblyFault fault_ = AssemblyFault::none;
};

/// The state in which a member starts: the one that it is given, or as it goes together.
SLIDEWAY_HD inline void put_linkage_start(LinkagePlan const& plan, Inputs const& in, double* state) {
    if (in.mechanism_a == in.mechanism_a) {
        for (int i = 0; i < plan.states(); ++i) state[i] = in.*mechanism_inputs[i];
        return;
    }
    auto const p = linkage_parameters(plan, in);
    LinkageStart(plan, p, start_speed(in)).put(state);
}

}  // namespace slideway::inline SLIDEWAY_ISA
