// Runs on a disk that fails at some call: what is refused, what is left, and what a resumed run makes of it.
#pragma once

#include "tests/system/shards.hpp"

#include "tests/support/failing_calls.hpp"

namespace slideway::testing {

class FailingDisk : public ShardedRun {
protected:
    FailingDisk() {
        write_scene(20, "1 ms");  // two whole blocks and a part of one
        std::filesystem::create_directories(path("disk"));
        std::filesystem::rename(path("s.toml"), path("disk/s.toml"));
    }

    /// Lets the `at`-th call of a run fail, the next run goes on without failures.
    /// @return calls that failed; when none did, the run was as any other.
    std::uint64_t expect_recovery(std::uint64_t at, DiskFailure const& failure, std::string const& hash) {
        std::string const what = "call " + std::to_string(at) + " " + failure.error + (failure.once ? " once" : "") +
                                 (failure.is_short ? " after half" : "") + " " + failure.calls;
        SCOPED_TRACE(what);
        clean();
        std::string const words = run_text(options_);
        auto const failing =
            on_disk(with_failing_calls(path("disk"), path("count"), at, failure) + "timeout 30 " + words);
        std::uint64_t const failed = call_counts(path("count")).failed;
        // A write may write less than it was asked to, as long as the next one goes on.
        bool const harmless = failure.is_short && failure.once && failure.calls == std::string("write");
        if (failed == 0 || harmless) {
            EXPECT_EQ(failing.code, 0) << failing.err;
            EXPECT_EQ(hash_of("disk/o.nc"), hash);
        } else if (failing.code == 0 && failure.once) {
            ++absorbed_;
            EXPECT_EQ(hash_of("disk/o.nc"), hash);
        } else {
            expect_refusal_of_file(failing);
        }
        shards();
        auto const resumed = on_disk("timeout 30 " + words + " --resume");
        EXPECT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_EQ(resumed.err, "");
        EXPECT_EQ(hash_of("disk/o.nc"), hash);
        expect_only_results();
        return failed;
    }

    std::string whole_hash() const {
        EXPECT_EQ(on_disk(run_text("--force", "../whole.nc")).code, 0);
        return hash_of("whole.nc");
    }

    /// Every `stride`-th call from the `first` on, until a run meets no failure any more.
    /// @return runs that met one.
    int sweep(DiskFailure const& failure, std::uint64_t first, std::uint64_t stride) {
        std::string const hash = whole_hash();
        int runs = 0;
        for (std::uint64_t at = first;; at += stride, ++runs) {
            std::uint64_t const failed = expect_recovery(at, failure, hash);
            if (failed == 0 || HasFailure() || runs > 5000) break;
        }
        // HDF5 tries the last write of a file again as it closes it.
        EXPECT_LE(absorbed_, 1);
        return runs;
    }

    char const* options_ = "--threads 1 --block-members 8";

private:
    ShellOutcome on_disk(std::string const& command) const {
        // The output goes elsewhere: a full disk takes no messages.
        return shell("cd disk; " + command);
    }

    void clean() const {
        for (auto const& entry : std::filesystem::directory_iterator(path("disk"))) {
            if (entry.path().filename() != "s.toml") std::filesystem::remove_all(entry.path());
        }
        std::filesystem::remove(path("count"));
    }

    void expect_refusal_of_file(ShellOutcome const& outcome) const {
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("o.nc"), std::string::npos) << outcome.err;
    }

    void expect_only_results() const {
        std::set<std::string> names;
        for (auto const& entry : std::filesystem::directory_iterator(path("disk")))
            names.insert(entry.path().filename().string());
        EXPECT_EQ(names, (std::set<std::string>{"o.nc", "s.toml"}));
    }

    std::filesystem::path shard_folder() const override { return path("disk/o.nc.shards"); }

    int absorbed_ = 0;  // failures after which a run came to its end, and to the right result
};

}  // namespace slideway::testing
