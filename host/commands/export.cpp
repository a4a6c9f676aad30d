#include <algorithm>
#include <cctype>
#include <filesystem>
#include <istream>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/open_file.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/study/result_summary.hpp"

namespace slideway::cli {
namespace {

/// By how it begins.
bool is_table_of_result(std::string const& path) {
    std::string head(64, '\0');
    file_stream(path)->read(head.data(), static_cast<std::streamsize>(head.size()));
    return head.starts_with("member,status") || head.starts_with("member,time [s],") || head.starts_with(mat_title);
}

/// Which tables go into the file.
std::vector<ExportTable> tables_of(ExportArguments const& arguments, ResultView const& results, bool is_mat) {
    std::vector<ExportTable> tables;
    if (is_mat || (!arguments.series && !arguments.sections)) tables.push_back(table_of_members(results));
    if (arguments.series) tables.push_back(table_of_series(results, *arguments.series));
    if (arguments.sections) tables.push_back(table_of_sections(results));
    return tables;
}

}  // namespace

int execute(ExportArguments const& arguments) {
    std::string const inputs[] = {arguments.path};
    OutputTarget const target(arguments.output, {inputs, arguments.force, is_table_of_result});
    std::string ending = std::filesystem::path(arguments.output).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    bool const is_mat = ending == ".mat";
    if (!is_mat && ending != ".csv")
        throw SceneError(fmt::format("-o {}: export writes .csv and .mat; give a name that ends with one of them", arguments.output));
    if (!is_mat && arguments.series && arguments.sections)
        throw SceneError("--series and --sections are two tables, and a CSV file holds one; use one of them, or write a .mat file");
    require_intact(arguments.path);
    ResultReader const results(arguments.path);
    std::vector<ExportTable> const tables = tables_of(arguments, results, is_mat);
    if (is_mat)
        write_mat(target, tables);
    else
        write_csv(target, tables.front());
    for (ExportTable const& table : tables) {
        std::size_t columns = 0;
        for (TableColumns const& some : table.columns) columns += some.names.size();
        std::string const rows = counted(table.members, table.name == "sections" ? "section" : "member");
        std::string const samples = table.name == "series" ? fmt::format(", {}", counted(table.samples, "sample")) : "";
        print_field(table.name, fmt::format("{}: {}{}, {}", target.name(), rows, samples, counted(columns, "column")));
    }
    return exit_code::done;
}

}  // namespace slideway::cli
