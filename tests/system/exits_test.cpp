// Every exit of a run at every stage leaves either what --resume needs or a finished result and no shards.
#include <csignal>
#include <functional>

#include "tests/support/failing_calls.hpp"
#include "tests/system/shards.hpp"

namespace slideway::testing::exits_test {
namespace {

namespace fs = std::filesystem;

/// A moment of a run, told by what it has put on the disk.
struct Stage {
    char const* name;
    std::function<bool(fs::path const& folder)> is_reached;
};

bool holds(fs::path const& folder, std::string const& start) {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
        if (entry->path().filename().string().starts_with(start)) return true;
    }
    return false;
}

Stage const stages[] = {
    {"begun", [](fs::path const& folder) { return fs::exists(folder / "o.nc.shards/run-copy.toml"); }},
    {"in shards", [](fs::path const& folder) { return holds(folder / "o.nc.shards", "members-"); }},
    {"merging", [](fs::path const& folder) { return fs::exists(folder / "o.nc.part.lock") || fs::exists(folder / "o.nc"); }},
    {"finished", [](fs::path const& folder) { return fs::exists(folder / "o.nc"); }},
};

constexpr std::uint64_t all_members = 40;

/// Runs of a small scene into a folder of their own, `w`.
class Exits : public ShardedRun {
protected:
    Exits() {
        write_scene(all_members, "20 ms");
        hash_ = undisturbed_hash();
        clean();
    }

    static std::vector<std::string> words(std::vector<std::string> options = {}) {
        options.insert(options.end(), {"--threads", "1", "--block-members", "8"});
        return run_words(options, "w/o.nc");
    }
    /// Of one block.
    static std::vector<std::string> short_words() { return run_words({"--threads", "1"}, "w/o.nc"); }
    static std::string line(std::string const& options, std::string const& folder = "w") {
        return run_text("--threads 1 --block-members 8 " + options, folder + "/o.nc");
    }
    fs::path shard_folder() const override { return path("w/o.nc.shards"); }
    bool has_result() const { return fs::exists(path("w/o.nc")); }

    void clean() const {
        fs::remove_all(path("w"));
        fs::create_directory(path("w"));
    }

    void expect_only_the_result(std::string const& folder = "w") const {
        EXPECT_EQ(hash_of(folder + "/o.nc"), hash_);
        EXPECT_EQ(std::distance(fs::directory_iterator(path(folder)), fs::directory_iterator()), 1);
    }

    /// A checkpoint, or a finished result alone.  Who is killed, or whose disk fails, can clear nothing away.
    void expect_one_of_both(bool could_clear) const {
        EXPECT_TRUE(has_result() || has_shards());
        if (has_result()) {
            EXPECT_EQ(hash_of("w/o.nc"), hash_);
            EXPECT_EQ(results("w/o.nc").attribute("completeness"), "complete");
        }
        EXPECT_TRUE(!could_clear || has_result() != has_shards());
        EXPECT_FALSE(could_clear && fs::exists(path("w/o.nc.part")));
        shards();  // each of them intact
    }

    /// In a copy of what was left: a run with --force gives the result, or says that it would lose members, and loses none.
    void expect_nothing_lost_by_force() const {
        fs::remove_all(path("copy"));
        fs::copy(path("w"), path("copy"), fs::copy_options::recursive);
        ShellOutcome const forced = shell("timeout 60 " + line("--force", "copy"));
        if (forced.code == 2) {
            EXPECT_FALSE(has_result());
            EXPECT_NE(forced.err.find("add --resume to go on with it"), std::string::npos) << forced.err;
            EXPECT_EQ(shell("timeout 60 " + line("--resume", "copy")).code, 0);
        } else {
            EXPECT_EQ(forced.code, 0) << forced.err;
        }
        expect_only_the_result("copy");
    }

