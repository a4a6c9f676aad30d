// What a slider-crank says of a state, its law chosen among all of the list, looked up behind pointers, and called by its own name.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host/config/keys.hpp"
#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/models/every_law.hpp"
#include "kernels/models/mechanism_model.hpp"
#include "kernels/models/mechanism_table.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/support/compiled_laws.hpp"
#include "tests/support/varied_blocks.hpp"

namespace slideway {
namespace {

/// All that a model says of a state, number by number.
template <class Model> std::vector<double> answers(Model const& model, oracle::Case const& c) {
    auto const p = SliderCrank::parameters(c.inputs);
    ContactMemory<double> memory;
    start_memory(memory);
    for (auto& face : memory.impact_speed) face = {0.01, 0.02, 0.03, 0.04};
    std::vector<double> said;
    auto const say = [&](auto const&... numbers) { (said.push_back(static_cast<double>(numbers)), ...); };
    double rates[state_size];
    typename Model::template Report<double> report{};
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
    say(model.contact_pattern(c.t, state, p, memory));
    for (int apex = 0; apex < 8; ++apex)
        say(model.gap(c.t, state, p, false, apex), model.gap(c.t, state, p, true, apex));
    double end[state_size];
    for (int i = 0; i < state_size; ++i) end[i] = 1.25 * state[i];
    say(model.approach_speed(c.t, state, 1e-5, end, p));
    say(model.switches(), model.watching(true, true), model.watching(true, false), model.watching(false, true),
        model.watching(false, false));
    return said;
}

/// States in contact, of inputs to which every part of a scene matters, and the numbers that a law has of its own.
std::vector<oracle::Case> const& states_in_contact() {
    static auto const states = [] {
        auto all = oracle::make_cases(7, 24 * 40);
        std::erase_if(all, [](oracle::Case const& c) {
            return !c.parts.friction || !c.parts.misaligned_way || c.parts.damping != Damping::rate;
        });
        for (oracle::Case& c : all) c.inputs.law_a = 3e7, c.inputs.law_b = 40;
        return all;
    }();
    return states;
}

template <class Model> std::vector<double> answers_of_all(Model const& model) {
    std::vector<double> said;
    for (oracle::Case const& state : states_in_contact()) {
        auto const more = answers(model, state);
        said.insert(said.end(), more.begin(), more.end());
    }
    return said;
}

template <class Laws> auto crank(Conditions<Laws> const& conditions) {
    return MechanismModel<SliderCrank, SliderBase, Laws>(conditions);
}

/// A combination of parts.
struct Choice {
    Parts parts;
    std::vector<double> by_name, among_all, behind_pointers;  // of all states
};

template <class Law_, class Damping_> void add_choices(Law law, Damping damping, std::vector<Choice>& all) {
    using Table = MechanismTable<double, SliderBase>;
    for (bool const friction : {false, true}) {
        for (bool const misaligned : {false, true}) {
            Parts const parts{law, damping, friction, misaligned};
            Conditions<OneLaw<Law_, Damping_>> const named({}, Law_::info.switches, parts);
            Table const table(Table::Functions::of<SliderCrank>(), testing::conditions_of<double>(parts));
            all.push_back({parts, answers_of_all(crank(named)), answers_of_all(crank(conditions_with_every_law(parts))),
                           answers_of_all(table)});
        }
    }
}

template <class Law_> void add_law(Law law, std::vector<Choice>& all) {
    add_choices<Law_, PointDamping>(law, Damping::point, all);
    if constexpr (Law_::info.has(Damping::rate)) add_choices<Law_, RateDamping>(law, Damping::rate, all);
    if constexpr (Law_::info.has(Damping::restitution))
        add_choices<Law_, RestitutionDamping>(law, Damping::restitution, all);
}

std::vector<Choice> every_choice() {
    std::vector<Choice> all;
#define SLIDEWAY_ADD(name, Type) add_law<Type>(Law::name, all);
    SLIDEWAY_LAWS(SLIDEWAY_ADD)
#undef SLIDEWAY_ADD
    return all;
}

// Models that said the same could be mistaken for each other.
TEST(LawChoice, CallsEachLawWithEachOfItsDampings) {
    auto const list = every_choice();
    EXPECT_EQ(list.size(), testing::all_parts().size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        SCOPED_TRACE(testing::name_of(list[i].parts));
        auto const& named = list[i].by_name;
        ASSERT_GT(named.size(), 0u);
        for (auto const* chosen : {&list[i].among_all, &list[i].behind_pointers}) {
            ASSERT_EQ(named.size(), chosen->size());
            for (std::size_t k = 0; k < named.size(); ++k) {
                EXPECT_TRUE(testing::same_number(named[k], (*chosen)[k]))
                    << "number " << k << ": " << named[k] << " by name, " << (*chosen)[k];
            }
        }
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(named, list[j].by_name) << testing::name_of(list[j].parts);
    }
}

}  // namespace
}  // namespace slideway
