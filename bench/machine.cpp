#include "bench/machine.hpp"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <thread>

#include "host/output/provenance.hpp"

namespace slideway {

namespace {

/// The first value of a key of /proc/cpuinfo; "unknown" without it.
std::string cpu_info(std::string const& key) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        auto const colon = line.find(": ");
        if (colon != std::string::npos && line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) == key) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

}  // namespace

std::string cpu_name() {
    return fmt::format("{}, family {} model {}", cpu_info("model name"), cpu_info("cpu family"), cpu_info("model"));
}

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
    return fmt::format("- CPU: {} ({} threads)\n- compiler: {}\n- commit: {}\n- date: {}\n", cpu_name(),
                       std::thread::hardware_concurrency(), build.compiler, build.commit, creation_time());
}

}  // namespace slideway
