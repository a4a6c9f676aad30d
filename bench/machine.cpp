#include "bench/machine.hpp"

#include <fmt/format.h>

#include <cctype>
#include <fstream>

#include "host/store/run_identity.hpp"

namespace slideway {

std::string card_driver() {
    // "NVRM version: NVIDIA UNIX x86_64 Kernel Module  535.104.05  Sat Aug 19 …"
    std::ifstream file("/proc/driver/nvidia/version");
    for (std::string word; file >> word;) {
        if (std::isdigit(static_cast<unsigned char>(word.front())) && word.find('.') != std::string::npos) return word;
    }
    return "unknown";
}

std::string machine_and_build() {
    auto const& build = build_info();
    return fmt::format("- CPU: {}\n- compiler: {}\n- commit: {}\n- date: {}\n", machine_name(), build.compiler,
                       build.commit, creation_time());
}

}  // namespace slideway
