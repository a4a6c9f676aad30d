#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/block.hpp"
#include "kernels/lanes/clock_step.hpp"
#include "kernels/lanes/ending_step.hpp"
#include "kernels/lanes/explicit_step.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/lanes/method_choice.hpp"
#include "kernels/lanes/moreau_jean_step.hpp"
#include "kernels/lanes/new_member.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/results.hpp"
#include "kernels/lanes/roster.hpp"
#include "kernels/lanes/stiff_step.hpp"
#include "kernels/lanes/stint.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"
#include "kernels/steppers/bogacki_shampine.hpp"
#include "kernels/steppers/dop853.hpp"
#include "kernels/steppers/dormand_prince.hpp"
#include "kernels/steppers/runge_kutta4.hpp"
#include "kernels/steppers/verner65.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Works through a block of members with one pack of lanes.  Some eight members per lane are under way at once; the roster picks
/// those that work together for a stint, a fixed number of a member's own attempts, so that whatever is decided between
/// stints depends on the member alone.  A member that ends gives its seat to the next of the block's queue.
template <class Model, class Real> class LaneProgram {
public:
    using Block = BlockOf<typename Model::Inputs>;
    static_assert(ModelParts<Model, Real>::are_there);
    static_assert(holds_reals_only<Model>);

    SLIDEWAY_HD LaneProgram(Block& block, Model const& model) : block_(block), results_(block, model), pack_(model) {
        // What is observed for the status alone is not written.
        Selection const for_status =
            is_always_audited(block.settings.method) ? MemberState<Model, Real>::Observer::audit_quantities : 0;
        pack_.needs = ReportNeeds::of<Model, Real>(model, block.quantities | for_status, block.settings);
        pack_.model.hold_contacts(pack_.needs.watching);
        pack_.model.tell_forces(pack_.needs.forces);
        pack_.model.set_tolerance(block.settings.rtol);
        start_memory(pack_.state.contacts.memory);
        pack_.pair = &pair_of(block.settings, pack_.needs.watching);
    }

    SLIDEWAY_HD void run() {
        int const first = block_.seats > 0 && block_.seats < seats ? static_cast<int>(block_.seats) : seats;
        for (int seat = 0; seat < first; ++seat) admit(seat);
        for (;;) {
            int chosen[width];
            int const members = roster_.choose(chosen);
            if (members == 0) return;
            SLIDEWAY_EXPECT(members <= width);
            if (is_stopped()) {
                abandon();
                return;
            }
            take(chosen, members);
            serve(roster_[chosen[0]].kind);
            release(chosen, members);
        }
    }

private:
    SLIDEWAY_HD bool is_stopped() const {
        return is_raised(block_.stop_flag) || host_says(block_.stop, block_.stop_context, covered_);
    }

    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    static constexpr int seats = width == 1 ? 1 : 8 * width;
    static constexpr bool is_smooth = !Model::has_contacts && !Model::has_linearisation;
    // Attempts of a stint: few where lanes are regrouped by what they touch, the fewer the sooner that changes, many where all have the same work.
    static constexpr int many_attempts = 512, attempts = !Regroups<Model> ? many_attempts : IsRigid<Model> ? 8 : 16;
    using Kind = typename Roster<seats, width>::Kind;
    using Record = MemberState<Model, double>;

    /// Seats the next member of the queue, if there is one.
    SLIDEWAY_HD void admit(int seat) {
        roster_[seat] = {};
        std::uint64_t const place = block_.taken != nullptr ? fetch_add(*block_.taken, 1) : next_++;
        if (place >= block_.members) return;
        std::size_t const member = block_.order != nullptr ? block_.order[place] : place;
        NewMember<Model>::begin(record(seat), pack_.model, block_, member);
        roster_[seat].kind = Kind::fresh;
    }

    /// A single lane works on its record in place.
    SLIDEWAY_HD Record& record(int seat) {
        if constexpr (width == 1)
            return pack_.state;
        else
            return records_[seat];
    }

    /// Brings members into the lanes; lanes without one idle on the first one's numbers.
    SLIDEWAY_HD void take(int const* chosen, int members) {
        Real occupied(0.0);
        for (int i = 0; i < width; ++i) {
            if (i < members) set_lane(occupied, i, 1.0);
            if (width > 1) {
                Record const& r = record(chosen[i < members ? i : 0]);
                load_lane(pack_.state.constants, i, r.constants);
                each_moving_part(r, [i](auto& packed, auto const& own) { load_lane(packed, i, own); });
            }
        }
        pack_.busy = occupied > Real(0.5);
    }

    /// Returns them to their seats; an ended member's seat goes to the next of the queue.
    SLIDEWAY_HD void release(int const* chosen, int members) {
        for (int i = 0; i < members; ++i) {
            int const seat = chosen[i];
            if (block_.stop != nullptr) count_covered(seat, i);
            if (!holds(pack_.busy, i)) {
                admit(seat);
                continue;
            }
            auto const& c = pack_.state.course;
            if (width > 1) {
                each_moving_part(record(seat), [i](auto const& packed, auto& own) { store_lane(packed, i, own); });
            }
            roster_[seat].kind = lane(c.stiff, i) > 0.5 ? Kind::stiff : Kind::explicit_pair;
            roster_[seat].pattern = static_cast<std::uint32_t>(lane(pattern_, i));
            roster_[seat].share = results_.share(pack_.state, i);
        }
    }

    /// Has a function see what changes of a member in a stint, in the pack and in the member's record.
    template <class OneRecord, class Function> SLIDEWAY_HD void each_moving_part(OneRecord& r, Function const& move) {
        auto& s = pack_.state;
        move(s.course, r.course);
        if constexpr (Model::has_contacts) {
            if (pack_.needs.cuts()) move(s.contacts, r.contacts);
        }
        if (pack_.needs.quantities) move(s.observation, r.observation);
        pack_.with_record(s.accelerations, pack_.needs.accelerations, [&](auto& a) { move(a, r.accelerations); });
        pack_.with_record(s.forces, pack_.needs.forces, [&](auto& a) { move(a, r.forces); });
        if constexpr (Model::has_shadows) {
            for (int i = 0; i < block_.shadows.count; ++i) move(s.shadows[i], r.shadows[i]);
        }
    }

    /// Counts the time that a member has covered in this stint; all that was left to it if it has ended.
    SLIDEWAY_HD void count_covered(int seat, int i) {
        covered_ += (holds(pack_.busy, i) ? results_.share(pack_.state, i) : 1) - roster_[seat].share;
    }

    /// One stint.
    SLIDEWAY_HD void serve(Kind kind) {
        auto const& settings = block_.settings;
        if (kind == Kind::fresh) {
            start();
        } else if (kind == Kind::stiff) {
            work<std::conditional_t<HasStiffSteps<Model>, StiffStep<Model, Real>, ExplicitStep<Model, Real>>>();
        } else if (is_time_stepping()) {
            work<std::conditional_t<HasTimeStepping<Model>, MoreauJeanStep<Model, Real>, ExplicitStep<Model, Real>>>();
        } else if (settings.method == Method::verner65) {
            work<std::conditional_t<HasClocks<Model>, ClockStep<Verner65, Model, Real>, ExplicitStep<Model, Real>>>();
        } else if (Model::has_own_stepper && settings.method == Method::automatic) {
            Model::template with_stepper<Model, Real>(settings.rtol, [&]<class Stepper>(Stepper*) { work<Stepper>(); });
        } else {
            work<std::conditional_t<HasTimeStepping<Model>, EndingStep<DormandPrince, Model, Real>, ExplicitStep<Model, Real>>>();
        }
        look(kind);
    }

    /// The explicit method of a block.
    SLIDEWAY_HD static PairNumbers const& pair_of(IntegratorSettings const& settings, Watching watching) {
        bool const is_automatic = settings.method == Method::automatic;
        if (settings.method == Method::verner65) return pair_numbers<Verner65>();
        // Impacts, whose steps are many and short, would gain nothing by the others (rigid.md).
        if (IsRigid<Model>) return pair_numbers<DormandPrince>();
        if (settings.method == Method::rk4) return pair_numbers<RungeKutta4>();
        // Where nothing breaks the smoothness of the motion, it beats the others at every tolerance (integrators.md).
        if (settings.method == Method::dop853 || (is_automatic && is_smooth)) return pair_numbers<Dop853>();
        bool const is_loose = is_automatic && auto_takes_bs32(settings.rtol, watching == Watching::gaps || holds_contacts(watching));
        if (settings.method == Method::bs32 || is_loose) return pair_numbers<BogackiShampine>();
        return pair_numbers<DormandPrince>();
    }

    SLIDEWAY_HD bool is_time_stepping() const { return HasTimeStepping<Model> && block_.settings.method == Method::moreau_jean; }

    template <class Stepper> SLIDEWAY_NOINLINE void work() {
        Stint<Stepper, Model, Real> stint(pack_, results_, block_.settings);
        // Lanes that leave the stiff method wait for the others.
        stint.work(Stepper::has_impulses ? many_attempts : Stepper::stiff ? attempts / 4 : attempts);
    }

    /// First evaluation of new members.  A start that cannot be evaluated ends its member before the first step.
    /// A function of its own, or its shadows would lie on a card's stack beside those of every stint.
    SLIDEWAY_NOINLINE void start() {
        auto& c = pack_.state.course;
        auto& contacts = pack_.state.contacts;
        Real rates[size];
        typename Model::template Report<Real> report;
        auto faults = pack_.evaluate(c.t, c.y, contacts.memory, rates, pack_.needs.ends, report);
        pack_.count_evaluations(pack_.busy, 1);
        auto const whole = is_finite(c.y, rates, pack_.states());
        pack_.start_observing(pack_.busy, report);
        pack_.begin_next(pack_.busy, rates, report);
        Neighbours<Model, Real> neighbours(block_.shadows);
        // By whatever stepper they go on.
        using Contacts = ContactSteps<ExplicitStep<Model, Real>, Model, Real>;
        faults = faults.or_else(Contacts::start(pack_, results_, neighbours, block_.settings, rates, report));
        Mask<Real> broken = pack_.busy & !whole;
        broken = broken | neighbours.start(pack_, pack_.busy & whole, faults);
        Mask<Real> const failed = broken | (pack_.busy & (faults.geometry | faults.contact_domain));
        if (none(failed)) return;
        results_.retire(pack_, {failed, mask_of<Real>(false), failed, broken}, faults);
        pack_.busy = pack_.busy & !failed;
    }

    /// Between stints: who touches what, and who is better off with the stiff method.
    SLIDEWAY_HD void look(Kind kind) {
        pattern_ = Real(0.0);
        if constexpr (Regroups<Model>) {
            auto const& s = pack_.state;
            // Shadows want the motion between two changes of mode as it is, ringing and all.
            bool const switching = HasStiffSteps<Model> && block_.settings.method == Method::automatic &&
                                   !(Model::has_shadows && block_.settings.locate_modes);
            if (width == 1 && !switching) return;
            pattern_ = pack_.model.contact_pattern(s.course.t, s.course.y, s.constants.parameters, s.contacts.memory);
            if constexpr (HasStiffSteps<Model>) {
                if (switching && kind == Kind::explicit_pair) {
                    MethodChoice<Model, Real>::look_for_stiffness(pack_, pack_.busy & ((pattern_ > Real(0.5)) | mask_of<Real>(pack_.model.has_film())));
                }
            }
        }
    }

    /// Leaves the members under way as if they had never begun.
    SLIDEWAY_HD void abandon() {
        for (int seat = 0; seat < seats; ++seat) {
            if (roster_[seat].kind == Kind::none) continue;
            results_.abandon(static_cast<std::size_t>(record(seat).course.member));
        }
    }

    Block& block_;
    Results<Model> results_;
    Roster<seats, width> roster_;
    std::uint64_t next_ = 0;  // of the queue, if the block is this program's alone
    double covered_ = 0;      // members, and shares of them
    [[no_unique_address]] PartIf<(width > 1), Record[seats]> records_;
    Pack<Model, Real> pack_;
    Real pattern_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
