// Results of made-up members, for tests of what is concluded from them.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "host/output/netcdf_file.hpp"
#include "host/scene/scene.hpp"
#include "kernels/status.hpp"

namespace slideway::testing {

struct MadeUpMember {
    std::uint64_t number = 0;
    Status status = Status::finished;
    double clearance = 0, eta = 0;      // of the two keys that vary
    double force = 0;                   // peak_normal_force
    std::array<double, 4> mode_time{};  // free, point, line, surface
};

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
        int const number = file.add_variable("member", NetcdfFile::Type::int32, std::array{member});
        int const status = file.add_variable("status", NetcdfFile::Type::int8, std::array{member});
        std::vector<int> numbers;
        std::vector<signed char> statuses;
        for (MadeUpMember const& m : members) {
            numbers.push_back(static_cast<int>(m.number));
            statuses.push_back(static_cast<signed char>(m.status));
        }
        file.write(number, {origin, 1}, all, numbers.data());
        file.write(status, {origin, 1}, all, statuses.data());
        auto const column = [&](char const* name, char const* unit, double MadeUpMember::*of) {
            int const variable = file.add_variable(name, NetcdfFile::Type::float64, std::array{member}, true);
            file.put_text(variable, "units", unit);
            file.put_text(variable, "long_name", std::string("made-up ") + name);
            std::vector<double> values;
            for (MadeUpMember const& m : members) values.push_back(m.*of);
            file.write(variable, {origin, 1}, all, values.data());
        };
        column("joint_clearance", "m", &MadeUpMember::clearance);
        column("contact_eta", "1", &MadeUpMember::eta);
        column("peak_normal_force", "N", &MadeUpMember::force);
        int const times =
            file.add_variable("mode_time", NetcdfFile::Type::float64, std::array{member, mode_class}, true);
        file.put_text(times, "units", "s");
        file.put_text(times, "long_name", "time spent in the mode class");
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
