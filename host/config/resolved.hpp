// What the resolved scene says of keys whose value is more than one number or choice: texts in TOML, for the table of keys (settings.hpp).
#pragma once

#include <string>

namespace slideway {
struct Scene;
struct Setting;
}  // namespace slideway

namespace slideway::resolved {

/// Of one: "0.05" of crank_length, "{ on = \"vy\", … }" of a section; "" where the scene has none.
using Text = std::string(Scene const& scene, Setting const& row);
Text schema, title, folders, mechanism, drive_table, drive_column, drive_argument, drive_gives, drive_interpolation, drive_repeats, law, number, samples, quantities, phase, section, exponents, rescalings, history, parameter, values, base, member_table;
/// Lines of a table of their own: [study.vary] …
Text variations, correlation, limits;

}  // namespace slideway::resolved
