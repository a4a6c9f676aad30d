// Runs whose members are kept in a folder of shards until they are all there, and what that folder holds.
#pragma once

#include "tests/system/results.hpp"

#include <map>
#include <set>
#include <sstream>

#include "host/run/member_set.hpp"
#include "host/store/result_view.hpp"
#include "tests/support/mpirun.hpp"

namespace slideway::testing {

/// What the manifests of a folder say: finished members by the name of their file.
struct Shards {
    std::map<std::string, MemberSet> listed;

    MemberSet members() const {
        MemberSet all;
        for (auto const& [name, members] : listed) all.add(members);
        return all;
    }
    std::uint64_t count() const {
        std::uint64_t sum = 0;
        for (auto const& [name, members] : listed) sum += members.count();
        return sum;
    }
};

class ShardedRun : public ProgramWithResults {
protected:
    /// A run of `members` that takes little time, or about as long as `duration` says.
    void write_scene(int members, char const* duration) const {
        write("s.toml", "schema = 1\ntitle = \"In shards\"\n[contact]\nlaw = \"paper\"\n[friction]\n[study]\nmembers = " + std::to_string(members) +
                            "\nduration = \"" + duration +
                            "\"\nsamples = 4\nquantities = [\"energy_residual\", \"mode_time\"]\n[study.vary]\n"
                            "\"initial.y\" = { dist = \"unif\", low = \"-0.09 mm\", high = \"0.09 mm\" }\n");
    }

    /// `run s.toml -o o.nc` with these options, as words.
    static std::vector<std::string> run_words(std::vector<std::string> const& options,
                                              std::string const& output = "o.nc", std::string const& isa = "scalar") {
        std::vector<std::string> words{"run", "s.toml", "-o", output, "--no-progress", "--isa", isa};
        words.insert(words.end(), options.begin(), options.end());
        return words;
    }
    Outcome run_scene(std::vector<std::string> const& options) const { return run(run_words(options)); }
    /// The same as a command of a shell.
    static std::string run_text(std::string const& options, std::string const& output = "o.nc",
                                std::string const& isa = "scalar") {
        return "'" SLIDEWAY_BINARY "' run s.toml --no-progress --isa " + isa + " -o " + output + " " + options;
    }
    ShellOutcome shell(std::string const& command) const { return run_shell(path(""), command); }

    /// The hash of the scene's results, from a run that nothing disturbed; with the widest instructions, which is soon done.
    std::string undisturbed_hash() const {
        EXPECT_EQ(run(run_words({"--force"}, "whole.nc", "auto")).code, 0) << file_text(path("err"));
        return hash_of("whole.nc");
    }

    virtual std::filesystem::path shard_folder() const { return path("o.nc.shards"); }
    bool has_shards() const { return std::filesystem::exists(shard_folder()); }

    /// Reads the manifests, whole lines of them, and finds every file that they list intact.
    Shards shards() const {
        Shards found;
        if (!has_shards()) return found;
        for (auto const& entry : std::filesystem::directory_iterator(shard_folder())) {
            std::string const name = entry.path().filename().string();
            if (!name.starts_with("manifest-")) continue;
            std::istringstream lines(file_text(entry.path()));
            for (std::string line; std::getline(lines, line) && !lines.eof();) read_line(line, found);
        }
        return found;
    }

    /// Nothing is left of the work but its result.
    void expect_no_leftovers() const {
        for (auto const& entry : std::filesystem::directory_iterator(path(""))) {
            std::string const name = entry.path().filename().string();
            for (char const* const part : {".part", ".tmp", ".shards", "lock"}) {
                EXPECT_EQ(name.find(part), std::string::npos) << name;
            }
        }
    }

private:
    /// FNV-1a of 64 bits as its authors define it, in hexadecimal digits.
    static std::string hash_of_bytes(std::string const& bytes) {
        std::uint64_t hash = 0xcbf29ce484222325;
        for (char const byte : bytes) {
            hash ^= static_cast<unsigned char>(byte);
            hash *= 0x100000001b3;
        }
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
        return digits;
    }

    /// `name bytes checksum members checksum-of-the-line`
    void read_line(std::string const& line, Shards& found) const {
        std::istringstream words(line);
        std::string file, checksum, member_text, own;
        std::uintmax_t bytes = 0;
        words >> file >> bytes >> checksum >> member_text >> own;
        auto const members = MemberSet::parse(member_text);
        ASSERT_TRUE(words && members) << line;
        EXPECT_TRUE(file.starts_with("members-")) << line;
        EXPECT_EQ(std::filesystem::file_size(shard_folder() / file), bytes) << line;
        EXPECT_FALSE(found.listed.contains(file)) << line;
        EXPECT_EQ(hash_of_bytes(file_text(shard_folder() / file)), checksum) << line;
        EXPECT_EQ(hash_of_bytes(line.substr(0, line.rfind(' '))), own);
        ResultReader const results((shard_folder() / file).string());
        EXPECT_EQ(results.stored_hash(), results.computed_hash()) << line;
        std::vector<std::uint64_t> inside;
        for (double const member : results.values("member")) inside.push_back(static_cast<std::uint64_t>(member));
        EXPECT_EQ(MemberSet::of(inside), *members) << line;
        found.listed[file] = *members;
    }
};

}  // namespace slideway::testing
