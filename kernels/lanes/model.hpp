#pragma once

#include <type_traits>

#include "kernels/mechanisms/faults.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/watching.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What most models leave as it is; one that has more to say hides it, in itself or in ConditionsOfBlock.
struct ModelDefaults {
    /// Whether the model brings the stepper that `auto` takes.
    static constexpr bool has_own_stepper = false;
    /// How many derivatives its linearisation is made of.
    static constexpr int evaluations_of_linearisation = 0;
    template <class Model, class Real, class Work> SLIDEWAY_HD static void with_stepper(double /*rtol*/, Work const&) {}
    SLIDEWAY_HD static void set_tolerance(double /*rtol*/) {}
    /// Reports, from here on, are of stages inside a step, which tell what is integrated and nothing else; and of that, perhaps, the audit's powers alone.
    SLIDEWAY_HD static void tell_stages(bool /*inside*/, bool /*powers_alone*/) {}
    /// Whether reports, from here on, tell the forces of faces and pins.
    SLIDEWAY_HD static void tell_forces(bool /*wanted*/) {}
    /// At which events of its contacts steps end, and whether its law switches.
    SLIDEWAY_HD static constexpr Watching watching(bool /*locate_modes*/, bool /*neighbours*/) { return Watching::nothing; }
    SLIDEWAY_HD static constexpr bool switches() { return false; }
    /// Whether anything acts on it beside weight, contact and drive.
    SLIDEWAY_HD static constexpr bool has_loads() { return false; }
    /// Whether something stiff acts on it without contact, too.
    SLIDEWAY_HD static constexpr bool has_film() { return false; }
    /// What steps take as given of the contacts, from here on.
    SLIDEWAY_HD static void hold_contacts(Watching) {}
    /// Components of the state that the drive prescribes, a bit each: neighbours cannot differ in them.
    SLIDEWAY_HD static constexpr unsigned prescribed() { return 0; }
    /// Acceleration of the equilibrium that steps of the stiff method are to follow, of each component of the state that is a place; 0 of others.
    template <class Real, class Parameters>
    SLIDEWAY_FN static void bend(Real /*t*/, Real /*step*/, Real const* /*state*/, Parameters const&, Real* /*of_state*/) {}
    /// Takes back, of members whose step has been accepted, by what it leaves constraints of the state.
    template <class Real, class Parameters> SLIDEWAY_FN static void project(Mask<Real>, Real /*t*/, Real* /*state*/, Parameters const&) {}
    /// Of a model whose impacts have no duration and that has slips: how long ago those were slips that have just come to rest [s], 0 where none has; and an
    /// offset kept to what contacts hold.
    template <class... Contacts> SLIDEWAY_FN static double since_slip(Contacts const&...) { return 0; }
    template <class... Offset> SLIDEWAY_FN static void keep_offset(Offset const&...) {}
};

inline constexpr int usual_states = 10;  // of a slider that is driven

/// How many components a model's state has: `size`, a constant; or where the model says it, which looks its equations up, as many as that at most.
template <class Model> class StateCount {
public:
    StateCount() = default;
    SLIDEWAY_FN explicit StateCount([[maybe_unused]] Model const& model) {
        if constexpr (is_said) said_ = model.states();
    }
    SLIDEWAY_FN operator int() const { return is_said ? said_ : Model::size; }
    /// Has a function see the number, as a constant where that is usual: loops of constant length hold their sums in registers.
    template <class Function> SLIDEWAY_FN void visit(Function const& see) const {
        constexpr int size = Model::size, usual = size < usual_states ? size : usual_states;
        int const n = *this;
        if (n == usual) see(std::integral_constant<int, usual>{});
        else if (n == size) see(std::integral_constant<int, size>{});
        else see(n);
    }

private:
    static constexpr bool is_said = requires(Model const& model) { model.states(); };
    int said_ = Model::size;
};

/// Whether a model's accelerations may be asked for, and its forces: it names an `Accelerations<Real>`, a `Forces<Real>`.
template <class Model> concept HasAccelerations = requires { typename Model::template Accelerations<double>; };
template <class Model> concept HasForces = requires { typename Model::template Forces<double>; };
/// Whether a model has events of its own, and brings their search.
template <class Model> concept HasEvents = requires { requires Model::events > 0; };
/// Whether impacts of a model have no duration: where a step ends its `settle` says what follows.
template <class Model> concept IsRigid = requires { requires Model::is_rigid; };
/// Whether steps may hold a model's contacts, and go by the clock of one (ContactClock).
template <class Model> concept HasClocks = Model::has_contacts && !IsRigid<Model> && Model::has_patterns && !Model::has_shadows;
/// Whether a model with impacts may be integrated by time stepping: the rule takes no shadows along.
template <class Model> concept HasTimeStepping = IsRigid<Model> && !Model::has_shadows;
/// Whether members take turns in the lanes with those that touch alike.  Those with shadows are too much to move for the little that impacts last.
template <class Model> concept Regroups = Model::has_patterns && !(IsRigid<Model> && Model::has_shadows);

/// Whether members may change to the stiff method.  Rigid ones with shadows do not.
template <class Model> concept HasStiffSteps = Model::has_linearisation && !(IsRigid<Model> && Model::has_shadows);

