#include "host/run/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <gtest/gtest.h>

namespace slideway {
namespace {

std::string written_by(Progress::Style style, int milliseconds, std::uint64_t done, std::uint64_t before = 0) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::tmpfile(), std::fclose);
    {
        StopRequest const stop;
        Progress progress(100, before, style, file.get(), stop);
        progress.add(done);
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    }
    std::string text(static_cast<std::size_t>(std::ftell(file.get())), '\0');
    std::rewind(file.get());
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    return text;
}

TEST(ProgressLine, TellsShareRateAndTimeLeft) {
    // 25 of 100 in 10 s: 2.5 per second, 75 left take 30 s.
    EXPECT_EQ(progress_line(25, 100, 10), " 25.0 %  25 of 100 members  2.5 members/s  ETA 0:30");
    EXPECT_EQ(progress_line(100, 100, 10), "100.0 %  100 of 100 members  10 members/s  ETA 0:00");
    // 1 of 7201 in 1 s leaves two hours.
    EXPECT_NE(progress_line(1, 7201, 1).find("ETA 2:00:00"), std::string::npos);
}

TEST(ProgressLine, KnowsNoTimeLeftBeforeTheFirstMember) {
    EXPECT_NE(progress_line(0, 100, 3).find("ETA --"), std::string::npos);
    EXPECT_NE(progress_line(0, 100, 0).find("ETA --"), std::string::npos);
}

TEST(ProgressLine, CountsEarlierMembersButNotTowardsTheRate) {
    // 50 of the 75 were there before: 25 in 10 s, and the last 25 take 10 s more.
    EXPECT_EQ(progress_line(75, 100, 10, 50), " 75.0 %  75 of 100 members  2.5 members/s  ETA 0:10");
    EXPECT_NE(progress_line(50, 100, 3, 50).find("ETA --"), std::string::npos);
}

TEST(Progress, BeginsWithWhatWasDoneBefore) {
    EXPECT_NE(written_by(Progress::Style::terminal, 300, 20, 30).find("50 of 100 members"), std::string::npos);
}

TEST(Progress, IsSilentWhenQuiet) {
    EXPECT_EQ(Progress::style_for(stderr, true), Progress::Style::none);
    EXPECT_EQ(written_by(Progress::Style::none, 300, 50), "");
}

TEST(Progress, RedrawsItsLineOnATerminalAndEndsIt) {
    std::string const text = written_by(Progress::Style::terminal, 600, 50);
    EXPECT_GE(std::count(text.begin(), text.end(), '\r'), 2);
    EXPECT_NE(text.find("50 of 100 members"), std::string::npos);
    EXPECT_EQ(text.back(), '\n');
}

TEST(Progress, SaysElsewhereNothingInTheFirstSeconds) { EXPECT_EQ(written_by(Progress::Style::lines, 600, 50), ""); }

TEST(Progress, TakesAFileForNoTerminal) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::tmpfile(), std::fclose);
    EXPECT_EQ(Progress::style_for(file.get(), false), Progress::Style::lines);
}

}  // namespace
}  // namespace slideway
