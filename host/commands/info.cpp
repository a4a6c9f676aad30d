#include <fmt/format.h>

#include "host/base/text.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/store/result_view.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/state_table.hpp"
#include "host/study/study_run.hpp"
#include "host/study/verification.hpp"

namespace slideway::cli {

namespace {

/// The report of a result whose scene has one.
std::optional<ToleranceReport> report_of(ResultReader const& results) {
    try {
        Scene const scene = stored_scene(results);
        if (asks_for_report(scene)) return tolerance_report(results, scene);
    } catch (SceneError const& error) {
        // Of another version, or a module or a table of a load is elsewhere.
        tell("warning: {}; without it there are no intervals, yields, correlations and shares of variance below\n", error.what());
    }
    return {};
}

void print_members(ResultReader const& results, MemberRange const& range) {
    print_out("\n{:>10}  {:<16} {:>14} {:>12} {:>12}\n", "member", "status", "end time [s]", "steps", "rejected");
    for (MemberRow const& member : member_rows(results, range)) {
        print_out("{:>10}  {:<16} {:>14.8g} {:>12} {:>12}{}\n", member.number, name_of(member.status), member.time, member.steps_accepted,
                   member.steps_rejected, member.label.empty() ? "" : "  " + shown_briefly(member.label));
    }
}

void print_hash(char const* label, std::string const& stored, std::string const& found, bool match, char const* of_what) {
    print_field(label, match ? fmt::format("{}: matches the {}", found, of_what)
                             : fmt::format("DOES NOT MATCH: the file says {}, its {} give {}", shown_briefly(stored), of_what, found));
}

/// Of a damaged file what it says of itself; of what its numbers come to nothing.
void print_info(InfoArguments const& arguments, ResultReader const& results, SealCheck const& seal) {
    constexpr std::size_t longest = 500;  // flags of a compiler are many
    print_field("file", arguments.path);
    for (char const* const name : {"title", "created", "version", "commit", "compiler", "flags", "machine", "backend",
                                   "isa", "modules", "threads", "seed", "completeness"}) {
        print_field(name, shown(results.attribute(name), longest));
    }
    print_field("format", fmt::format("{}", seal.version));
    print_hash("payload", seal.payload, seal.payload_found, seal.data_match(), "data");
    if (seal.version == 1 && seal.metadata.empty())
        print_field("metadata", "not covered by a hash in format 1");
    else
        print_hash("metadata", seal.metadata, seal.metadata_found, seal.metadata_match(), "attributes");
    if (!seal.foreign.empty()) print_field("not covered", seal.foreign + ": slideway did not write this");
    print_out("\ndimensions\n");
    for (auto const& dimension : results.dimensions()) print_out("  {:<16} {}\n", dimension.name, dimension.length);
    if (!seal.intact()) return;
    print_out("\nstatus\n");
    print_statuses(count_statuses(results));
    if (auto const report = report_of(results))
        print_tolerance(*report);
    else
        print_quantities(summarise_quantities(results));
    print_exponents(results);
    print_sections(results);
    if (auto const summary = verification_summary(results)) print_text(0, "\n{}", *summary);
    if (arguments.members) print_members(results, *arguments.members);
    if (arguments.scene) print_out("\nscene\n{}\n", results.attribute("scene"));
}

}  // namespace

int execute(InfoArguments const& arguments) {
    SealCheck const seal = check_result(arguments.path);
    if (!arguments.check) {
        ResultReader const results(arguments.path);
        if (seal.intact() && arguments.members) member_rows(results, *arguments.members);  // or there are none to show
        if (arguments.json) {
            print_out("{}", result_json("info", results, seal, seal.intact() ? report_of(results) : std::nullopt, nullptr, 0, arguments.members));
        } else {
            print_info(arguments, results, seal);
        }
    } else if (seal.intact()) {
        print_field("intact", arguments.path);
    }
    if (seal.intact()) return exit_code::done;
    throw FileError(fmt::format("{}: {}; the file is damaged or was edited", arguments.path, seal.damage()));
}

}  // namespace slideway::cli
