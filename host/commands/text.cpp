#include "host/commands/text.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <new>
#include <numeric>
#include <system_error>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/base/text.hpp"
#include "host/config/descriptors.hpp"

namespace slideway::cli {

Complaint complaint_of(std::exception_ptr const& error) {
    try {
        std::rethrow_exception(error);
    } catch (SceneError const& known) {
        return {exit_code::bad_usage, known.what()};
    } catch (FileError const& known) {
        return {exit_code::file_trouble, known.what()};
    } catch (DeviceError const& known) {
        return {exit_code::file_trouble, known.what()};
    } catch (std::bad_alloc const&) {
        return {exit_code::file_trouble, std::string(out_of_memory)};
    } catch (std::system_error const& known) {
        return {exit_code::file_trouble, fmt::format("slideway: {}", known.what())};
    } catch (std::exception const& unknown) {
        return {exit_code::internal_error, fmt::format("slideway: internal error: {}", shown(unknown.what()))};
    } catch (...) {
        return {exit_code::internal_error, "slideway: internal error"};
    }
}

Scene load_scene(SceneArguments const& arguments) {
    try {
        return read_scene(arguments.path, arguments.overrides);
    } catch (FileError const& error) {
        throw SceneError(error.what());  // to the user a scene that is not there is bad usage
    }
}

namespace {
int first_failure = 0;  // errno of stdout's

void note_failure(bool failed) {
    if (failed && first_failure == 0) first_failure = errno != 0 ? errno : EIO;
}
}  // namespace

void write_out(std::string_view text) {
    std::string const line = shown_lines(text);
    errno = 0;
    note_failure(std::fwrite(line.data(), 1, line.size(), stdout) != line.size());
}

int output_failure() {
    errno = 0;
    note_failure(std::fflush(stdout) != 0);
    return first_failure;
}

void tell_text(std::string_view text) noexcept {
    if (text.ends_with('\n')) text.remove_suffix(1);
    try {
        std::string const line = shown(text) + '\n';
        std::fwrite(line.data(), 1, line.size(), stderr);
    } catch (std::bad_alloc const&) {  // nothing can be said without memory
    }
}

void warn_of_mending(std::string const& file) {
    if (!file.empty()) tell("warning: {}: was damaged or gone; it was written again from its copy\n", file);
}

std::string bytes_text(std::uint64_t bytes) {
    auto const amount = static_cast<double>(bytes);
    if (amount < 1e3) return fmt::format("{} B", bytes);
    if (amount < 1e6) return fmt::format("{:.1f} kB", amount / 1e3);
    return amount < 1e9 ? fmt::format("{:.1f} MB", amount / 1e6) : fmt::format("{:.1f} GB", amount / 1e9);
}

std::string duration_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.2g} s", seconds);
    if (seconds < 3600)
        return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60), std::fmod(std::floor(seconds), 60));
    if (seconds < 86400) return fmt::format("{:.1f} h", seconds / 3600);
    return fmt::format("{:.1f} days", seconds / 86400);
}

std::string card_memory_text(Prediction const& prediction) {
    if (prediction.card_bytes == 0) return {};
    return fmt::format(", {} on the card", bytes_text(prediction.card_bytes));
}

std::string shards_text(Scene const& scene, Prediction const& prediction) {
    if (scene.stores_members()) return "as much again";
    return fmt::format("at most {}", bytes_text(prediction.shard_bytes));
}

