// An ensemble whose shards are left, damaged and taken up again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/store/shard_folder.hpp"
#include "tests/system/results.hpp"

namespace slideway::testing {

namespace fs = std::filesystem;

inline constexpr char const* resumed_scene = R"(
schema = 1
title = "A resumed ensemble"
[contact]
law = "conservative"
[friction]
[study]
members = 64
duration = "5 ms"
samples = 5
quantities = ["energy_residual", "mode_time"]
[study.vary]
"initial.y" = { dist = "unif", low = "-0.09 mm", high = "0.09 mm" }
)";

class Resumed : public ProgramWithResults {
protected:
    Resumed() { write("s.toml", resumed_scene); }
    Outcome run_scene(std::vector<std::string> options) const {
        options = to_result(std::move(options));
        options.insert(options.begin(), {"run", "s.toml", "--threads", "2"});
        return run(std::move(options));
    }
    bool exists(std::string const& name) const { return fs::exists(path(name)); }
    std::string shard(std::uint64_t first) const { return fmt::format("s.nc.shards/members-{:010}.nc", first); }

    /// All members in shards of eight, not merged.
    void make_shards() const {
        EXPECT_EQ(run_scene({"--no-progress", "--block-members", "8", "--shard", "1/1"}).code, 0);
        EXPECT_EQ(shards_in("s.nc.shards"), 8u);
        EXPECT_FALSE(exists("s.nc"));
    }
    /// As those of a card are whose compiler joined multiplications and additions.
    void let_shards_be_contracted() const {
        std::string const folder = path("s.nc.shards").string();
        RunIdentity identity = ShardFolder(folder).identity();
        ASSERT_EQ(identity.arithmetic, "fused");
        identity.arithmetic = "contracted";
        write_identity(folder, identity);
    }
    /// Without those of members 16 to 23 and 40 to 47.
    void make_unfinished() const {
        make_shards();
        for (std::uint64_t const first : {16u, 40u}) EXPECT_TRUE(fs::remove(path(shard(first))));
    }
};

}  // namespace slideway::testing
