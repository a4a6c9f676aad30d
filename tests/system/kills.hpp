// Runs that are killed at random moments and resumed.
#pragma once

#include "tests/system/shards.hpp"

#include <chrono>
#include <csignal>
#include <random>

namespace slideway::testing {

class KilledRun : public ShardedRun {
protected:
    KilledRun() { write_scene(400, "0.1 s"); }

    /// Starts and resumes runs, killed `kills` times in all at moments of a fixed seed, and lets the last one end.
    void kill_and_resume(int kills, std::vector<std::string> const& options) {
        std::string const hash = undisturbed_hash();
        std::mt19937 random(20250101);
        int done = 0;
        while (done < kills && !HasFailure()) {
            SCOPED_TRACE("after kill " + std::to_string(done));
            auto words = run_words(options);
            if (has_shards()) words.push_back("--resume");
            pid_t const child = start(words);
            std::this_thread::sleep_for(std::chrono::milliseconds(random() % longest_life));
            kill(child, SIGKILL);
            Outcome const outcome = wait(child);
            bool const was_killed = outcome.code != 0;
            if (was_killed) {
                ASSERT_EQ(outcome.code, -SIGKILL) << outcome.err;
                ++done;
                expect_kept();
            }
            // One that is killed while its process ends is done as well.
            if (!was_killed || (std::filesystem::exists(path("o.nc")) && !has_shards())) {
                EXPECT_EQ(hash_of("o.nc"), hash);
                start_over();
            }
        }
        Outcome const last = run_scene(with_resume(options));
        EXPECT_EQ(last.code, 0) << last.err;
        EXPECT_EQ(hash_of("o.nc"), hash);
        expect_no_leftovers();
    }

    static std::vector<std::string> with_resume(std::vector<std::string> options) {
        options.push_back("--resume");
        return options;
    }

    /// What was finished before is still there, and nobody ran twice.
    void expect_kept() {
        if (std::filesystem::exists(path("o.nc"))) return;  // all is in there, and the folder is on its way out
        Shards const now = shards();
        for (auto const& [name, members] : before_.listed) {
            auto const kept = now.listed.find(name);
            ASSERT_NE(kept, now.listed.end()) << name;
            EXPECT_EQ(kept->second, members) << name;
        }
        EXPECT_EQ(now.members().count(), now.count());
        before_ = now;
    }

    Shards before_;

private:
    void start_over() {
        std::filesystem::remove(path("o.nc"));
        before_ = {};
    }

    static constexpr unsigned longest_life = 600;  // ms
};

}  // namespace slideway::testing
