// A folder of its own for each test, and blocks that become shards and a result file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "host/store/result_merge.hpp"
#include "host/store/shard_folder.hpp"
#include "host/store/shard_writer.hpp"

namespace slideway::testing {

inline std::string bytes_of(std::string const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void put(std::string const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

inline void flip_bit(std::string const& path, std::size_t at) {
    std::string bytes = bytes_of(path);
    bytes.at(at) = static_cast<char>(bytes.at(at) ^ 4);
    put(path, bytes);
}

/// While it lives this process can open no file, as when too many are open.
class NoMoreFiles {
public:
    NoMoreFiles() {
        getrlimit(RLIMIT_NOFILE, &before_);
        rlimit const none{0, before_.rlim_max};
        setrlimit(RLIMIT_NOFILE, &none);
    }
    ~NoMoreFiles() { setrlimit(RLIMIT_NOFILE, &before_); }
    NoMoreFiles(NoMoreFiles const&) = delete;
    NoMoreFiles& operator=(NoMoreFiles const&) = delete;

private:
    rlimit before_{};
};

class OutputFolder : public ::testing::Test {
protected:
    OutputFolder()
        : folder_(std::filesystem::temp_directory_path() / ("slideway_output_test_" + std::to_string(getpid()))) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~OutputFolder() override { std::filesystem::remove_all(folder_); }
    std::string folder() const { return folder_.string(); }
    std::string path(std::string const& name = "out.nc") const { return (folder_ / name).string(); }
    bool exists(std::string const& name) const { return std::filesystem::exists(folder_ / name); }

    /// A folder of shards with an identity and nothing else.
    std::string shards_of(RunIdentity const& identity, std::string const& name = "shards") const {
        std::string const made = path(name);
        std::filesystem::create_directories(made);
        write_durably(made + "/run.toml", identity_text(identity));
        return made;
    }

    /// Each block to a shard.
    void put_blocks(std::string const& shards, ResultLayout const& layout, Provenance const& provenance, std::vector<BlockResult> const& blocks) const {
        ShardStore store(shards);
        for (BlockResult const& block : blocks) {
            ShardImage const image = shard_image("a shard", layout, provenance, block);
            if (!image.members.empty()) store.put(image.members, image.bytes);
        }
    }

    /// The result file of blocks, by way of their shards.
    void write_result(std::string const& file, ResultLayout const& layout, Provenance const& provenance,
                      std::vector<BlockResult> const& blocks, std::string const& completeness = "complete",
                      std::function<void(DataFile&)> conclude = {}) const {
        std::string const shards =
            shards_of({"a program", "fused", layout.members, provenance.scene}, "shards_of_result");
        put_blocks(shards, layout, provenance, blocks);
        ShardFolder const from(shards);
        auto const listed = from.listed();
        struct Cleaner {
            std::string const& folder;
            ~Cleaner() { std::filesystem::remove_all(folder); }
        } const cleaner{shards};
        merge_shards(from, listed, {layout, provenance, completeness, std::move(conclude), {}}, file);
    }

private:
    std::filesystem::path folder_;
};

}  // namespace slideway::testing
