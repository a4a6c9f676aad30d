// Tables: rows of CSV, members of a study, states to probe, series of `stats`.  The first byte says which.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "host/base/csv.hpp"
#include "host/config/document.hpp"
#include "host/config/reader.hpp"
#include "host/config/scene.hpp"
#include "host/study/series_file.hpp"
#include "host/study/state_table.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace slideway::fuzz {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(std::string const& text, CsvReader::Kind kind) {
    std::istringstream in(text);
    CsvReader reader(in, "t.csv", kind);
    Rows rows;
    while (reader.next()) rows.push_back(reader.fields());
    return rows;
}

std::string quoted(std::string const& field) {
    std::string text = "\"";
    for (char const byte : field) text += byte == '"' ? std::string("\"\"") : std::string(1, byte);
    return text + '"';
}

/// What was read reads the same when it is written with quotes.
void read_rows(std::string const& text, CsvReader::Kind kind) {
    Rows rows;
    if (!accepted([&] { rows = rows_of(text, kind); })) return;
    std::string again;
    for (auto const& row : rows) {
        require(!row.empty(), "a row has fields");
        for (std::size_t i = 0; i < row.size(); ++i) again += (i == 0 ? "" : ",") + quoted(row[i]);
        again += '\n';
    }
    require(rows_of(again, CsvReader::Kind::table) == rows, "quoted fields read the same", again);
}

void read_members(std::string const& text) {
    static std::string const scene_text =
        "schema = 1\n[friction]\n[study]\nkind = \"tolerance\"\ndesign = \"table\"\ntable = \"t.csv\"\nduration = \"10 ms\"\n";
    static std::string const path = (folder() / "scene.toml").string();
    write_file(folder() / "t.csv", text);
    // Most tables are refused: for them the scene around is read once.
    static Node const document = read_document(scene_text, path, {});
    static Scene const without = [] {
        Scene of_path;
        of_path.path = path;
        return of_path;
    }();
    Scene scene = without;
    if (!accepted([&] { read_member_table(*document.find_path("study.table"), document, scene); })) return;
    if (!accepted([&] { scene = parse_scene(scene_text, path); })) return;
    MemberTable const& table = *scene.design.table;
    require(scene.members == table.rows() && table.values.size() == table.rows() * table.columns, "a member a row");
    std::string const resolved = resolved_toml(scene);
    require(resolved_toml(parse_scene(resolved, path)) == resolved, "the resolved scene resolves to itself", resolved);
    for (double const value : table.values) require(std::isfinite(value), "a table holds numbers", resolved);
    member_inputs(scene, scene.members - 1);
}

void read_states(std::string const& text) {
    static Scene const scene = parse_scene("schema = 1\n", "s.toml");
    std::istringstream in(text);
    StateTable table;
    if (!accepted([&] { table = read_state_table(in, "t.csv", scene); })) return;
    require(table.rows() == table.times.size() && table.rows() == table.parts.size() && table.rows() == table.parameter_texts.size(),
            "each row has all of it");
    for (auto const& row : table.parameter_texts) require(row.size() == table.parameter_names.size(), "each row has all parameters");
}

void read_series(std::string_view text) {
    unsigned const choice = take_choice(text, 8);
    std::istringstream in{std::string(text)};
    char const* const columns[] = {"", "y", "2", "t"};
    StoredSeries series;
    bool const read = accepted([&] {
        series = read_csv_series(in, "t.csv", columns[choice % 4], choice < 4 ? std::nullopt : std::optional(0.5));
    });
    if (read) require(series.spacing > 0 && std::isfinite(series.spacing) && !series.values.empty(), "a series has a spacing");
}

}  // namespace
}  // namespace slideway::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace slideway;
    std::string_view text = fuzz::text_of(data, size);
    unsigned const choice = fuzz::take_choice(text, 5);
    if (choice < 2) fuzz::read_rows(std::string(text), choice == 0 ? CsvReader::Kind::table : CsvReader::Kind::series);
    if (choice == 2) fuzz::read_members(std::string(text));
    if (choice == 3) fuzz::read_states(std::string(text));
    if (choice == 4) fuzz::read_series(text);
    return 0;
}
