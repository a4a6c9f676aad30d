// What a committed table must say about where it was measured.
#pragma once

#include <string>

namespace slideway {

std::string card_driver();        // "535.104.05", of cards that CUDA knows
std::string machine_and_build();  // Markdown lines: CPU, compiler, commit, date

}  // namespace slideway
