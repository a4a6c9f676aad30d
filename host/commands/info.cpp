#include <fmt/format.h>

#include "host/commands/commands.hpp"
#include "host/commands/json.hpp"
#include "host/commands/orbit_text.hpp"
#include "host/commands/text.hpp"
#include "host/commands/tolerance_text.hpp"
#include "host/config/scene_text.hpp"
#include "host/store/result_reader.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/study_run.hpp"
#include "host/study/verification.hpp"

namespace slideway::cli {

namespace {

/// The report of a result whose scene has one.
std::optional<ToleranceReport> report_of(ResultReader const& results) {
    try {
        Scene const scene = parse_scene(results.attribute("scene"), results.path());
        if (asks_for_report(scene)) return tolerance_report(results, scene);
    } catch (SceneError const& error) {
        // Of another version, or its table of members is elsewhere.
        tell("warning: {}\n", error.what());
    }
    return {};
}

void print_members(ResultReader const& results, MemberRange const& range) {
    fmt::print("\n{:>10}  {:<16} {:>14} {:>12} {:>12}\n", "member", "status", "end time [s]", "steps", "rejected");
    for (MemberRow const& member : member_rows(results, range)) {
        fmt::print("{:>10}  {:<16} {:>14.8g} {:>12} {:>12}\n", member.number, name_of(member.status), member.time, member.steps_accepted,
                   member.steps_rejected);
    }
}

void print_info(InfoArguments const& arguments, ResultReader const& results, std::string const& computed, bool intact) {
    print_field("file", arguments.path);
    for (char const* const name : {"title", "created", "version", "commit", "compiler", "flags", "machine", "backend",
                                   "isa", "threads", "seed", "completeness"}) {
        print_field(name, one_line(results.attribute(name)));
    }
    print_field("payload", intact ? fmt::format("{}: matches the data", computed)
                                  : fmt::format("DOES NOT MATCH: the file says {}, its data give {}",
                                                results.stored_hash(), computed));
    fmt::print("\ndimensions\n");
    for (auto const& dimension : results.dimensions()) fmt::print("  {:<16} {}\n", dimension.name, dimension.length);
    fmt::print("\nstatus\n");
    print_statuses(count_statuses(results));
    auto const quantities = summarise_quantities(results);
    if (auto const report = report_of(results))
        print_tolerance(*report);
    else
        print_quantities(quantities);
    print_exponents(results);
    print_sections(results);
    if (auto const summary = verification_summary(results)) print_text(0, "\n{}", *summary);
    if (arguments.members) print_members(results, *arguments.members);
    if (arguments.scene) fmt::print("\nscene\n{}\n", results.attribute("scene"));
}

}  // namespace

int info(InfoArguments const& arguments) {
    ResultReader const results(arguments.path);
    std::string const computed = results.computed_hash();
    bool const intact = computed == results.stored_hash();
    if (arguments.members) member_rows(results, *arguments.members);  // or there are none to show

    if (arguments.json) {
        fmt::print("{}", result_json("info", results, intact, nullptr, 0, arguments.members));
    } else {
        print_info(arguments, results, computed, intact);
    }
    if (intact) return exit_code::done;
    throw FileError(
        fmt::format("{}: the data do not match their hash; the file is damaged or was edited", arguments.path));
}

}  // namespace slideway::cli
