// What the slider-cranks of a list say of a state, each asked through the list and by its own name.  Included by a unit per list: their
// equations take a while to compile.
#pragma once

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "kernels/laws/conservative.hpp"
#include "kernels/laws/paper.hpp"
#include "kernels/models/slider_crank_choice.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/owned_block.hpp"

namespace slideway::testing {

/// All that a model says of a state, number by number.
template <class Model> std::vector<double> answers(Model const& model, oracle::Case const& c) {
    auto const p = SliderBase::parameters(c.inputs);
    typename Model::template Memory<double> memory;
    start_memory(memory);
    if constexpr (Model::has_memory) {
        for (auto& face : memory.speeds) face = {0.01, 0.02, 0.03, 0.04};
    }
    std::vector<double> said;
    auto const say = [&](auto const&... numbers) { (said.push_back(static_cast<double>(numbers)), ...); };
    double rates[state_size];
    SliderReport<double> report{};
    double const* const state = c.state.data();
    auto const lean = model.template derivative<false>(c.t, state, p, memory, rates, &report);
    say(lean.geometry, lean.contact_domain);
    said.insert(said.end(), rates, rates + state_size);
    auto const full = model.template derivative<true>(c.t, state, p, memory, rates, &report);
    say(full.geometry, full.contact_domain);
    said.insert(said.end(), rates, rates + state_size);
    auto const& contact = report.contact;
    for (int face = 0; face < face_count; ++face) {
        for (auto const& quad : {contact.penetration[face], contact.normal_force[face]})
            say(quad.a, quad.b, quad.c, quad.d);
    }
    say(contact.surfaces, contact.lines, contact.points, contact.potential, contact.friction_power,
        contact.damping_power, contact.elastic_power);
    SliderLinearisation<double> at;
    model.linearise(c.t, state, p, memory, at);
    for (auto const* matrix : {at.joint.by_place, at.joint.by_rate}) {
        for (int i = 0; i < 5; ++i) said.insert(said.end(), matrix[i], matrix[i] + 5);
    }
    say(at.mass_y, at.mass_z, at.mass_yz, at.touching, at.rate_squared());
    say(model.contact_pattern(c.t, state, p));
    for (int apex = 0; apex < 8; ++apex)
        say(model.gap(c.t, state, p, false, apex), model.gap(c.t, state, p, true, apex));
    double end[state_size];
    for (int i = 0; i < state_size; ++i) end[i] = 1.25 * state[i];
    say(model.approach_speed(c.t, state, 1e-5, end, p));
    return said;
}

/// States in contact, of inputs to which every part of a scene matters.
inline std::vector<oracle::Case> const& states_in_contact() {
    static auto const states = [] {
        auto all = oracle::make_cases(7, 24 * 40);
        std::erase_if(all, [](oracle::Case const& c) {
            return !c.parts.friction || !c.parts.misaligned_way || c.parts.damping != Damping::rate;
        });
        return all;
    }();
    return states;
}

/// A combination of parts in a list.
struct Choice {
    Parts parts;
    std::vector<double> by_name, through_the_list;  // of all states
};

template <class Cranks, class Law_, class Friction, class Way, class Damping_> Choice choice(Law law, Damping damping) {
    Choice c{{law, damping, std::is_same_v<Friction, StickSlipFriction>, std::is_same_v<Way, MisalignedWay>}, {}, {}};
    for (oracle::Case const& state : states_in_contact()) {
        auto const append = [](std::vector<double>& to, std::vector<double> const& more) {
            to.insert(to.end(), more.begin(), more.end());
        };
        append(c.by_name, answers(SliderCrankModel<Law_, Friction, Way, Damping_>{}, state));
        append(c.through_the_list, answers(chosen_of<Cranks>(c.parts), state));
    }
    return c;
}

/// All frictions and ways.
template <class Cranks, class Law_, class Damping_> std::vector<Choice> choices(Law law, Damping damping) {
    return {choice<Cranks, Law_, NoFriction, AlignedWay, Damping_>(law, damping),
            choice<Cranks, Law_, NoFriction, MisalignedWay, Damping_>(law, damping),
            choice<Cranks, Law_, StickSlipFriction, AlignedWay, Damping_>(law, damping),
            choice<Cranks, Law_, StickSlipFriction, MisalignedWay, Damping_>(law, damping)};
}

/// Of the two lists of a law.
template <class Law_> std::vector<Choice> steady_choices(Law law) {
    using Cranks = SteadyCranksOf<Law_>;
    auto all = choices<Cranks, Law_, PointDamping>(law, Damping::point);
    for (Choice& c : choices<Cranks, Law_, RateDamping>(law, Damping::rate)) all.push_back(std::move(c));
    return all;
}
template <class Law_> std::vector<Choice> impact_choices(Law law) {
    return choices<ImpactCranksOf<Law_>, Law_, RestitutionDamping>(law, Damping::restitution);
}

/// Models that said the same could be mistaken for each other.
inline void expect_one_model_for_each(std::vector<Choice> const& list, std::size_t count) {
    EXPECT_EQ(list.size(), count);
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto const &named = list[i].by_name, &chosen = list[i].through_the_list;
        ASSERT_EQ(named.size(), chosen.size());
        ASSERT_GT(named.size(), 0u);
        for (std::size_t k = 0; k < named.size(); ++k) {
            EXPECT_TRUE(same_number(named[k], chosen[k]))
                << "place " << i << ", number " << k << ": " << named[k] << " by name, " << chosen[k];
        }
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(named, list[j].by_name) << "places " << i << " and " << j;
    }
}

}  // namespace slideway::testing
