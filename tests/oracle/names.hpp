// Every law and every mechanism of the tree with its name, from the two lists: what loops over these forgets none.
#pragma once

#include <kernels/inputs.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace oracle {

std::vector<slideway::Law> const& every_law();
/// Those that `evaluate` knows: eight apices on a way with four faces.
std::vector<slideway::Mechanism> const& spatial_mechanisms();

/// How many numbers the mechanism's state has.
int states_of(slideway::Mechanism mechanism);

/// @throws std::invalid_argument for a name or a value that is in no list
std::string name_of(slideway::Law law);
std::string name_of(slideway::Mechanism mechanism);
slideway::Law law_named(std::string_view name);

}  // namespace oracle
