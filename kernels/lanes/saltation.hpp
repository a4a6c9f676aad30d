#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "kernels/laws/face.hpp"
#include "kernels/math/tangent.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Carries offsets from members with rigid contacts through what happens where their steps end, exactly to the first order in them.  A shadow
/// that is δ off its member when that has its event has its own δt later.  With γ what meets or turns round there, f the derivatives before and
/// after, and R what the event does to the state,
///   δt = −(∇γ·δ)/γ'⁻,   δ⁺ = DR (δ + f⁻ δt) + ∂R/∂t δt − f⁺ δt.                                                     (M13.12)
/// R is the model's `settle`, its derivative that of the very decisions that the member's takes.  Where a contact opens f is continuous, and δt
/// does not matter.
template <class Model, class Real> class Saltation {
public:
    static constexpr int size = Model::size;
    using Parameters = typename Model::template Parameters<Real>;
    using Memory = typename Model::template Memory<Real>;
    using Contact = std::remove_cvref_t<decltype(std::declval<typename Model::template Report<Real>>().contact)>;

    /// Where a step has ended, before its event.
    struct Before {
        Real t, end;  // [s]
        Real const* y;
        Real const* rates;
        Contact const& contact;
        Memory const& memory;
    };

    /// @param in lanes where `settle` changes something  @param at_start whether it does so before the first step: at no other time then
    SLIDEWAY_HD Saltation(Model const& model, Parameters const& p, Before const& before, Mask<Real> in, bool at_start)
        : model_(model), before_(before), in_(in), at_start_(at_start), states_(model) {
        lift(p, p_);
        lift(before.memory, memory_);
        for (int i = 0; i < states_; ++i) flow_[i] = before.rates[i];
        along_ = contact_along(flow_, Real(1.0));
        look_before_stops(p);
    }

    /// How a shadow is carried.
    struct Carried {
        Real delay;  // δt [s]
        Mask<Real>
            apart;  // lanes whose contacts meet at once, but not those of the shadow: what follows depends on which of them comes first
    };

    /// @param offset δ of a shadow from its member; then δ⁺ + f⁺ δt
    SLIDEWAY_HD Carried carry(Real* offset) const {
        auto contact = contact_along(offset, Real(0.0));
        auto const carried = delay_of(contact);
        Number y[size];
        for (int i = 0; i < states_; ++i) y[i] = {before_.y[i], fma(flow_[i], carried.delay, offset[i])};
        // Of the member what it has itself, to the last bit: the same decisions follow.
        auto const* const own = reinterpret_cast<Real const*>(&before_.contact);
        auto const* const along = reinterpret_cast<Number const*>(&along_);
        auto* const numbers = reinterpret_cast<Number*>(&contact);
        for (std::size_t i = 0; i < sizeof(Contact) / sizeof(Real); ++i) {
            numbers[i] = {own[i], fma(along[i].slope, carried.delay, numbers[i].slope)};
        }
        auto memory = memory_;
        Number const t(before_.t, carried.delay);
        model_.settle(in_, t, Number(before_.end), y, p_, memory, contact);
        model_.keep_offset(in_, t, y, p_, memory);
        for (int i = 0; i < states_; ++i) offset[i] = y[i].slope;
        return carried;
    }

private:
    using Number = Tangent<Real>;
    using Contacts = std::remove_cvref_t<decltype(std::declval<typename Model::template Report<Number>>().contact)>;
    static constexpr bool has_grip = requires(Contact const& contact) { contact.grip; };
    static constexpr bool has_slips = requires(Contact const& contact) { contact.slides; };
    /// Share of the longer of two delays by which they differ by more than rounding and curvature.
    static constexpr double same_delay = 1e-3;
    /// Change of a grip over the run that is more than rounding.
    static constexpr double least_turn = 1e-6;

    template <class Record, class Numbers> SLIDEWAY_HD static void lift(Record const& record, Numbers& numbers) {
        constexpr std::size_t count = sizeof(Record) / sizeof(Real);
        static_assert(sizeof(Numbers) == count * sizeof(Number) && std::is_trivially_copyable_v<Record>);
        auto const* const from = reinterpret_cast<Real const*>(&record);
        auto* const to = reinterpret_cast<Number*>(&numbers);
        for (std::size_t i = 0; i < count; ++i) to[i] = {from[i], Real(0.0)};
    }

    /// How what the contacts report changes along a direction.
    SLIDEWAY_NOINLINE Contacts contact_along(Real const* direction, Real of_time) const {
        Number y[size], rates[size];
        for (int i = 0; i < states_; ++i) y[i] = {before_.y[i], direction[i]};
        typename Model::template Report<Number> report;
        model_.template derivative<true>(Number(before_.t, of_time), y, p_, memory_, rates, &report);
        return report.contact;
    }

    /// Where a slip has come to rest friction may already have changed its sign, and the derivative before is that of a moment ago.
    SLIDEWAY_NOINLINE void look_before_stops(Parameters const& p) {
        Real const since(model_.since_slip(before_.contact, along_, p));
        auto const earlier = in_ & (since > Real(0.0));
        if (none(earlier) || at_start_) return;
        Real y[size], rates[2][size];
        typename Model::template Report<Real>* const no_report = nullptr;
        for (int twice = 0; twice < 2; ++twice) {
            Real const ago = twice == 0 ? since : since + since;
            for (int i = 0; i < states_; ++i) y[i] = fnma(ago, before_.rates[i], before_.y[i]);
            model_.template derivative<false>(before_.t - ago, y, p, before_.memory, rates[twice], no_report);
        }
        // As it goes on from there.
        for (int i = 0; i < states_; ++i) flow_[i] = select(earlier, (rates[0][i] - rates[1][i]) + rates[0][i], flow_[i]);
        along_ = contact_along(flow_, Real(1.0));
    }

    /// δt of the first of the member's events.  @param of how they change along the offset
    SLIDEWAY_HD Carried delay_of(Contacts const& of) const {
        Carried carried{Real(0.0), mask_of<Real>(false)};
        if (at_start_) return carried;
        Real const located = Model::located(p_, Number(before_.end)).value;
        auto found = mask_of<Real>(false);
        each_event(of, located, [&](Event const& event) {
            carried.delay = select(event.happens & !found, event.delay, carried.delay);
            carried.apart = carried.apart | event.grazes;
            found = found | event.happens;
        });
        each_event(of, located, [&](Event const& event) {
            Real const &delay = event.delay, &first = carried.delay;
            carried.apart = carried.apart | (found & event.differs &
                                             (abs(delay - first) > Real(same_delay) * max(abs(delay), abs(first))));
        });
        return carried;
    }

    /// What may happen to a contact, in some lanes.
    struct Event {
        Mask<Real> happens, grazes;
        Mask<Real> differs;  // is near, and the shadow's is apart from it by more than the accuracy of the member's
        Real delay;
    };

    /// Has a function see each.
    template <class See> SLIDEWAY_HD void each_event(Contacts const& of, Real located, See const& see) const {
        Real const zero(0.0), one(1.0), half(0.5);
        auto const delay_where = [&](Mask<Real> in, Real change, Real flow) {
            return select(in, negated(change) / select(in, flow, one), zero);
        };
        auto const pair = [&](Real depth, Real rate, Number const& flow, Number const& change, Real pressing,
                              Real rate_change) {
            Mask<Real> const near = in_ & (depth > negated(located)), meets = near & (rate > zero);
            Mask<Real> const apart = abs(change.slope) > located;
            Real const delay = delay_where(near, change.slope, flow.slope);
            // A shadow that would meet the wall much slower or faster is not near enough, or the member's speed is but rounding.
            Mask<Real> const unlike = meets & !(abs(fma(pressing, delay, rate_change)) <= half * rate);
            see(Event{meets, Mask<Real>(unlike & apart), Mask<Real>(near & apart), select(unlike, zero, delay)});
        };
        constexpr std::size_t quads = std::extent_v<decltype(Contact::watched)>;
        for (std::size_t i = 0; i < quads; ++i) {
            auto const &depth = before_.contact.watched[i], &rate = before_.contact.rate[i];
            auto const &flow = along_.watched[i], &change = of.watched[i], &press = along_.rate[i], &turn = of.rate[i];
            pair(depth.a, rate.a, flow.a, change.a, press.a.slope, turn.a.slope);
            pair(depth.b, rate.b, flow.b, change.b, press.b.slope, turn.b.slope);
            pair(depth.c, rate.c, flow.c, change.c, press.c.slope, turn.c.slope);
            pair(depth.d, rate.d, flow.d, change.d, press.d.slope, turn.d.slope);
        }
        if constexpr (has_slips) {
            // Which of several slips ends first does not matter: those that end take away the same.
            auto const no = mask_of<Real>(false);
            before_.contact.each_slip(along_, of, [&](Mask<Real> stops, Mask<Real> starts, Real delay) {
                Mask<Real> const turns = in_ & (stops | starts);
                see(Event{turns, no, no, select(turns, delay, zero)});
            });
        }
        if constexpr (has_grip) {
            for (std::size_t i = 0; i < std::extent_v<decltype(Contact::grip)>; ++i) {
                Real const flow = along_.grip[i].slope;
                // Of one that is stuck it is rounding, which a run would not add up.
                Mask<Real> const turns =
                    in_ & (before_.contact.grip[i] < zero) & (flow * before_.end < Real(-least_turn));
                see(Event{turns, mask_of<Real>(false), turns, delay_where(turns, of.grip[i].slope, flow)});
            }
        }
    }

    Model const& model_;
    Before const before_;
    Mask<Real> const in_;
    bool const at_start_;
    StateCount<Model> const states_;
    typename Model::template Parameters<Number> p_;
    typename Model::template Memory<Number> memory_;
    Real flow_[size];  // derivative before the event
    Contacts along_;   // what the contacts report along it
};

}  // namespace slideway::inline SLIDEWAY_ISA
