#include "host/commands/text.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <system_error>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "host/config/scene_text.hpp"

namespace slideway::cli {

int exit_code_of(std::exception_ptr error) {
    try {
        std::rethrow_exception(std::move(error));
    } catch (SceneError const&) {
        return exit_code::bad_usage;
    } catch (FileError const&) {
        return exit_code::file_trouble;
    } catch (DeviceError const&) {
        return exit_code::file_trouble;
    } catch (std::bad_alloc const&) {
        return exit_code::file_trouble;
    } catch (std::system_error const&) {
        return exit_code::file_trouble;
    } catch (...) {
        return exit_code::internal_error;
    }
}

std::string line_of(std::exception_ptr const& error) {
    try {
        std::rethrow_exception(error);
    } catch (SceneError const& known) {
        return known.what();
    } catch (FileError const& known) {
        return known.what();
    } catch (DeviceError const& known) {
        return known.what();
    } catch (std::bad_alloc const&) {
        return "slideway: not enough memory; ask for fewer members or samples";
    } catch (std::system_error const& known) {
        return fmt::format("slideway: {}", known.what());
    } catch (std::exception const& unknown) {
        return fmt::format("slideway: internal error: {}", unknown.what());
    }
}

Scene load_scene(SceneArguments const& arguments) {
    try {
        return read_scene(arguments.path, arguments.overrides);
    } catch (FileError const& error) {
        throw SceneError(error.what());  // to the user a scene that is not there is bad usage
    }
}

void tell_text(std::string const& text) noexcept { std::fwrite(text.data(), 1, text.size(), stderr); }

void print_warnings(Scene const& scene) {
    for (std::string const& warning : scene.warnings) tell("warning: {}\n", warning);
}

void warn_of_mending(std::string const& file) {
    if (!file.empty()) tell("warning: {}: was damaged or gone; it was written again from its copy\n", file);
}

std::string bytes_text(double bytes) {
    if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
    if (bytes < 1e6) return fmt::format("{:.1f} kB", bytes / 1e3);
    if (bytes < 1e9) return fmt::format("{:.1f} MB", bytes / 1e6);
    return fmt::format("{:.1f} GB", bytes / 1e9);
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
    return fmt::format(", {} on the card", bytes_text(static_cast<double>(prediction.card_bytes)));
}

std::string shards_text(Scene const& scene, Prediction const& prediction) {
    if (scene.stores_members()) return "as much again";
    return fmt::format("at most {}", bytes_text(static_cast<double>(prediction.shard_bytes)));
}

std::string scene_text(Scene const& scene, std::string const& path) {
    return scene.title.empty() ? path : fmt::format("{} ({})", one_line(scene.title), path);
}

std::size_t line_width() {
    if (isatty(STDOUT_FILENO) == 0) return 0;
    winsize size{};
    bool const known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : usual_width;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width, std::size_t first) {
    std::string lines;
    std::size_t column = first == std::string_view::npos ? indent : first;
    bool begun = false;
    while (!text.empty()) {
        auto const blanks = std::min(text.find_first_not_of(' '), text.size()), end = std::min(text.find(' ', blanks), text.size());
        std::string_view const word = text.substr(blanks, end - blanks);
        // Bytes that go on with a character of UTF-8 take no column.
        auto const columns = static_cast<std::size_t>(std::ranges::count_if(word, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
        bool const broken = width > 0 && begun && column + blanks + columns > width;
        if (broken) lines += '\n';
        lines.append(broken ? indent : blanks, ' ').append(word);
        column = (broken ? indent : column + blanks) + columns;
        begun = true;
        text.remove_prefix(end);
    }
    return lines;
}

void print_field(std::string_view label, std::string_view text) { fmt::print("{:<12} {}\n", label, wrapped(text, 13, line_width())); }

void print_statuses(std::vector<StatusCount> const& statuses) {
    for (StatusCount const& count : statuses) fmt::print("  {:<16} {}\n", name_of(count.status), count.members);
}

void print_quantities(std::vector<QuantitySummary> const& quantities) {
    if (quantities.empty()) return;
    // Rows of NaN alone would say the same in a harder way.
    auto const has_values = [](QuantitySummary const& quantity) { return quantity.values.count > 0; };
    if (std::none_of(quantities.begin(), quantities.end(), has_values)) {
        fmt::print("\nNo member finished: there are no statistics.\n");
        return;
    }
    bool const single = std::none_of(quantities.begin(), quantities.end(), [](QuantitySummary const& one) { return one.values.count > 1; });
    fmt::print("\nOver the member{} that finished:\n", single ? "" : "s");
    std::size_t width = 8, unit_width = 4;
    for (QuantitySummary const& quantity : quantities) {
        width = std::max(width, quantity.label.size());
        unit_width = std::max(unit_width, quantity.unit.size());
    }
    auto const row = [&](std::string_view label, std::string_view unit, auto const&... cells) {
        fmt::print("  {:<{}}  {:<{}}", label, width, unit, unit_width);
        (fmt::print("  {:>12}", cells), ...);
        fmt::print("\n");
    };
    // One member has no standard deviation.
    auto const text = [](double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.5g}", value); };
    if (single) {
        // One member has a value, and no distribution.
        row("quantity", "unit", "value");
        for (QuantitySummary const& quantity : quantities) row(quantity.label, quantity.unit, text(quantity.values.mean));
        return;
    }
    row("quantity", "unit", "mean", "sd", "min", "median", "max");
    for (QuantitySummary const& quantity : quantities) {
        Summary const& s = quantity.values;
        row(quantity.label, quantity.unit, text(s.mean), text(s.sd), text(s.min), text(s.median), text(s.max));
    }
}

}  // namespace slideway::cli
