// The words of errors, whole lines of them: tests/errors/scenes.txt.
#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/scene_fixture.hpp"

namespace slideway::error_examples_test {
namespace {

TEST(ErrorExamples, AreRefusedByTheLineThatStandsThere) {
    constexpr std::string_view heading = "### ", answer = "=> ";
    std::istringstream lines(testing::read_text(SLIDEWAY_TEST_DATA "/errors/scenes.txt"));
    std::string group, scene;
    int examples = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(heading)) {
            group = line.substr(heading.size());
        } else if (line.starts_with(answer)) {
            EXPECT_EQ(testing::error_of(scene), line.substr(answer.size())) << group << '\n' << scene;
            scene.clear();
            ++examples;
        } else if (!group.empty() && !(scene.empty() && line.empty())) {
            scene += line + '\n';
        }
    }
    EXPECT_EQ(scene, "");
    EXPECT_GE(examples, 106);
}

}  // namespace
}  // namespace slideway::error_examples_test
