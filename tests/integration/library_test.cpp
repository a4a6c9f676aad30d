// The library of C++ programs (host/library/slideway.hpp), used by several threads at once.
#include "host/library/slideway.hpp"

#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scene_tables.hpp"

namespace slideway::library_test {
namespace {

Ensemble ensemble_of(char const* scene, std::vector<std::string> const& keys, std::vector<std::string> const& values) {
    Settings settings{{"study.verify", "0"}};
    for (std::size_t i = 0; i < keys.size(); ++i) settings.emplace_back(keys[i], values[i]);
    return Ensemble::read(std::string(SLIDEWAY_SCENES "/") + scene, settings);
}

std::string hash_of(Ensemble const& ensemble, int threads) { return ensemble.run({.threads = threads}).payload_hash(); }

}  // namespace

TEST(Library, EnsemblesInThreadsOfTheirOwnGiveWhatTheyGiveAlone) {
    std::vector<Ensemble> const ensembles = {
        ensemble_of("ensemble_starts.toml", {"study.members", "study.duration"}, {"48", "10 ms"}),
        ensemble_of("tolerance_0.1mm.toml", {"study.base", "study.duration"}, {"8", "2 ms"}),
        ensemble_of("free_slider_drop.toml", {"study.duration"}, {"20 ms"}),
    };
    std::vector<std::string> alone;
    for (Ensemble const& ensemble : ensembles) alone.push_back(hash_of(ensemble, 1));
    for (int round = 0; round < 3; ++round) {
        std::vector<std::string> together(2 * ensembles.size());
        std::vector<std::jthread> threads;
        // Each ensemble is in use twice at a time, on one and on two threads.
        for (std::size_t i = 0; i < together.size(); ++i)
            threads.emplace_back([&, i] { together[i] = hash_of(ensembles[i / 2], 1 + static_cast<int>(i % 2)); });
        threads.clear();
        for (std::size_t i = 0; i < together.size(); ++i) EXPECT_EQ(together[i], alone[i / 2]) << "ensemble " << i / 2;
    }
}

/// Tables count as they were when the scene was read.
TEST(Library, EnsemblesKeepTheirTables) {
    testing::TableFolder const folder;
    folder.write("p.csv", "time [s], force [N]\n0, 0\n1 , 40\n");
    folder.write("m.csv", "initial.y [mm]\n0.01\n0.02\n0.03\n");
    folder.write("s.toml", "schema = 1\n[load.push]\ntable = \"p.csv\"\nover = \"time\"\ncolumn = \"force\"\nforce_x = 1\nscale = 2\n"
                           "[study]\nduration = \"5 ms\"\ndesign = \"table\"\ntable = \"m.csv\"\nquantities = [\"load_work\"]\n");
    Ensemble const ensemble = Ensemble::read((folder.path / "s.toml").string());
    Settings const doubled{{"load.push.scale", "4"}};
    std::string const alone = hash_of(ensemble, 1), other = hash_of(ensemble.with(doubled), 1), linear = hash_of(ensemble.with({{"load.push.interpolation", "linear"}}), 1);
    EXPECT_NE(alone, other);
    folder.write("p.csv", "time [s], force [N]\n0, 7\n1 , 40\n");
    std::filesystem::remove(folder.path / "m.csv");
    EXPECT_EQ(hash_of(ensemble, 1), alone);
    EXPECT_EQ(hash_of(ensemble.with(doubled), 1), other);
    EXPECT_EQ(hash_of(ensemble.with(doubled).with({{"load.push.scale", "2"}}), 1), alone);
    EXPECT_EQ(hash_of(ensemble.with({{"load.push.interpolation", "linear"}}), 1), linear);
    EXPECT_THROW(ensemble.with({{"study.table", "m2.csv"}}), Error);
}

TEST(Library, RefusesWhatTheProgramRefuses) {
    auto const drop = [](char const* z) { return ensemble_of("slider_crank_0.1mm.toml", {"initial.z", "study.revolutions"}, {z, "1e-6"}); };
    EXPECT_TRUE(drop("0.1 mm").run().is_complete());
    try {
        drop("0.3 mm").run();
        ADD_FAILURE();
    } catch (Error const& error) {
        EXPECT_EQ(error.code(), 2);
        EXPECT_NE(std::string(error.what()).find(" starts inside the way, deeper than a tenth of the clearance: member 0 by 0.2"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(drop("0.3 mm").run({.any_start = true}).is_complete());
}

TEST(Library, AnErrorInOneThreadLeavesTheOthersAlone) {
    Ensemble const good = ensemble_of("ensemble_starts.toml", {"study.members", "study.duration"}, {"48", "10 ms"});
    std::string const alone = hash_of(good, 1);
    std::string beside, message;
    {
        std::jthread const runs([&] { beside = hash_of(good, 2); });
        std::jthread const fails([&] {
            try {
                ensemble_of("ensemble_starts.toml", {"joint.clearance"}, {"-1 mm"});
            } catch (Error const& error) {
                message = error.what();
            }
        });
    }
    EXPECT_EQ(beside, alone);
    EXPECT_NE(message.find("joint.clearance"), std::string::npos) << message;
}

}  // namespace slideway::library_test
