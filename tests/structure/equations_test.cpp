// docs/evidence/equations.md against docs/explanation/model.md and the code: which function computes which equation.
#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/structure/source_tree.hpp"

namespace slideway::structure::equations_test {
namespace {

struct Row { std::string label, file, name; };

std::string page(std::string const& path) {
    auto const pages = files_below({"docs"});
    auto const found = std::ranges::find(pages, path, &SourceFile::path);
    return found == pages.end() ? std::string() : found->text;
}

/// The labels of a page's displayed equations, in their order.
std::vector<std::string> labels_of(std::string const& text) {
    static Pattern const label(R"(^    .* \((M\d+\.\d+)\)$)");
    std::vector<std::string> labels;
    for (std::string const& line : lines_of(text)) {
        if (auto const found = label.match_in(line, 1)) labels.push_back(*found);
    }
    return labels;
}

/// First lines of displayed equations of which no line has a label.
std::vector<std::string> unlabelled(std::string const& text) {
    std::vector<std::string> bare;
    std::string begun;
    bool labelled = false;
    auto const end = [&] {
        if (!begun.empty() && !labelled) bare.push_back(begun);
        begun.clear();
        labelled = false;
    };
    for (std::string const& line : lines_of(text)) {
        if (!line.starts_with("    ")) {
            end();
            continue;
        }
        if (begun.empty()) begun = line;
        labelled = labelled || !labels_of(line).empty();
    }
    end();
    return bare;
}

std::vector<Row> rows_of(std::string const& text) {
    static Pattern const of_label(R"(^\| (M\d+\.\d+) \|)"), of_file(R"(\| `([\w/.]+)` \| `\w+` \|$)"),
        of_name(R"(\| `(\w+)` \|$)");
    std::vector<Row> rows;
    for (std::string const& line : lines_of(text)) {
        auto const label = of_label.match_in(line, 1);
        if (!label) continue;
        rows.push_back({*label, of_file.match_in(line, 1).value_or(""), of_name.match_in(line, 1).value_or("")});
    }
    return rows;
}

bool has_word(std::string const& code, std::string const& word) {
    auto const is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
        std::size_t const end = at + word.size();
        if ((at == 0 || !is_part(code[at - 1])) && (end == code.size() || !is_part(code[end]))) return true;
    }
    return false;
}

TEST(Equations, EachHasOneLabel) {
    auto const text = page("docs/explanation/model.md");
    for (std::string const& line : unlabelled(text)) ADD_FAILURE() << "docs/explanation/model.md: without a label: " << line;
    auto labels = labels_of(text);
    ASSERT_GT(labels.size(), 50u);
    std::ranges::sort(labels);
    auto const twice = std::ranges::adjacent_find(labels);
    EXPECT_EQ(twice, labels.end()) << *twice << " stands twice";
}

TEST(Equations, EachHasItsRow) {
    auto const labels = labels_of(page("docs/explanation/model.md"));
    std::set<std::string> const of_page(labels.begin(), labels.end());
    std::set<std::string> of_table;
    for (Row const& row : rows_of(page("docs/evidence/equations.md"))) {
        EXPECT_TRUE(of_page.contains(row.label)) << row.label << " is no equation of docs/explanation/model.md";
        of_table.insert(row.label);
    }
    for (std::string const& label : of_page) {
        EXPECT_TRUE(of_table.contains(label)) << label << " has no row in docs/evidence/equations.md";
    }
}

TEST(Equations, StandWhereTheTableSays) {
    std::map<std::string, std::string> code;
    for (SourceFile const& file : files_below({"kernels", "host"})) code[file.path] = code_only(file.text);
    auto const rows = rows_of(page("docs/evidence/equations.md"));
    ASSERT_GT(rows.size(), 50u);
    for (Row const& row : rows) {
        auto const file = code.find(row.file);
        ASSERT_NE(file, code.end()) << row.label << ": no file " << row.file;
        EXPECT_TRUE(!row.name.empty() && has_word(file->second, row.name))
            << row.label << ": " << row.file << " has no " << row.name;
    }
}

TEST(Equations, AreToldFromText) {
    EXPECT_EQ(labels_of("    a = b   (M1.1)\n    c = d\nsee (M1.2)\n"), std::vector<std::string>{"M1.1"});
    EXPECT_EQ(unlabelled("    a = b   (M1.1)\n    c\n\n    e = f\ntext\n"), std::vector<std::string>{"    e = f"});
    auto const rows = rows_of("| M1.1 | `paper` | `kernels/a.hpp` | `f` |\n");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].file + rows[0].name, "kernels/a.hppf");
    EXPECT_TRUE(has_word("int f(int)", "f"));
    EXPECT_FALSE(has_word("int of(int fa)", "f"));
}

}  // namespace
}  // namespace slideway::structure::equations_test
