// What a committed table must say about where it was measured.
#pragma once

#include <string>

namespace slideway {

std::string cpu_name();           // "AMD EPYC, family 26 model 2", as the kernel names it
std::string machine_and_build();  // Markdown lines: CPU, compiler, commit, date

}  // namespace slideway
