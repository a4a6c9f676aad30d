// How large the layers may be.  A ceiling falls with what it holds; a commit that raises one says why in its body.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure::budgets_test {
namespace {

/// C++ of a folder, and what is counted in it.
struct Layer {
    std::vector<SourceFile> files;

    explicit Layer(std::string const& folder) : files(files_below({folder})) {
        std::erase_if(files, [](SourceFile const& f) { return !f.path.ends_with(".hpp") && !f.path.ends_with(".cpp"); });
    }

    std::size_t lines() const {
        std::size_t sum = 0;
        for (SourceFile const& file : files) sum += lines_of(file.text).size();
        return sum;
    }
    /// Lines of code, comments left aside, that a pattern matches: of all files, and of the file that has most.
    struct Count { std::size_t in_all = 0, most = 0; };
    Count count(Pattern const& pattern) const {
        Count found;
        for (SourceFile const& file : files) {
            auto const lines = lines_of(code_only(file.text));
            auto const here = static_cast<std::size_t>(std::ranges::count_if(lines, [&](auto const& line) { return pattern.match_in(line).has_value(); }));
            found.in_all += here;
            found.most = std::max(found.most, here);
        }
        return found;
    }
};

TEST(Budgets, OfLines) {
    EXPECT_LE(Layer("kernels").lines(), 22'052u);
    EXPECT_LE(Layer("kernels/linkage").lines(), 1'738u);
    EXPECT_LE(Layer("kernels/rigid").lines(), 4'267u);
    EXPECT_LE(Layer("kernels/lanes").lines(), 3'996u);
    EXPECT_LE(Layer("host").lines(), 33'351u);
    EXPECT_LE(Layer("host/store").lines(), 4'464u);
}

TEST(Budgets, OfTypes) {
    Layer const kernels("kernels");
    Pattern const type(R"(^\s*(template <.*> )?(struct|class|enum class) [A-Z]\w*( final)?\s*(:|\{))");
    EXPECT_LE(kernels.count(type).in_all, 433u);
    EXPECT_LE(Layer("host").count(type).in_all, 391u);
    EXPECT_LE(Layer("host/store").count(type).in_all, 46u);
    EXPECT_LE(kernels.count(Pattern(R"(^\s*(template <.*> )?struct No[A-Z]\w*)")).in_all, 5u) << "types that stand for a part that a model has not";
}

TEST(Budgets, OfChoicesInSteps) {
    auto const choices = Layer("kernels/lanes").count(Pattern("if constexpr"));
    EXPECT_LE(choices.in_all, 30u);
    EXPECT_LE(choices.most, 5u) << "in one file";
}

}  // namespace
}  // namespace slideway::structure::budgets_test
