// Why a law or a mechanism of one's own cannot be named in scenes, of modules that are not compiled: what they say of themselves is enough.
#include <gtest/gtest.h>

#include "host/backend/kernel_module.hpp"
#include "host/config/descriptors.hpp"
#include "host/config/keys.hpp"

namespace slideway::objections_test {
namespace {

std::string objection_to_law(LawInfo const& info) {
    LawKernels const law{.info = &info};
    return objection_to(ModuleKind::law, KernelModule{.law = &law});
}

std::string objection_to_key(Key const& key) {
    return objection_to_law({.name = "twin", .words = "a twin", .switches = false, .groups = {}, .keys = {&key, 1}});
}

Key key_of(std::string_view name, std::string_view unit, double preset) {
    return {name, &Inputs::law_a, unit, Rule::positive, KeyGroup::law, "stiffness", preset};
}

void expect_part(std::string const& objection, std::string const& part) { EXPECT_NE(objection.find(part), std::string::npos) << objection; }

TEST(Objections, AreToNames) {
    auto const named = [](std::string_view name) { return objection_to_law({.name = name, .words = "a law", .switches = false, .groups = {}}); };
    EXPECT_EQ(named("twin"), "");
    for (std::string_view const name : {"paper", "rigid"}) expect_part(named(name), fmt::format("slideway has a law {} of its own", name));
    for (std::string_view const name : {"", "Twin", "twin law", "2nd"}) expect_part(named(name), "small letters");
}

TEST(Objections, AreToKeys) {
    EXPECT_EQ(objection_to_key(key_of("contact.k", "N/m", 1)), "");
    expect_part(objection_to_key(key_of("contact.k", "N/m", follows)), "contact.k has no default");
    expect_part(objection_to_key(key_of("contact.k", "furlong/m", 1)), "is none of SI");
    expect_part(objection_to_key(key_of("contact.k", "N/m", -1)), "contact.k has the default -1, which its rule refuses");
    // Of another key of the tree, of a key that is no number, and of the same key with another default.
    expect_part(objection_to_key(key_of("contact.eta", "1", 1)), "known already");
    expect_part(objection_to_key(key_of("contact.law", "1", 1)), "scenes have a key contact.law already");
    expect_part(objection_to_key(key_of("contact.apex_stiffness", "N/m", 5)), "known already");
    for (std::string_view const name : {"mechanism.k", "contact.K"}) expect_part(objection_to_key(key_of(name, "N/m", 1)), "is no \"contact.\"");
}

TEST(Objections, AreToSignalsThatSayTooLittle) {
    auto const with = [](Signal const& signal) {
        MechanismInfo info = slideway::info(Mechanism{});
        info.name = "own_crank";
        info.on_cards = false;
        info.signals = {&signal, 1};
        MechanismKernels const mechanism{.info = &info};
        return objection_to(ModuleKind::mechanism, KernelModule{.mechanism = &mechanism});
    };
    EXPECT_EQ(with({"own_torque", "N m", "torque"}), "");
    EXPECT_EQ(with({nullptr, "N m", "torque"}), "one of its signals has no name");
    EXPECT_EQ(with({"own_torque", nullptr, "torque"}), "its signal own_torque has no unit");
    EXPECT_EQ(with({"own_torque", "N m", nullptr}), "its signal own_torque has no meaning");
}

}  // namespace
}  // namespace slideway::objections_test
