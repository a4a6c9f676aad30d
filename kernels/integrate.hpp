#pragma once

#include <utility>

#include "kernels/block.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/observers/sampler.hpp"
#include "kernels/observers/slider_crank_observer.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/dormand_prince.hpp"
#include "kernels/steppers/step_control.hpp"
#include "kernels/steppers/touch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One pack of lanes that works through a block of members.  Every lane has its own member, time and step; a lane whose member
/// ends takes the next one of the block at once.  Nothing that happens in one lane reaches another: a member's result depends
/// on its own inputs only.
template <class Model, class Real> class LaneProgram {
public:
    SLIDEWAY_HD explicit LaneProgram(Block& block)
        : block_(block),
          sampler_(block),
          stage_reports_(Observer::needs_stages(block.quantities)),
          audited_(Observer::audits(block.quantities)),
          end_reports_(stage_reports_ || Observer::needs_reports(block.quantities) || Model::has_memory) {}

    SLIDEWAY_HD void run() {
        if (block_.members == 0) return;
        prepare();
        take_members(all_lanes());
        for (unsigned attempts = 1; any(busy_); ++attempts) {
            if (attempts % stop_interval == 0 && block_.stop != nullptr && block_.stop(block_.stop_context)) {
                abandon();
                return;
            }
            attempt();
            auto const ended = settle();
            if (any(ended)) {
                retire(ended);
                take_members(ended);
            }
        }
    }

private:
    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    static constexpr unsigned stop_interval = 64;  // attempts: some 0.1 ms
    using Method = DormandPrince;
    using Observer = SliderCrankObserver<Real>;
    using Report = typename Model::template Report<Real>;
    using Parameters = typename Model::template Parameters<Real>;
    static_assert(sizeof(Parameters) % sizeof(Real) == 0 &&
                  sizeof(Parameters) / sizeof(Real) ==
                      sizeof(typename Model::template Parameters<double>) / sizeof(double));

    SLIDEWAY_HD static Mask<Real> all_lanes() { return mask_of<Real>(true); }

    /// Lanes without a member idle on the block's first one, whose numbers are as good as any.
    SLIDEWAY_HD void prepare() {
        Real const zero(0.0);
        for (int i = 0; i < width; ++i) load_member(i, 0);
        for (auto& k : k_) {
            for (auto& value : k) value = zero;
        }
        for (auto& value : integral_) value = zero;
        for (auto& value : audit_error_) value = zero;
        for (auto* value : {&accepted_, &rejected_, &evaluations_, &rejections_}) *value = zero;
        busy_ = mask_of<Real>(false);
        failure_ = Faults<Real>::none();
        not_finite_ = mask_of<Real>(false);
    }

    SLIDEWAY_HD void load_member(int index, std::size_t member) {
        auto const& inputs = block_.inputs[member];
        auto const parameters = Model::parameters(inputs);
        auto const* from = reinterpret_cast<double const*>(&parameters);
        auto* to = reinterpret_cast<Real*>(&p_);
        for (std::size_t i = 0; i < sizeof(parameters) / sizeof(double); ++i) set_lane(to[i], index, from[i]);
        double start[size];
        Model::initial_state(inputs, start);
        for (int i = 0; i < size; ++i) set_lane(y_[i], index, start[i]);
        for (auto& face : memory_.speeds) {
            for (auto* speed : {&face.a, &face.b, &face.c, &face.d}) set_lane(*speed, index, least_impact_speed);
        }
        set_lane(t_, index, 0.0);
        set_lane(h_, index, 1e-3 * block_.settings.max_step);
        set_lane(error_memory_, index, StepControl::start_memory);
        for (auto* value : {&accepted_, &rejected_, &evaluations_, &rejections_}) set_lane(*value, index, 0.0);
        member_[index] = member;
        sample_[index] = 0;
    }

    /// Fills free lanes from the block's queue until every one has a member that can start, or the queue is empty.
    SLIDEWAY_HD void take_members(Mask<Real> free) {
        while (any(free)) free = start_members(free);
    }

    /// @return lanes whose new member failed at its start.
    SLIDEWAY_HD Mask<Real> start_members(Mask<Real> free) {
        Real occupied = count<Real>(busy_);
        Real fresh_lanes(0.0);
        for (int i = 0; i < width; ++i) {
            if (!holds(free, i) || next_ == block_.members) continue;
            load_member(i, next_++);
            set_lane(occupied, i, 1.0);
            set_lane(fresh_lanes, i, 1.0);
        }
        busy_ = occupied > Real(0.5);
        auto const fresh = fresh_lanes > Real(0.5);
        if (none(fresh)) return fresh;
        Model::scales(p_, scale_);
        auto const faults = evaluate(t_, y_, next_k_, end_reports_, end_report_);
        evaluations_ = evaluations_ + count<Real>(fresh);
        take_over(fresh, next_k_);
        if (block_.quantities != 0) observer_.start(fresh, end_report_, y_);
        if (stage_reports_) keep_integrands(fresh);
        if constexpr (Model::has_memory) touches_.keep(fresh, end_report_.contact);
        // A start that cannot be evaluated ends its member before the first step.
        failure_ = faults.within(fresh);
        auto const whole_state = is_finite(y_), whole_rates = is_finite(k_[0]);
        not_finite_ = fresh & !(whole_state & whole_rates);
        auto const failed = not_finite_ | failure_.geometry | failure_.contact_domain;
        if (any(failed)) retire(failed);
        return failed;
    }

    SLIDEWAY_HD static Mask<Real> is_finite(Real const* values) {
        Real sum(0.0);
        for (int i = 0; i < size; ++i) sum = fma(values[i], Real(0.0), sum);
        return sum == Real(0.0);
    }

    SLIDEWAY_HD Faults<Real> evaluate(Real t, Real const* state, Real* rates, bool report_wanted, Report& report) {
        return report_wanted ? Model::template derivative<true>(t, state, p_, memory_, rates, &report)
                             : Model::template derivative<false>(t, state, p_, memory_, rates, &report);
    }

    /// One step of every lane from (t, y) to (t + step, end); idle lanes step in place.
    SLIDEWAY_HD void attempt() {
        Real const end_time(block_.settings.end_time);
        Real const remaining = end_time - t_;
        // A last step a hair short of the end would leave a crumb below the resolution of time.
        last_ = remaining <= h_ * Real(1.000001);
        step_ = select(busy_, select(last_, remaining, h_), Real(0.0));
        faults_ = Faults<Real>::none();
        if (stage_reports_) {
            for (int i = 0; i < Observer::integrals; ++i)
                integral_[i] = Real(Method::tableau.b[0]) * first_integrand_[i];
            for (int i = 0; i < Observer::audit_integrals; ++i) {
                audit_error_[i] = Real(Method::tableau.e[0]) * first_integrand_[i];
            }
        }
        stages(std::make_integer_sequence<int, Method::stages - 1>{});
        evaluations_ = evaluations_ + select(busy_, Real(static_cast<double>(Method::stages - 1)), Real(0.0));
        block_.lane_steps_executed += width;
    }

    template <int... s> SLIDEWAY_HD void stages(std::integer_sequence<int, s...>) { (stage<s + 1>(), ...); }

    template <int s> SLIDEWAY_HD void stage() {
        constexpr auto w = Method::tableau;
        constexpr bool end = s + 1 == Method::stages;
        Real* const at = end ? end_ : stage_;
        Method::template stage_state<s>(y_, k_, step_, at);
        Real const t = fma(step_, Real(w.c[s]), t_);
        auto const faults = evaluate(t, at, k_[s], end ? end_reports_ : stage_reports_, end_report_);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        faults_ = faults_.or_else(faults);
        if (!stage_reports_ || (w.b[s] == 0 && w.e[s] == 0)) return;
        Real values[Observer::integrals];
        Observer::integrands(end_report_, values);
        for (int i = 0; i < Observer::integrals; ++i) integral_[i] = fma(Real(w.b[s]), values[i], integral_[i]);
        for (int i = 0; i < Observer::audit_integrals; ++i) {
            audit_error_[i] = fma(Real(w.e[s]), values[i], audit_error_[i]);
        }
    }

    /// Mean square of the components' errors, each against its tolerance.  NaN where any is NaN.
    SLIDEWAY_HD Real squared_error_norm() const {
        Real const rtol(block_.settings.rtol), atol(block_.settings.atol);
        Real sum(0.0);
        for (int i = 0; i < size; ++i) {
            Real const tolerance = fma(rtol, max(abs(y_[i]), abs(end_[i])), atol * scale_[i]);
            Real const ratio = step_ * Method::error_slope(k_, i) / tolerance;
            sum = fma(ratio, ratio, sum);
        }
        // The damping power has a kink where a contact begins, which the states hardly feel: the audit controls its own error.
        if (audited_) {
            Real const energy = atol * Model::energy_scale(p_);
            for (int i = 0; i < Observer::audit_integrals; ++i) {
                Real const ratio = step_ * audit_error_[i] / fma(rtol, abs(observer_.integral(i)), energy);
                sum = fma(ratio, ratio, sum);
            }
        }
        return sum * Real(1.0 / size);
    }

    /// Accepts or rejects per lane.  @return lanes whose member has ended.
    SLIDEWAY_HD Mask<Real> settle() {
        Real const squared_norm = squared_error_norm();
        auto accepted = busy_ & (squared_norm <= Real(1.0));
        Real const resolution(8 * 2.220446049250313e-16 * block_.settings.end_time);
        Real const former_memory = error_memory_;
        auto cut = mask_of<Real>(false);
        Real wish = step_ * StepControl::factor(squared_norm, accepted, rejections_ > Real(0.5), error_memory_);
        if constexpr (Model::has_memory) {
            // A touch must end its step, for it sets the impact speed of what follows.
            auto const early = accepted & (step_ > resolution * Real(64.0));
            Real const fraction = touches_.earliest(early, end_report_.contact, step_, Model::touch_scale(p_));
            cut = fraction < Real(1.0);
            error_memory_ = select(cut, former_memory, error_memory_);
            accepted = accepted & !cut;
            wish = select(cut, max(step_ * fraction, resolution * Real(32.0)), wish);
        }
        auto const rejected = busy_ & !accepted;
        block_.lane_steps_useful += static_cast<std::uint64_t>(held_lanes(busy_));
        accepted_ = accepted_ + count<Real>(accepted);
        rejected_ = rejected_ + count<Real>(rejected);
        rejections_ = count<Real>(rejected & !cut);

        auto ended = mask_of<Real>(false);
        if (any(accepted)) ended = advance(accepted);
        h_ = select(busy_, min(wish, Real(block_.settings.max_step)), h_);

        auto const stuck = rejected & (h_ <= resolution);
        auto const spent =
            busy_ & !ended & (accepted_ + rejected_ >= Real(static_cast<double>(block_.settings.max_steps)));
        failure_ = faults_.within(stuck);
        not_finite_ = stuck & !(squared_norm < Real(1e300));
        stuck_ = stuck;
        return ended | stuck | spent;
    }

    /// Moves the accepted lanes to the end of their step.  @return those that reached the end time.
    SLIDEWAY_HD Mask<Real> advance(Mask<Real> accepted) {
        auto const done = accepted & last_;
        Real const t_end = select(done, Real(block_.settings.end_time), t_ + step_);
        if (block_.samples > 0) take_samples(accepted, t_end);
        if (block_.quantities != 0) observer_.accept(accepted, step_, integral_, end_report_, end_);
        for (int i = 0; i < size; ++i) y_[i] = select(accepted, end_[i], y_[i]);
        take_over(accepted, k_[Method::stages - 1]);
        t_ = select(accepted, t_end, t_);
        if (stage_reports_) keep_integrands(accepted);
        if constexpr (Model::has_memory) {
            auto const touched = touches_.update(accepted, end_report_.contact, memory_);
            if (any(touched)) restart(touched);
        }
        return done;
    }

    /// The derivative at the start of the next step.
    SLIDEWAY_HD void take_over(Mask<Real> lanes_taken, Real const* rates) {
        for (int i = 0; i < size; ++i) k_[0][i] = select(lanes_taken, rates[i], k_[0][i]);
    }

    SLIDEWAY_HD void keep_integrands(Mask<Real> lanes_taken) {
        Real values[Observer::integrals];
        Observer::integrands(end_report_, values);
        for (int i = 0; i < Observer::integrals; ++i) {
            first_integrand_[i] = select(lanes_taken, values[i], first_integrand_[i]);
        }
    }

    /// New impact speeds change the derivative at the same state.
    SLIDEWAY_HD void restart(Mask<Real> touched) {
        evaluate(t_, y_, next_k_, true, end_report_);
        evaluations_ = evaluations_ + count<Real>(touched);
        take_over(touched, next_k_);
        if (stage_reports_) keep_integrands(touched);
    }

    /// Series values at the sample times inside the accepted steps, from the dense output.
    SLIDEWAY_HD void take_samples(Mask<Real> accepted, Real t_end) {
        for (;;) {
            Real at = t_;
            bool found = false;
            bool due[width] = {};
            for (int i = 0; i < width; ++i) {
                if (!holds(accepted, i) || sample_[i] >= block_.samples) continue;
                double const time = block_.sample_times[sample_[i]];
                if (time > lane(t_end, i)) continue;
                due[i] = found = true;
                set_lane(at, i, time);
            }
            if (!found) return;
            Real const theta = select(accepted, (at - t_) / select(accepted, step_, Real(1.0)), Real(0.0));
            for (int i = 0; i < size; ++i) stage_[i] = Method::dense(k_, i, y_[i], end_[i], step_, theta);
            if (sampler_.beyond_state()) {
                Model::template derivative<true>(at, stage_, p_, memory_, next_k_, &sample_report_);
                Real const one(1.0);
                Real due_lanes(0.0);
                for (int i = 0; i < width; ++i) set_lane(due_lanes, i, due[i] ? 1.0 : 0.0);
                evaluations_ = evaluations_ + select(due_lanes == one, one, Real(0.0));
            }
            for (int i = 0; i < width; ++i) {
                if (due[i]) sampler_.write(i, member_[i], sample_[i]++, stage_, sample_report_);
            }
        }
    }

    SLIDEWAY_HD Status status_of(int index) const {
        if (holds(failure_.geometry, index)) return Status::geometry;
        if (holds(failure_.contact_domain, index)) return Status::contact_domain;
        if (holds(not_finite_, index)) return Status::nonfinite;
        if (holds(stuck_, index)) return Status::step_too_small;
        if (lane(t_, index) >= block_.settings.end_time) return Status::finished;
        return Status::max_steps;
    }

    /// Leaves the members in the lanes as if they had never begun.
    SLIDEWAY_HD void abandon() {
        for (int i = 0; i < width; ++i) {
            if (holds(busy_, i) && block_.samples > 0) sampler_.fill_missing(member_[i], 0);
        }
    }

    /// Hands over the results of members that have ended.
    SLIDEWAY_HD void retire(Mask<Real> ended) {
        for (int i = 0; i < width; ++i) {
            if (!holds(ended, i)) continue;
            auto const member = member_[i];
            double const time = lane(t_, i);
            auto const whole = [&](Real const& value) { return static_cast<std::uint64_t>(lane(value, i)); };
            block_.records[member] = {status_of(i), whole(accepted_), whole(rejected_), whole(evaluations_), time};
            for (int j = 0; j < size; ++j) block_.final_states[member * size + j] = lane(y_[j], i);
            if (block_.quantities != 0) {
                observer_.finish(i, time, block_.quantities, block_.quantity_values + member * quantity_columns);
            }
            if (block_.samples > 0) sampler_.fill_missing(member, sample_[i]);
        }
        Real occupied = count<Real>(busy_ & !ended);
        busy_ = occupied > Real(0.5);
    }

    Block& block_;
    Sampler sampler_;
    bool stage_reports_, audited_, end_reports_;
    std::size_t next_ = 0;  // of the block's queue
    std::size_t member_[width], sample_[width];

    Parameters p_;
    ImpactMemory<Real> memory_;
    Real t_, h_, step_, error_memory_;
    Real y_[size], end_[size], stage_[size], scale_[size];
    Real k_[Method::stages][size], next_k_[size];
    Real accepted_, rejected_, evaluations_, rejections_;
    Mask<Real> busy_, last_, stuck_, not_finite_;
    Faults<Real> faults_, failure_;
    Report end_report_, sample_report_;
    Observer observer_;
    Real integral_[Observer::integrals], first_integrand_[Observer::integrals], audit_error_[Observer::audit_integrals];
    TouchLocator<Real> touches_;
};

/// Integrates a block of members with one pack of lanes.
template <class Model, class Real> SLIDEWAY_HD void integrate(Block& block) {
    LaneProgram<Model, Real> program(block);
    program.run();
}

}  // namespace slideway::inline SLIDEWAY_ISA