    /// What merge says of the folder fits what it made.
    void expect_honest_merge() const {
        // Whose result is in place have been renamed to go.
        if (shards().count() == 0 || fs::exists(path("w/o.nc.shards/finished.toml"))) return;
        Outcome const merged = run({"merge", "w/o.nc.shards", "-o", "merged.nc", "--force"});
        bool const complete = shards().count() == all_members;
        EXPECT_EQ(merged.code, complete ? 0 : 5) << merged.err;
        EXPECT_EQ(merged.out.find("w/o.nc.shards is no longer needed") != std::string::npos, complete) << merged.out;
        EXPECT_EQ(merged.out.find("w/o.nc.shards is still needed: merged.nc is not complete (") != std::string::npos, !complete) << merged.out;
    }

    void expect_recovery(bool could_clear = true) const {
        expect_one_of_both(could_clear);
        expect_honest_merge();
        expect_nothing_lost_by_force();
        for (char const* const way : {"--resume", "--force"}) {
            Outcome const outcome = run(words({way}));
            EXPECT_EQ(outcome.code, 0) << way << outcome.err;
            expect_only_the_result();
        }
    }

    /// A run that gets a signal once a stage is reached, or ends before.
    Outcome signalled(int signal, Stage const& stage, std::vector<std::string> const& words = Exits::words()) const {
        clean();
        pid_t const child = start(words);
        for (int i = 0; i < 60000 && !stage.is_reached(path("w")); ++i) {
            siginfo_t ended{};
            if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == child) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        kill(child, signal);
        return wait(child);
    }

