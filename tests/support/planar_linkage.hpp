// The slider-crank of scenes/planar_flores.toml, described as a linkage.
#pragma once

#include <string>

#include <fmt/format.h>

namespace slideway::testing {

/// A scene's beginning: what follows may say more of the block first, as offset_y; contacts, friction and study are left to it.
/// @param clearance on each side [m]
inline std::string planar_linkage(double clearance = 1e-3) {
    return fmt::format(R"(
schema = 1
[mechanism]
kind = "linkage"
crank_speed = 150
[drive]
kind = "free"
body = "crank"
[body]
crank = {{ mass = 0.038, inertia = 7.4e-5, center_x = 0.0765 }}
rod = {{ mass = 0.038, inertia = 5.9e-4, center_x = 0.153 }}
slider = {{ mass = 0.076, inertia = 2.7e-6 }}
[link]
shaft = {{ kind = "revolute", first = "ground", second = "crank" }}
crank_pin = {{ kind = "revolute", first = "crank", second = "rod", first_x = 0.153 }}
wrist_pin = {{ kind = "revolute", first = "rod", second = "slider", first_x = 0.306 }}
[link.way]
kind = "block"
first = "slider"
second = "ground"
clearance = {}
length = 0.1
height = 0.05
stiffness = 1e11
)",
                       clearance);
}

}  // namespace slideway::testing
