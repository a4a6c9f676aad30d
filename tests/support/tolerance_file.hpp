// Results of made-up members, for tests of what is concluded from them.
#pragma once

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "host/config/scene.hpp"
#include "host/store/netcdf_file.hpp"
#include "kernels/status.hpp"

namespace slideway::testing {

struct MadeUpMember {
    std::uint64_t number = 0;
    Status status = Status::finished;
    double clearance = 0, eta = 0;      // of the two keys that vary
    double force = 0;                   // peak_normal_force
    std::array<double, 4> mode_time{};  // free, point, line, surface
};

/// Members [first, first + count): force is the number, mode_time[line] twice that; 10 k + 3 fail, 10 k + 7 are not
/// there.
inline std::vector<MadeUpMember> numbered_members(std::uint64_t first, std::size_t count) {
    std::vector<MadeUpMember> members(count);
    for (std::size_t i = 0; i < count; ++i) {
        MadeUpMember& m = members[i];
        m.number = first + i;
        auto const x = static_cast<double>(m.number);
        m.clearance = x * x * x;  // rank correlation with the force: 1
        m.eta = std::abs(static_cast<double>(m.number % 100) - 49.5);
        m.force = x;
        m.mode_time = {0.5, std::numeric_limits<double>::quiet_NaN(), 2 * x, -x};
        if (m.number % 10 == 3) m.status = m.number % 20 == 3 ? Status::max_steps : Status::geometry;
        if (m.status != Status::finished) m.force = 1e9, m.mode_time = {1e9, 1e9, 1e9, 1e9};
    }
    std::erase_if(members, [](MadeUpMember const& m) { return m.number % 10 == 7; });
    return members;
}

inline void shuffle(std::vector<MadeUpMember>& members) {
    std::mt19937_64 engine(21);
    for (std::size_t i = members.size(); i > 1; --i) std::swap(members[i - 1], members[engine() % i]);
}

/// Rows [first, first + rows) of a saltelli design of two inputs, force 2 x1 + x2 of uniform inputs.
inline std::vector<MadeUpMember> radial_members(std::uint64_t first, std::size_t rows) {
    std::vector<MadeUpMember> members;
    for (std::uint64_t r = first; r < first + rows; ++r) {
        double x[4];                               // A, then B
        constexpr double primes[] = {2, 3, 5, 7};  // Kronecker's sequence: independent coordinates
        for (int k = 0; k < 4; ++k) x[k] = std::fmod(static_cast<double>(r + 1) * std::sqrt(primes[k]), 1.0);
        double const inputs[4][2] = {{x[0], x[1]}, {x[2], x[3]}, {x[2], x[1]}, {x[0], x[3]}};
        for (std::uint64_t k = 0; k < 4; ++k) {
            MadeUpMember m;
            m.number = 4 * r + k;
            m.clearance = inputs[k][0];
            m.eta = inputs[k][1];
            m.force = 2 * m.clearance + m.eta;
            m.mode_time = {m.eta, m.eta * m.eta, 0.25, m.clearance};
            members.push_back(m);
        }
    }
    return members;
}

class ToleranceFile : public ::testing::Test {
protected:
    ToleranceFile()
        : folder_(std::filesystem::temp_directory_path() / ("slideway_tolerance_test_" + std::to_string(getpid()))) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~ToleranceFile() override { std::filesystem::remove_all(folder_); }
    std::string path() const { return (folder_ / "out.nc").string(); }

    /// A file of the members, in their order, still open.
    NetcdfFile write(std::vector<MadeUpMember> const& members) const {
        std::filesystem::remove(path());
        NetcdfFile file = NetcdfFile::create(path());
        std::size_t const n = members.size(), origin[2] = {0, 0}, all[1] = {n}, table[2] = {n, 4};
        int const member = file.add_dimension("member", n), mode_class = file.add_dimension("mode_class", 4);
        int const number = file.add_variable("member", DataFile::Type::int32, std::array{member});
        int const status = file.add_variable("status", DataFile::Type::int8, std::array{member});
        std::vector<int> numbers;
        std::vector<signed char> statuses;
        for (MadeUpMember const& m : members) {
            numbers.push_back(static_cast<int>(m.number));
            statuses.push_back(static_cast<signed char>(m.status));
        }
        file.write(number, {origin, 1}, all, numbers.data());
        file.write(status, {origin, 1}, all, statuses.data());
        auto const column = [&](char const* name, char const* unit, double MadeUpMember::*of) {
            int const variable = file.add_variable(name, DataFile::Type::float64, std::array{member}, true);
            file.put(variable, "units", unit);
            file.put(variable, "long_name", std::string("made-up ") + name);
            std::vector<double> values;
            for (MadeUpMember const& m : members) values.push_back(m.*of);
            file.write(variable, {origin, 1}, all, values.data());
        };
        column("joint_clearance", "m", &MadeUpMember::clearance);
        column("contact_eta", "1", &MadeUpMember::eta);
        column("peak_normal_force", "N", &MadeUpMember::force);
        int const times =
            file.add_variable("mode_time", DataFile::Type::float64, std::array{member, mode_class}, true);
        file.put(times, "units", "s");
        file.put(times, "long_name", "time spent in the mode class");
        std::vector<double> values;
        for (MadeUpMember const& m : members) values.insert(values.end(), m.mode_time.begin(), m.mode_time.end());
        file.write(times, origin, table, values.data());
        return file;
    }

    /// A scene that varies joint.clearance and contact.eta.
    static Scene scene(DesignKind kind, std::uint64_t members) {
        Scene scene;
        scene.study = StudyKind::tolerance;
        scene.members = members;
        scene.design.kind = kind;
        for (char const* const name : {"joint.clearance", "contact.eta"}) {
            Variation variation;
            variation.key = find_key(name);
            variation.line = 1;
            scene.variations.push_back(variation);
        }
        if (kind == DesignKind::saltelli) scene.design.base = members / (scene.variations.size() + 2);
        return scene;
    }
    static Limit limit(std::string quantity, std::string label, double low, double high) {
        return {std::move(quantity), std::move(label), low, high};
    }

private:
    std::filesystem::path folder_;
};

}  // namespace slideway::testing
