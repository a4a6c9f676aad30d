#include "names.hpp"

#include <stdexcept>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"

namespace oracle {
namespace {

using slideway::Law;
using slideway::Mechanism;

struct NamedLaw {
    Law law;
    std::string_view name;
};
constexpr NamedLaw laws[] = {
#define SLIDEWAY_NAME(name, Type) {Law::name, #name},
    SLIDEWAY_LAWS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};

struct NamedMechanism {
    Mechanism mechanism;
    std::string_view name;
};
constexpr NamedMechanism mechanisms[] = {
#define SLIDEWAY_NAME(name, Type, Base) {Mechanism::name, #name},
    SLIDEWAY_MECHANISMS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};

}  // namespace

std::vector<Law> const& every_law() {
    static std::vector<Law> const list = [] {
        std::vector<Law> all;
        for (auto const& row : laws) all.push_back(row.law);
        return all;
    }();
    return list;
}

std::vector<Mechanism> const& spatial_mechanisms() {
    static std::vector<Mechanism> const list = [] {
        std::vector<Mechanism> all;
        for (auto const& row : mechanisms)
            if (states_of(row.mechanism) >= 10) all.push_back(row.mechanism);
        return all;
    }();
    return list;
}

int states_of(Mechanism mechanism) {
    switch (mechanism) {
        case Mechanism::slider_crank:
        case Mechanism::carriage:
        case Mechanism::scotch_yoke:
            return 10;
        case Mechanism::free_slider:
            return 12;  // x and vx too
        case Mechanism::slider_crank_motor:
        case Mechanism::scotch_yoke_motor:
            return 12;  // angle and speed of the crank too
        case Mechanism::planar_slider_crank:
            return 6;
    }
    throw std::invalid_argument("oracle: no such mechanism");
}

std::string name_of(Law law) {
    for (auto const& row : laws)
        if (row.law == law) return std::string(row.name);
    throw std::invalid_argument("oracle: no such law");
}

std::string name_of(Mechanism mechanism) {
    for (auto const& row : mechanisms)
        if (row.mechanism == mechanism) return std::string(row.name);
    throw std::invalid_argument("oracle: no such mechanism");
}

Law law_named(std::string_view name) {
    for (auto const& row : laws)
        if (row.name == name) return row.law;
    throw std::invalid_argument("oracle: no law is named '" + std::string(name) + "'");
}

}  // namespace oracle
