#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/commands/commands.hpp"
#include "host/commands/description.hpp"
#include "host/commands/text.hpp"
#include "host/config/key_reference.hpp"
#include "host/store/run_identity.hpp"

namespace slideway::cli {
namespace {

/// "  -o, --output OUT.nc       Result file": a label in a column, and beside or below it what it means.
std::string entry(std::string const& label, std::string const& meaning, std::size_t width) {
    constexpr std::size_t column = 28;
    std::string const left = "  " + label;
    bool const beside = left.size() + 2 <= column;
    return left + (beside ? std::string(column - left.size(), ' ') : "\n" + std::string(column, ' ')) + wrapped(meaning, column, width) + "\n";
}

/// A command that goes on behind a backslash where it is longer than a line.
std::string shell_lines(std::string const& command, std::size_t width) {
    std::string lines = wrapped(command, 6, width - 2, 2);
    for (std::size_t at = 0; (at = lines.find('\n', at)) != lines.npos; at += 3) lines.insert(at, " \\");
    return lines;
}

/// The character of UTF-8 that begins at `at`, as "\\[u2265]"; leaves `at` on its last byte.
std::string escaped(std::string_view text, std::size_t& at) {
    auto const byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    unsigned code = byte(at) & (byte(at) >= 0xf0 ? 0x07u : byte(at) >= 0xe0 ? 0x0fu : 0x1fu);
    while ((byte(at + 1) & 0xc0u) == 0x80u) code = code << 6 | (byte(++at) & 0x3fu);
    return fmt::format("\\[u{:04X}]", code);
}

/// A text as roff shows it: hyphens that can be copied, no requests and no escapes by accident.
std::string plain(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char const c = text[i];
        if (static_cast<unsigned char>(c) >= 0x80) {
            out += escaped(text, i);
            continue;
        }
        switch (c) {
            case '\\': out += "\\e"; break;
            case '-': out += "\\-"; break;
            case '\'': out += "\\(aq"; break;
            case '`': out += "\\(ga"; break;
            case '^': out += "\\(ha"; break;
            case '~': out += "\\(ti"; break;
            case '\n': out += ' '; break;
            default: out += c;
        }
    }
    return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + plain(text) + "\\fR"; }
std::string entry(std::string const& label, std::string const& text) { return fmt::format(".TP\n{}\n{}\n", label, text); }

std::string commands_text(std::vector<CommandDescription> const& commands) {
    std::string text = ".SH COMMANDS\n";
    for (CommandDescription const& command : commands) {
        text += fmt::format(".SS {}\n{}\n.PP\n{}\n", plain(command.synopsis()), plain(command.summary) + ".", plain(command.note));
        if (command.note.empty()) text.erase(text.size() - std::string_view(".PP\n\n").size());
        for (OptionDescription const& option : command.options) text += entry(option.label(bold, italic), plain(option.meaning));
    }
    return text;
}

std::string keys_text() {
    std::string text =
        ".SH SCENES\nA scene is a file in TOML. Numbers are in SI units, or texts with a unit: \"0.1 mm\", \"30 rpm\". "
        "Its keys, each with unit, domain and default:\n";
    for (Setting const& key : known_keys()) {
        std::string const unit = key.unit.empty() || key.unit == "1" ? std::string() : fmt::format(" [{}]", key.unit);
        text += entry(bold(key.name) + plain(unit), plain(described(key)));
    }
    return text;
}

struct Row {
    char const *name, *meaning;
};
constexpr Row files[] = {
    {"SCENE.toml", "a scene; `slideway check` validates it"},
    {"OUT.nc", "a result: NetCDF-4, CF-1.8; `slideway info` says what is in it"},
    {"OUT.nc.shards", "folder of what a run has finished, until OUT.nc is whole; --resume and `slideway merge` go on from it"},
};
constexpr Row variables[] = {
    {"SLIDEWAY_PYTHON", "interpreter of Python that has the package slideway, for `slideway report`; else python3"},
    {"SLIDEWAY_MODULES", "folders of modules, colons between them, before those of slideway compile and of the program"},
    {"CXX", "compiler of slideway compile, with its first options; else the one that compiled slideway, else g++"},
    {"XDG_CACHE_HOME", "folder below which slideway compile puts modules; else ~/.cache"},
    {"SLIDEWAY_CUDA_MODULE", "file of the module with the kernels for cards; else where the program was built or installed"},
    {"SOURCE_DATE_EPOCH", "seconds since 1970 that results give as the time of their creation"},
};

std::string table_text(char const* heading, std::span<Row const> rows) {
    std::string text = fmt::format(".SH {}\n", heading);
    for (Row const& row : rows) text += entry(bold(row.name), plain(row.meaning));
    return text;
}

std::string examples_text(std::vector<CommandDescription> const& commands) {
    std::string text = ".SH EXAMPLES\n";
    for (CommandDescription const& command : commands) {
        for (Example const& example : command.examples) text += entry(bold(example.line), plain(example.meaning));
    }
    return text;
}

}  // namespace