std::string counted(std::uint64_t count, std::string_view noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

std::string scene_text(Scene const& scene, std::string const& path) {
    return scene.title.empty() ? path : fmt::format("{} ({})", shown(scene.title, 200), path);
}

std::size_t line_width() {
    if (isatty(STDOUT_FILENO) == 0) return 0;
    winsize size{};
    bool const known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : usual_width;
}

namespace {

/// Bytes that go on with a character of UTF-8 take no column.
std::size_t columns_of(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

/// Where a terminal has no room for all columns the others follow below, behind the first `left` again.
void print_columns(TextRows const& rows, std::vector<std::size_t> const& widths, std::size_t gap, std::size_t left) {
    std::size_t const terminal = line_width();
    std::size_t first = left;
    do {
        std::size_t length = 2, end = first;
        for (std::size_t i = 0; i < left; ++i) length += widths[i] + gap;
        for (; end < widths.size() && (end == first || terminal == 0 || length + widths[end] <= terminal); ++end) length += widths[end] + gap;
        if (first > left) print_out("\n");
        for (auto const& row : rows) {
            if (first > left && row.size() <= first) continue;  // it has nothing in these columns
            std::string line = " ";
            for (std::size_t i = 0; i < std::min(row.size(), end); ++i) {
                if (i >= left && i < first) continue;
                std::string const pad(widths[i] - columns_of(row[i]), ' ');
                line += std::string(i == 0 ? 1 : gap, ' ') + (i < left ? row[i] + pad : pad + row[i]);
            }
            print_out("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
        }
        first = end;
    } while (first < widths.size());
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width, std::size_t first) {
    std::string lines;
    std::size_t column = first == std::string_view::npos ? indent : first;
    bool begun = false;
    while (!text.empty()) {
        auto const blanks = std::min(text.find_first_not_of(' '), text.size()), end = std::min(text.find(' ', blanks), text.size());
        std::string_view const word = text.substr(blanks, end - blanks);
        std::size_t const columns = columns_of(word);
        bool const broken = width > 0 && begun && column + blanks + columns > width;
        // A path may be longer than the room behind the indent, and still fit the line.
        std::size_t const before = !broken ? blanks : std::min(indent, width - std::min(columns, width));
        if (broken) lines += '\n';
        lines.append(before, ' ').append(word);
        column = (broken ? before : column + blanks) + columns;
        begun = true;
        text.remove_prefix(end);
    }
    return lines;
}

void print_field(std::string_view label, std::string_view text, std::size_t label_width) {
    print_out("{:<{}} {}\n", label, label_width, wrapped(shown(text), label_width + 1, line_width()));
}

void print_lines(std::size_t indent, std::string_view text) {
    std::size_t const width = line_width();
    for (std::size_t at = 0; at <= text.size();) {
        auto const end = std::min(text.find('\n', at), text.size());
        print_out("{}\n", wrapped(text.substr(at, end - at), indent, width, 0));
        at = end + 1;
    }
}

std::string cell(double value, int digits) { return std::isnan(value) ? std::string("-") : fmt::format("{:.{}g}", value, digits); }

void print_table(std::function<TextRows(int)> const& make_rows, int digits, std::size_t left, std::size_t least) {
    constexpr int least_digits = 3;
    std::size_t const terminal = line_width();
    for (std::size_t gap = 2;;) {
        TextRows rows = make_rows(digits);
        for (auto& row : rows) {
            for (std::string& text : row) text = shown(text);
        }
        std::vector<std::size_t> widths;
        for (auto const& row : rows) {
            widths.resize(std::max(widths.size(), row.size()), terminal > 0 ? 0 : least);
            for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
        }
        bool const fits = terminal == 0 || std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1) + 2) <= terminal;
        if (fits || (gap == 1 && digits <= least_digits)) return print_columns(rows, widths, fits ? gap : 2, left);
        if (gap == 1) --digits;
        gap = 1;
    }
}

char const* rate_damped(LawInfo const& law) { return has_group(law.groups, KeyGroup::edges) ? "line and surface" : "surface"; }

std::string damping_text(Parts const& parts) {
    LawInfo const& law = info(parts.law);
    bool const of_points = !info(parts.mechanism).spatial || has_group(law.groups, KeyGroup::point_damping);
    switch (parts.damping) {
        case Damping::point:
            if (of_points) return "damping of point contacts";
            return law.keys.empty() || law.has(Damping::rate) ? "no damping" : fmt::format("damping of the {} law", law.name);
        case Damping::rate:
            return fmt::format("damping of {}{} contacts", of_points ? "point, " : "", rate_damped(law));
        case Damping::restitution:
            return "restitution";
    }
    return "";
}

void print_statuses(std::vector<StatusCount> const& statuses) {
    for (StatusCount const& count : statuses) print_out("  {:<16} {}\n", name_of(count.status), count.members);
}

void print_quantities(std::vector<QuantitySummary> const& quantities) {
    if (quantities.empty()) return;
    // Rows of NaN alone would say the same in a harder way.
    auto const has_values = [](QuantitySummary const& quantity) { return quantity.values.count > 0; };
    if (std::ranges::none_of(quantities, has_values)) {
        print_out("\nNo member finished: there are no statistics.\n");
        return;
    }
    bool const single = std::none_of(quantities.begin(), quantities.end(), [](QuantitySummary const& one) { return one.values.count > 1; });
    print_out("\nOver the member{} that finished:\n", single ? "" : "s");
    // One member has a value, and no distribution.
    auto const rows = [&](int digits) {
        TextRows table{single ? std::vector<std::string>{"quantity", "unit", "value"}
                              : std::vector<std::string>{"quantity", "unit", "mean", "sd", "min", "median", "max"}};
        for (QuantitySummary const& quantity : quantities) {
            Summary const& s = quantity.values;
            std::vector<std::string>& row = table.emplace_back(std::vector<std::string>{quantity.label, quantity.unit, cell(s.mean, digits)});
            if (single) continue;
            for (double const value : {s.sd, s.min, s.median, s.max}) row.push_back(cell(value, digits));
        }
        return table;
    };
    print_table(rows, 5, 2, 12);
}

}  // namespace slideway::cli
