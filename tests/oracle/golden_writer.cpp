// Writes a golden table of a law that model.md's tables do not have: the states and parameters of one of them, under
// that law, with numbers drawn for what the law has of its own, computed by the oracle in 80 bits.
//   golden_writer STATES.csv LAW given|follows ROWS > TABLE.csv
// `given`: a stiffness of the law in every row; `follows`: no column for it.  Rows are taken evenly from the states.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "golden_table.hpp"
#include "kernels/laws/list.hpp"
#include "names.hpp"
#include "random_inputs.hpp"

namespace {

using oracle::detail::Dice;
using Strings = std::vector<std::string>;

/// A column of the law's own, and how its numbers are drawn.
struct OwnColumn {
    std::string name;
    std::function<double(Dice&)> draw;
};

std::vector<OwnColumn> own_columns(slideway::Law law, bool stiffness_is_given) {
    switch (law) {
        case slideway::Law::paper:
        case slideway::Law::conservative:
            return {};
        case slideway::Law::foundation:
            if (!stiffness_is_given) return {};
            return {{"contact.bed_stiffness", [](Dice& dice) { return dice.scale(1e9, 1e14); }}};
        case slideway::Law::kelvin_voigt: {
            std::vector<OwnColumn> columns;
            if (stiffness_is_given)
                columns.push_back({"contact.apex_stiffness", [](Dice& dice) { return dice.scale(1e5, 1e10); }});
            columns.push_back(
                {"contact.apex_damping", [](Dice& dice) { return dice.chance(0.25) ? 0 : dice.scale(1, 1e4); }});
            return columns;
        }
    }
    throw std::invalid_argument("golden_writer: no such law");
}

/// What the published laws have and this one has not.
bool is_of_other_laws(std::string const& column, slideway::Law law) {
    if (column == "contact.chi_surface") return law != slideway::Law::foundation;
    static Strings const list = {
        "contact.eta",         "contact.chi_line",       "contact.edge_radius",
        "contact.apex_radius", "contact.hertz_exponent", "contact.slider_poisson_ratio", "contact.way_poisson_ratio"};
    return std::find(list.begin(), list.end(), column) != list.end();
}

std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

void print(Strings const& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) std::printf("%s%s", i == 0 ? "" : ",", cells[i].c_str());
    std::printf("\n");
}

void write(std::string const& file, slideway::Law law, bool stiffness_is_given, std::size_t rows) {
    auto const states = golden::Table::read(file);
    auto const own = own_columns(law, stiffness_is_given);
    auto const& computed = golden::computed_columns();
    Strings given;
    for (auto const& column : states.columns()) {
        bool const is_computed = std::find(computed.begin(), computed.end(), column) != computed.end();
        if (!is_computed && !is_of_other_laws(column, law)) given.push_back(column);
    }
    Strings header = {given.front()};  // contact.law
    for (auto const& column : own) header.push_back(column.name);
    header.insert(header.end(), given.begin() + 1, given.end());

    Strings whole = header;
    whole.insert(whole.end(), computed.begin(), computed.end());
    print(whole);
    Dice dice(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        std::size_t const row = i * states.rows() / rows;
        Strings cells = {oracle::name_of(law)};
        for (auto const& column : own) cells.push_back(digits(column.draw(dice)));
        for (std::size_t j = 1; j < given.size(); ++j) cells.push_back(states.text(row, given[j]));
        golden::Table one(header);
        one.add(cells);
        auto const c = golden::case_of(one, 0);
        auto const results = golden::computed_row(oracle::evaluate(c.inputs, c.parts, c.t, c.state));
        cells.insert(cells.end(), results.begin(), results.end());
        print(cells);
    }
}

}  // namespace

int main(int count, char** arguments) try {
    Strings const words(arguments + 1, arguments + count);
    if (words.size() != 4 || (words[2] != "given" && words[2] != "follows"))
        throw std::invalid_argument("golden_writer STATES.csv LAW given|follows ROWS");
    write(words[0], oracle::law_named(words[1]), words[2] == "given", std::stoul(words[3]));
} catch (std::exception const& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
