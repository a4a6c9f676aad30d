#include "host/commands/text.hpp"

#include <sstream>

#include "tests/support/tolerance_file.hpp"

namespace slideway::testing::tolerance_text_test {
namespace {

using ToleranceText = ToleranceFile;

std::string printed(ToleranceReport const& report) {
    ::testing::internal::CaptureStdout();
    cli::print_tolerance(report);
    std::fflush(stdout);
    return ::testing::internal::GetCapturedStdout();
}

void expect_lines_fit(std::string const& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::size_t columns = 0;  // of UTF-8: continuation bytes take no place
        for (char const c : line) columns += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        EXPECT_LE(columns, 120u) << line;
    }
}

std::vector<MadeUpMember> ramp(std::size_t count) {
    std::vector<MadeUpMember> members(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto const x = static_cast<double>(i);
        members[i] = {i, Status::finished, x, -x * x, 2 * x, {x, 1, 2, 3}};
    }
    return members;
}

TEST_F(ToleranceText, NamesYieldsQuantilesAndWhatMatters) {
    auto members = ramp(101);
    members[100].status = Status::max_steps;
    Scene study = scene(DesignKind::mc, 101);
    study.limits = {limit("peak_normal_force", "", 0, 100)};
    NetcdfFile const file = write(members);
    std::string const text = printed(tolerance_report(ResultView(file), study));
    expect_lines_fit(text);
    for (char const* const part :
         {"design mc", "max_steps        1", "Members that failed are counted by status", "Intervals: 95 %",
          "Yield, of 101 members that ran", "0 to 100 N", "50.495", "all limits", "peak_normal_force",
          "mode_time[free]", "joint.clearance 1.000 [1.000, 1.000]", "contact.eta -1.000", "Rank correlations"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_EQ(text.find("Sobol"), std::string::npos);
}

TEST_F(ToleranceText, RanksInputsByTheirTotalIndices) {
    std::vector<MadeUpMember> members;
    for (std::uint64_t r = 0; r < 50; ++r) {
        double const a = static_cast<double>(r * 7 % 50), b = static_cast<double>(r * 11 % 50);
        for (std::uint64_t k = 0; k < 4; ++k) {
            MadeUpMember m;
            m.number = 4 * r + k;
            m.force = k == 1 || k == 3 ? b : a;  // of the second input alone
            members.push_back(m);
        }
    }
    members[21].status = Status::geometry;
    NetcdfFile const file = write(members);
    std::string const text = printed(tolerance_report(ResultView(file), scene(DesignKind::saltelli, 200)));
    expect_lines_fit(text);
    for (char const* const part :
         {"of 49 rows of the design; 1 left out for a failed member", "distributions and yields are of the members of",
          "all first orders"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    // Inputs of a quantity stand below each other: first order, then total.
    std::istringstream lines(text.substr(text.find("of 49 rows")));
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(line);
    ASSERT_GE(rows.size(), 4u);
    EXPECT_NE(rows[2].find("peak_normal_force"), std::string::npos) << text;
    EXPECT_NE(rows[2].find("contact.eta"), std::string::npos) << text;
    EXPECT_NE(rows[3].find("joint.clearance"), std::string::npos) << text;
    EXPECT_TRUE(rows[3].ends_with("0.000 [0.000, 0.000]")) << text;
    EXPECT_EQ(text.find("Yield"), std::string::npos);
}

TEST_F(ToleranceText, SaysWhyAQuantityHasNoCorrelations) {
    auto members = ramp(101);
    for (MadeUpMember& m : members) m.mode_time[2] = 2 + 1e-13 * static_cast<double>(m.number);
    NetcdfFile const file = write(members);
    std::string const text = printed(tolerance_report(ResultView(file), scene(DesignKind::mc, 101)));
    expect_lines_fit(text);
    EXPECT_NE(text.find("mode_time[line]     - varies by 2.9e-12 s, no more than its error of 2e-06 s\n"), std::string::npos) << text;
    EXPECT_NE(text.find("mode_time[point]    - does not vary\n"), std::string::npos) << text;
}

TEST_F(ToleranceText, SaysWhenThereIsNothingToTell) {
    auto members = ramp(5);
    for (MadeUpMember& m : members) m.status = Status::nonfinite;
    NetcdfFile const file = write(members);
    std::string const text = printed(tolerance_report(ResultView(file), scene(DesignKind::mc, 5)));
    EXPECT_NE(text.find("no distributions"), std::string::npos) << text;
    EXPECT_NE(text.find("nonfinite        5"), std::string::npos) << text;
    EXPECT_EQ(text.find("Rank"), std::string::npos) << text;
}

}  // namespace
}  // namespace slideway::testing::tolerance_text_test
