// Damaged scenes: whatever the bytes, a scene is read or refused in one line.
#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"
#include "tests/support/scene_tables.hpp"

namespace slideway::fuzz_test {
namespace {

std::string standard_scene() { return testing::read_text(SLIDEWAY_SCENES "/slider_crank_0.1mm.toml"); }

/// What is wrong with how the text is read; empty if all is well.
std::string misread(std::string_view text, int& accepted) {
    try {
        Scene const scene = testing::scene_of(text);
        if (auto const why = defect(scene.inputs)) return "accepted: " + *why;
        if (!(scene.integrator.end_time > 0)) return "accepted without an end";
        ++accepted;
        return {};
    } catch (SceneError const& error) {
        std::string_view const line = error.what();
        if (!line.starts_with("scene.toml:")) return "no file name: " + std::string(line);
        if (line.size() < 40) return "no message: " + std::string(line);
        if (line.find_first_of("\n\r") != std::string_view::npos) return "several lines: " + std::string(line);
        return {};
    } catch (std::exception const& error) {
        return std::string("other exception: ") + error.what();
    }
}

TEST(SceneFuzz, TruncationsReadOrAreRefused) {
    std::string const text = standard_scene();
    ASSERT_GT(text.size(), 500u);
    int accepted = 0;
    for (std::size_t length = 0; length < text.size(); ++length) {
        ASSERT_EQ(misread(text.substr(0, length), accepted), "") << "the first " << length << " bytes";
    }
    EXPECT_GT(accepted, 0);
}

TEST(SceneFuzz, TruncatedStudiesReadOrAreRefused) {
    for (char const* file :
         {"/poincare_0.1mm.toml", "/lyapunov_0.1mm.toml", "/sweep_clearance.toml", "/tolerance_0.1mm.toml"}) {
        std::string const text = testing::read_text(std::string(SLIDEWAY_SCENES) + file);
        ASSERT_GT(text.size(), 500u);
        int accepted = 0;
        for (std::size_t length = 0; length < text.size(); ++length) {
            ASSERT_EQ(misread(text.substr(0, length), accepted), "") << file << ", the first " << length << " bytes";
        }
        std::size_t const begin = text.find("[study]");
        for (std::size_t at = begin; at < text.size(); ++at) {
            std::string damaged = text;
            damaged[at] = damaged[at] == '0' ? '9' : '0';
            ASSERT_EQ(misread(damaged, accepted), "") << file << ", byte " << at;
        }
        EXPECT_GT(accepted, 0);
    }
}

TEST(SceneFuzz, DamagedTablesReadOrAreRefused) {
    testing::TableFolder const folder;
    std::string const text = testing::read_text(SLIDEWAY_SCENES "/tolerance_table.csv");
    ASSERT_GT(text.size(), 300u);
    int accepted = 0, refused = 0;
    auto const try_table = [&](std::string const& table) {
        folder.write("a.csv", table);
        std::string const error = folder.error("[friction]\n[study]\ndesign = \"table\"\ntable = \"a.csv\"");
        EXPECT_TRUE(error.empty() || error.starts_with("a.csv:")) << error;
        EXPECT_EQ(error.find_first_of("\n\r"), error.npos) << error;
        ++(error.empty() ? accepted : refused);
    };
    for (std::size_t at = 0; at < text.size(); ++at) {
        try_table(text.substr(0, at));
        for (char const* insert : {"\"", ",", "\n", "#", "[", "\xff", "e999"})
            try_table(std::string(text).insert(at, insert));
        try_table(std::string(text).insert(at, 1, '\0'));
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 100);
}

TEST(SceneFuzz, FlippedBytesReadOrAreRefused) {
    std::string const text = standard_scene();
    int accepted = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (unsigned char const flip : {0x01, 0x02, 0x10, 0x20, 0x80, 0xff}) {
            std::string damaged = text;
            damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ flip);
            ASSERT_EQ(misread(damaged, accepted), "") << "byte " << at << " xor " << int{flip};
        }
    }
    EXPECT_GT(accepted, 0);
}

TEST(SceneFuzz, ForeignBytesReadOrAreRefused) {
    std::string const text = standard_scene();
    int accepted = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (std::string_view const insert : {"\"", "\n", "[", "-", "=", "nan", "e9999", "\xf0\x9f\x92\xa9"}) {
            std::string damaged = text;
            damaged.insert(at, insert);
            ASSERT_EQ(misread(damaged, accepted), "") << insert << " at byte " << at;
        }
    }
    EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace slideway::fuzz_test
