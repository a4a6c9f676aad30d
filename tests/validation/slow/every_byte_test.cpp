// Every byte of a result changed, one after another: told, or no part of what is read.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/store/result_view.hpp"

namespace slideway::every_byte_test {
namespace {

std::string bytes_of(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

constexpr std::size_t parts = 8;

/// A part of the bytes: all of them take one process ten minutes and more.
class EveryByte : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EveryByte, OfAResultIsToldOrDoesNotMatter) {
    auto const folder = std::filesystem::temp_directory_path() / ("slideway_bytes_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::string const file = (folder / "s.nc").string();
    std::string const command = fmt::format("{} run {}/ensemble_starts.toml --set study.members=4 --set study.samples=5 --set study.duration=0.002 "
                                            "--quiet -o {}", SLIDEWAY_BINARY, SLIDEWAY_SCENES, file);
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::string const whole = bytes_of(file);
    SealCheck const before = check_result(file);
    std::size_t tried = 0, refused = 0, crashes = 0;
    std::string changed = whole;
    for (std::size_t at = GetParam(); at < whole.size(); at += parts) {
        ++tried;
        changed[at] = static_cast<char>(whole[at] ^ (1 << at % 8));
        std::ofstream(file, std::ios::binary) << changed;
        changed[at] = whole[at];
        try {
            SealCheck const found = check_result(file);
            if (found.intact()) {
                EXPECT_EQ(found.payload_found, before.payload_found) << at;
                EXPECT_EQ(found.metadata_found, before.metadata_found) << at;
            } else {
                ++refused;
            }
        } catch (FileError const& error) {
            ++refused;
            std::string const line = error.what();
            EXPECT_EQ(line.find('\n'), std::string::npos) << at << line;
            crashes += line.find("damaged so badly") != line.npos ? 1 : 0;
        }
    }
    std::printf("%zu bytes: %zu refused, %zu of them because the library crashes\n", tried, refused, crashes);
    EXPECT_GT(refused, tried / 2);
    std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Parts, EveryByte, ::testing::Range<std::size_t>(0, parts));

}  // namespace
}  // namespace slideway::every_byte_test
