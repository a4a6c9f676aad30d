#include "host/run/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

namespace slideway::progress_test {
namespace {

std::string written_by(Progress::Style style, int milliseconds, std::uint64_t done, std::uint64_t before = 0) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::tmpfile(), std::fclose);
    {
        StopRequest const stop;
        Progress progress({100, before}, style, file.get(), stop);
        progress.add_distant(done);
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    }
    std::string text(static_cast<std::size_t>(std::ftell(file.get())), '\0');
    std::rewind(file.get());
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    return text;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

TEST(ProgressLine, TellsShareRateAndTimeLeft) {
    EXPECT_EQ(progress_line({1024}, 384, 0.375, 12.34, 51.2), " 37.5 %  384 of 1024 members  12.3 members/s  ETA 0:52");
    EXPECT_EQ(progress_line({100}, 100, 1, 10, 0), "100.0 %  100 of 100 members  10 members/s  ETA 0:00");
    EXPECT_NE(progress_line({7201}, 1, 1 / 7201., 1, 7200).find("ETA 2:00:00"), std::string::npos);
    EXPECT_NE(progress_line({100}, 0, 0, 0, unknown).find("ETA --"), std::string::npos);
}

TEST(ProgressLine, SaysOfACheckWhatItIs) {
    ProgressTask task{16};
    task.is_check = true;
    EXPECT_EQ(progress_line(task, 3, 0.4, 12, 4.5), "checking:  40.0 % of 16 members  ETA 0:05");
}

TEST(ProgressLine, SaysThatACheckFollowsWhichTheTimeLeftLeavesOut) {
    ProgressTask task{16};
    task.check_follows = true;
    EXPECT_TRUE(progress_line(task, 8, 0.5, 1, 8).ends_with("ETA 0:08, then a check"));
}

TEST(Progress, SharesWhatWorkersCovered) {
    StopRequest const stop;
    Progress progress({10, 2}, Progress::Style::none, stderr, stop);
    EXPECT_DOUBLE_EQ(progress.share(), 0.2);
    auto &one = progress.worker().covered, &other = progress.worker().covered;
    one = 1.5;
    other = 0.25;
    EXPECT_DOUBLE_EQ(progress.share(), 0.375);
    progress.add_distant(3);
    EXPECT_DOUBLE_EQ(progress.share(), 0.675);
}

TEST(Progress, CountsMembersThatEndedOfBlocksUnderWay) {
    StopRequest const stop;
    Progress progress({12, 1}, Progress::Style::none, stderr, stop);
    EXPECT_EQ(progress.ended(), 1u);
    auto &one = progress.worker().ended, &other = progress.worker().ended;
    one = 5;
    other = 3;
    EXPECT_EQ(progress.ended(), 9u);
    progress.add_distant(2);
    EXPECT_EQ(progress.ended(), 11u);
    // A block that is given up begins again.
    one = 0;
    EXPECT_EQ(progress.ended(), 11u);
    one = 7;
    EXPECT_EQ(progress.ended(), 12u) << "never more than there are";
}

TEST(Progress, NeverGoesBackNorBeyondTheEnd) {
    StopRequest const stop;
    Progress progress({4}, Progress::Style::none, stderr, stop);
    auto& covered = progress.worker().covered;
    covered = 3;
    EXPECT_EQ(progress.share(), 0.75);
    covered = 1;
    EXPECT_EQ(progress.share(), 0.75);
    covered = 4 + 1e-9;
    EXPECT_EQ(progress.share(), 1);
}

TEST(Progress, WeighsMembersOfParts) {
    StopRequest const stop;
    ProgressTask task{6};
    task.work = 6 * 4 + 6 * 10;
    Progress progress(task, Progress::Style::none, stderr, stop);
    progress.worker(4).covered = 6;
    EXPECT_DOUBLE_EQ(progress.share(), 24. / 84);
    progress.worker(10).covered = 3;
    EXPECT_DOUBLE_EQ(progress.share(), 54. / 84);
}

TEST(Progress, IsDoneWhereThereIsNothingToDo) {
    StopRequest const stop;
    EXPECT_EQ(Progress({}, Progress::Style::none, stderr, stop).share(), 1);
}

TEST(Progress, BeginsWithWhatWasDoneBefore) {
    std::string const text = written_by(Progress::Style::terminal, 300, 20, 30);
    EXPECT_NE(text.find(" 50.0 %  50 of 100 members"), std::string::npos);
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

TEST(Progress, SaysElsewhereNothingInTheFirstSecond) { EXPECT_EQ(written_by(Progress::Style::lines, 600, 50), ""); }

TEST(Progress, TakesAFileForNoTerminal) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::tmpfile(), std::fclose);
    EXPECT_EQ(Progress::style_for(file.get(), false), Progress::Style::lines);
}

}  // namespace
}  // namespace slideway::progress_test