    std::string hash_;
};

TEST_F(Exits, BySignalsOfTerminalsAndSchedulersKeepWhatIsFinished) {
    for (int const signal : {SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM}) {
        SCOPED_TRACE(strsignal(signal));
        Outcome const ended = signalled(signal, stages[1]);
        EXPECT_TRUE(ended.code == 5 || ended.code == 0) << ended.code << ended.err;
        EXPECT_TRUE(ended.code == 0 || ended.err.find("stopped early (signal)") != std::string::npos) << ended.err;
        expect_one_of_both(true);
        EXPECT_EQ(run(words({"--resume"})).code, 0);
        expect_only_the_result();
    }
}

TEST_F(Exits, ByTermAndByKillAtEveryStage) {
    for (Stage const& stage : stages) {
        for (int const signal : {SIGTERM, SIGKILL}) {
            SCOPED_TRACE(std::string(strsignal(signal)) + " " + stage.name);
            Outcome const ended = signalled(signal, stage);
            EXPECT_TRUE(ended.code == 0 || ended.code == (signal == SIGTERM ? 5 : -SIGKILL)) << ended.code << ended.err;
            expect_recovery(signal != SIGKILL);
        }
    }
}

TEST_F(Exits, OfAShortRunThatIsMergingPutItIntoShards) {
    for (int const signal : {SIGTERM, SIGHUP}) {
        Outcome const ended = signalled(signal, stages[2], short_words());
        EXPECT_TRUE(ended.code == 0 || ended.code == 5) << ended.code << ended.err;
        expect_recovery();
    }
}

TEST_F(Exits, OfAShortRunSyncTheResultAndItsFolder) {
    auto const calls = [this](char const* family, std::string const& command) {
        clean();
        fs::remove(path("count"));
        EXPECT_EQ(shell(with_failing_calls(path("w"), path("count"), 0, {.calls = family}) + command).code, 0);
        expect_only_the_result();
        return call_counts(path("count")).counted;
    };
    EXPECT_EQ(calls("sync", run_text("--threads 1", "w/o.nc")), 2u);
    EXPECT_EQ(calls("mkdir", run_text("--threads 1", "w/o.nc")), 0u);
    EXPECT_EQ(calls("mkdir", line("")), 1u);
}

/// So that no other run takes its name, and a signal finds where to put what has run.
TEST_F(Exits, OfOneLongBlockHaveAFolderFromASecondOn) {
    auto long_words = short_words();
    long_words.insert(long_words.end(), {"--block-members", "400", "--set", "study.members=400", "--set", "study.duration=2"});
    Outcome const ended = signalled(SIGTERM, stages[0], long_words);
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_TRUE(has_shards());
}

/// As a shell's nohup, and what it starts in the background.
TEST_F(Exits, DoNotComeOfSignalsThatWereIgnoredAtTheStart) {
    for (char const* const signal : {"HUP", "INT", "USR1"}) {
        clean();
        ShellOutcome const ended = shell(std::string("trap '' ") + signal + "; " + line("") + " & sleep 0.2; kill -" + signal + " $!; wait $!");
        EXPECT_EQ(ended.code, 0) << signal << ended.err;
        expect_only_the_result();
    }
}

/// A second one is no more than the first, where senders repeat it.
TEST_F(Exits, OfALimitOfTheProcessorsTimeKeepWhatIsFinished) {
    ShellOutcome const ended = shell("ulimit -S -t 1; " + run_text("--set study.members=100000 --set study.samples=0", "w/o.nc"));
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_NE(ended.err.find("stopped early (signal)"), std::string::npos) << ended.err;
    EXPECT_GT(shards().count(), 0u);
}

/// An output that is full, closed, or a pipe that nobody reads any more: the result is there all the same, and no shards beside it.
TEST_F(Exits, WhereNobodyTakesTheSummaryLeaveAFinishedResult) {
    struct Output {
        char const *before, *behind, *code;
    };
    for (Output const& output : {Output{"", ">/dev/full", "4"}, {"stdbuf -o0 ", ">/dev/full", "4"}, {"", ">&-", "4"}, {"", "<&- >&- 2>&-", "4"},
                                 {"", ">&3", "141"}, {"stdbuf -oL ", ">&3", "141"}}) {
        SCOPED_TRACE(std::string(output.before) + output.behind);
        clean();
        // Behind 3 is a pipe whose reader has gone.
        write("summary.sh", "rm -f gone; mkfifo gone; sh -c 'exec <gone' & exec 3>gone; wait\n" + (output.before + line("")) + " " + output.behind + "\n");
        ShellOutcome const ended = shell("bash summary.sh; echo code $?");
        EXPECT_EQ(ended.out, std::string("code ") + output.code + "\n") << ended.err;
        expect_only_the_result();
    }
    expect_recovery();
}

TEST_F(Exits, OfADiskThatFillsUpAtEveryStage) {
    std::uint64_t calls = 0;
    for (std::uint64_t at = 1; at < 600; at = at * 2 + 1) {
        SCOPED_TRACE("full from call " + std::to_string(at) + " on");
        clean();
        fs::remove(path("count"));
        ShellOutcome const ended = shell(with_failing_calls(path("w"), path("count"), at, {}) + "timeout 60 " + line(""));
        calls = call_counts(path("count")).counted;
        EXPECT_TRUE(ended.code == 4 || ended.code == 0) << ended.code << ended.err;
        if (has_result() || has_shards()) expect_recovery(false);
    }
    EXPECT_GT(calls, 50u);
}

TEST_F(Exits, OutOfTimeKeepWhatIsFinished) {
    EXPECT_EQ(run(words({"--max-hours", "0"})).code, 5);
    expect_recovery();
}

/// From too little for a result to nearly enough.  Below that the program cannot be loaded, which its loader says.
TEST_F(Exits, OutOfMemorySayNothingElse) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers map more than any limit";
#endif
    constexpr int loader = 127;
    std::map<int, int> ends;  // by their code
    for (int kibibytes = 60'000; kibibytes < 400'000; kibibytes += 8'000) {
        std::string const limited = "ulimit -v " + std::to_string(kibibytes) + "; ";
        for (std::string const& command : {run_text("--force --threads 2 --block-members 8", "w/o.nc"), std::string("'" SLIDEWAY_BINARY "' info whole.nc --check")}) {
            clean();
            ShellOutcome const ended = shell(limited + command);
            ++ends[ended.code];
            if (ended.code == 0 || ended.code == loader) continue;
            EXPECT_EQ(ended.code, 4) << kibibytes << command << ended.err;
            EXPECT_NE(ended.err.find("slideway: out of memory"), std::string::npos) << kibibytes << command << ended.err;
            EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
            if (has_result() || has_shards()) expect_recovery();
        }
    }
    EXPECT_GT(ends[4], 3);
    EXPECT_GT(ends[0], 3);
}

}  // namespace
}  // namespace slideway::testing::exits_test