std::string OptionDescription::label(Style const& word, Style const& metavariable) const {
    std::vector<std::string> set;
    for (std::string const& name : names) set.push_back(positional ? metavariable(name) : word(name));
    std::string text = fmt::format("{}", fmt::join(set, ", "));
    if (value.empty() || positional) return text;
    std::string const taken = metavariable(value) + (repeats ? " ..." : "");
    return text + (optional ? " [" + taken + "]" : " " + taken);
}

std::string CommandDescription::synopsis() const {
    std::string text = "slideway " + name + " [OPTION]...";
    for (OptionDescription const& option : options) {
        if (option.positional) text += option.optional ? " [" + option.value + "]" : " " + option.value;
    }
    return text;
}

std::string help_text(CommandDescription const& command, std::size_t width) {
    auto const as_it_is = [](std::string_view word) { return std::string(word); };
    std::string text = fmt::format("{}\n\nUsage: {}\n", wrapped(command.summary, 0, width), command.synopsis());
    for (bool const positional : {true, false}) {
        std::string entries;
        for (OptionDescription const& option : command.options) {
            if (option.positional == positional) entries += entry(option.label(as_it_is, as_it_is), option.meaning, width);
        }
        if (!entries.empty()) text += fmt::format("\n{}:\n{}", positional ? "Arguments" : "Options", entries);
    }
    if (!command.note.empty()) text += fmt::format("\n{}\n", wrapped(command.note, 0, width));
    if (!command.examples.empty()) text += "\nExamples:\n";
    for (Example const& example : command.examples)
        text += fmt::format("  {}\n      {}\n", shell_lines(example.line, width), wrapped(example.meaning, 6, width));
    return text;
}

std::string help_text(std::vector<CommandDescription> const& commands, std::size_t width) {
    std::string text =
        wrapped("Clearance joints of slider mechanisms: ensembles of simulations from a scene file.", 0, width) +
        "\n\nUsage: slideway COMMAND [OPTION]... [ARGUMENT]\n\n"
        "Options:\n";
    text += entry("-h, --help", "This text; behind a command, what it does and its options", width);
    text += entry("--version", "Version and commit", width);
    text += "\nCommands:\n";
    for (CommandDescription const& command : commands) text += entry(command.name, command.summary, width);
    return text + "\nslideway help COMMAND says what a command does, its options and examples.\n";
}

// ---- slideway.1, in the man macros that both groff and mandoc know ----

int execute(TextOnly const& only) {
    print_out("{}", only.text);
    return exit_code::done;
}

std::string man_page(std::vector<CommandDescription> const& commands) {
    std::string text = fmt::format(".\\\" written by: slideway help --man\n.TH SLIDEWAY 1 {} \"slideway {}\" \"User Commands\"\n",
                                   creation_time().substr(0, 10), build_info().version);
    text += ".SH NAME\nslideway \\- clearance joints of slider mechanisms: ensembles of simulations from a scene file\n.SH SYNOPSIS\n";
    for (CommandDescription const& command : commands) text += plain(command.synopsis()) + "\n.br\n";
    text += "slideway \\-\\-version\n.SH DESCRIPTION\n"
            "Integrates the members of an ensemble of mechanisms with clearance joints, as a scene describes them, and writes a result file. "
            "Results go to files, summaries to the standard output, progress, warnings and errors to the standard error output. "
            "An error is one line: where it is, what is wrong, and what to do. A file that is there already is never replaced without \\fB\\-\\-force\\fR, "
            "and inputs never.\n";
    text += commands_text(commands) + keys_text() + ".SH EXIT STATUS\n";
    for (ExitCode const& code : exit_codes) text += entry(bold(std::to_string(code.number)), plain(code.meaning));
    return text + table_text("FILES", files) + table_text("ENVIRONMENT", variables) + examples_text(commands);
}

}  // namespace slideway::cli