/// What lanes ask of a model.  The assertions name what is missing of what all models have, and for each part that a model may have the rest of it.
/// All of it is static but for the equations, which may be members: a model can look them up (kernels/models/mechanism_table.hpp).  Its parameters,
/// memory and watch hold Reals only.
/// @tparam Real a number or a pack of them
template <class Model, class Real> class ModelParts {
    template <class Number> using Parameters = typename Model::template Parameters<Number>;
    template <class Number> using Memory = typename Model::template Memory<Number>;
    template <class Number> using Report = typename Model::template Report<Number>;

    static_assert(std::is_base_of_v<ModelDefaults, Model>, "ModelDefaults: a base, of which the model hides what it does otherwise");
    static_assert(requires { typename Model::Inputs; }, "Inputs: plain numbers of one member");
    static_assert(requires { int{Model::size}; }, "size: of the state, or what room it takes at most where the model says states()");
    static_assert(requires { int{Model::series}; },
                  "series: how many columns a sample may have, which are the state, and if there are more those where state_of_series(series) says");
    static_assert(requires { typename Model::template Parameters<double>; }, "Parameters<Real>: of a member");
    static_assert(requires { typename Model::template Memory<Real>; }, "Memory<Real>: what contacts leave behind");
    static_assert(requires { typename Model::template Watch<Real>; }, "Watch<Real>: what finds the events of contacts");
    static_assert(requires { typename Model::template Report<Real>; }, "Report<Real>: what a state tells beside its derivative");
    static_assert(requires { typename Model::template Observer<Real>; },
                  "Observer<Real>: quantities on the way; with `peaks` those are looked for inside of steps");
    static_assert(requires { bool{Model::has_contacts}; bool{Model::has_patterns}; bool{Model::has_shadows}; },
                  "has_contacts, has_patterns and has_shadows: true or false");
    static_assert(requires { bool{Model::has_crossings}; bool{Model::has_linearisation}; }, "has_crossings and has_linearisation: true or false");
    static_assert(requires(Model const& m, typename Model::Inputs const& inputs) { Parameters<double>{m.parameters(inputs)}; },
                  "parameters(inputs): of a member, in double");
    static_assert(requires(Model const& m, typename Model::Inputs const& inputs, double* state) { m.initial_state(inputs, state); },
                  "initial_state(inputs, state): where a member starts, in double");
    static_assert(requires(Model const& m, Parameters<double> const& p, double* scale) { m.scales(p, scale); },
                  "scales(parameters, scale): sizes of the state's components that the absolute tolerance is meant against");
    static_assert(requires(Model const& m, Real t, Real const* y, Parameters<Real> const& p, Memory<Real> const& memory, Real* rates, Report<Real>* report) {
        Faults<Real>{m.template derivative<true>(t, y, p, memory, rates, report)};
        Faults<Real>{m.template derivative<false>(t, y, p, memory, rates, report)};
    }, "derivative<Full>(t, state, parameters, memory, rates, report): Faults; it fills the report if Full");

    // Of contacts.
    static_assert(!IsRigid<Model> || Model::has_contacts, "is_rigid: has_contacts");
    static_assert(requires(Memory<Real>& memory) { start_memory(memory); }, "start_memory(memory): what it holds before the first step");
    static_assert(!HasTimeStepping<Model> || requires { bool{Model::sees_contacts}; },
                  "is_rigid: sees_contacts, whether see(t, state, parameters, memory, contact) tells what the watch asks for without the forces");
    static_assert(!Model::has_contacts || requires(Model const& m, Report<Real> const& report) { m.switches(); m.watching(true, true); report.contact; },
                  "has_contacts: the model says switches() and watching(locate_modes, neighbours), its report has a contact");
    static_assert(!Model::has_contacts || IsRigid<Model> || requires(Parameters<Real> const& p) {
        Model::touch_scale(p);
        Model::touch_rounding(p);
    }, "has_contacts: touch_scale(parameters), length that the watch's tolerance is relative to (kernels/steppers/contact_watch.hpp); touch_rounding(parameters), "
       "what rounding leaves of a depth beside its own digits, as that of the lengths that it is a difference of: no event is located better");
    static_assert(!Model::has_shadows || Memory<Real>::speeds == 0 || requires(Parameters<Real> const& p, typename Model::template Watch<Real> const& w) {
        Model::touch_speed(p);
        w.start_depth(0);
    }, "has_shadows, of members that remember speeds: touch_speed(parameters), what those are measured in; the watch has start_depth(pair)");
    static_assert(!IsRigid<Model> || requires(Parameters<Real> const& p, Real end) { Model::located(p, end); },
                  "is_rigid: located(parameters, end), depth up to which an event counts as found; settle(...), what follows where a step has ended "
                  "(kernels/rigid), with shadows also of Tangents (kernels/lanes/saltation.hpp)");
    static_assert(!Model::has_linearisation || requires { typename Model::template Linearisation<Real>; },
                  "has_linearisation: Linearisation<Real> and linearise(...) serve the stiff method");
    static_assert(!(Model::has_patterns && Model::has_linearisation) || IsRigid<Model> || requires(Parameters<Real> const& p, Real const* y) {
        Model::energy_scale(p);
        Model::squared_speed(y, y);
    }, "has_patterns with a linearisation: energy_scale(parameters), squared_speed(state, scale) and approach_speed(...) say what is a creep and what an impact; "
       "contact_pattern(...) which lanes have like work to do; of a rigid one slip_rate(...) says how stiff its slips are");

    // Of what ends a step early.
    static_assert(!HasEvents<Model> || requires { typename Model::template Search<Model, Real>; },
                  "events: Search<Model, Real> finds them and resets the state, as tests/models/event_search.hpp does; the model says at_rest(rates)");
    static_assert(!HasEvents<Model> || (Model::template Observer<Real>::integrals == 0 && !Model::has_linearisation),
                  "an event ends its step early: integrals over the step and the stiff method's straight line do not know");
    static_assert(!HasEvents<Model> || !(Model::has_shadows || Model::has_crossings),
                  "an event ends its step early, which neither shadows nor sections know of");

public:
    static constexpr bool are_there = true;
};

}  // namespace slideway::inline SLIDEWAY_ISA
