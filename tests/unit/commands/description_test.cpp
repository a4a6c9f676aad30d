#include "host/commands/description.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/key_reference.hpp"

namespace slideway::testing {
namespace {

using namespace slideway::cli;

/// From `begin` to the next `end`, or to the end of the text; empty where `begin` is not there.
std::string part_of(std::string const& text, std::string const& begin, std::string const& end) {
    auto const at = text.find(begin);
    return at == text.npos ? std::string() : text.substr(at, text.find(end, at + begin.size()) - at);
}

std::string roff(std::string const& text) { return std::regex_replace(text, std::regex("-"), "\\-"); }

bool has(std::string const& text, std::string const& part) { return text.find(part) != text.npos; }

TEST(CommandLine, HasItsCommandsAndOptionsInTheManPage) {
    auto const commands = command_descriptions();
    ASSERT_EQ(commands.size(), 9u);
    std::string const page = man_page(commands);
    for (CommandDescription const& command : commands) {
        std::string const section = part_of(page, "\n.SS slideway " + command.name + " ", "\n.S");
        EXPECT_NE(section, "") << command.name;
        EXPECT_GE(command.options.size(), 2u) << command.name;
        for (OptionDescription const& option : command.options) {
            for (std::string const& name : option.names) EXPECT_TRUE(has(section, roff(name) + "\\fR")) << command.name << " " << name;
        }
        for (Example const& example : command.examples) EXPECT_TRUE(has(page, roff(example.line.substr(0, 12)))) << example.line;
    }
    for (KeyReference const& key : known_keys()) EXPECT_TRUE(has(page, "\n\\fB" + std::string(key.name) + "\\fR")) << key.name;
    for (ExitCode const& code : exit_codes) EXPECT_TRUE(has(page, fmt::format("\n\\fB{}\\fR\n", code.number))) << code.number;
}

TEST(CommandLine, HasTheVariablesOfTheEnvironmentInTheManPage) {
    std::string const page = man_page(command_descriptions());
    std::regex const call("getenv\\(\"([A-Z_]+)\"\\)");
    std::size_t found = 0;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(SLIDEWAY_SOURCE "/host")) {
        if (entry.path().extension() != ".cpp") continue;
        std::ifstream in(entry.path());
        std::string const text{std::istreambuf_iterator<char>(in), {}};
        for (std::sregex_iterator at(text.begin(), text.end(), call), end; at != end; ++at, ++found)
            EXPECT_TRUE(has(page, "\n\\fB" + at->str(1) + "\\fR\n")) << at->str(1) << " of " << entry.path();
    }
    EXPECT_GE(found, 3u);
}

TEST(CommandLine, HasItsCommandsAndOptionsInEachCompletion) {
    auto const commands = command_descriptions();
    std::string const bash = completion(commands, "bash"), zsh = completion(commands, "zsh"), fish = completion(commands, "fish");
    for (CommandDescription const& command : commands) {
        std::string const case_line = "\n        " + command.name + ")\n";
        std::string const in_bash = part_of(bash, case_line, ";;"), in_zsh = part_of(zsh, case_line, ";;");
        std::string const in_fish = "complete -c slideway -n '__slideway_in " + command.name + "'";
        EXPECT_TRUE(has(fish, "__slideway_at_command -a " + command.name + " ")) << command.name;
        EXPECT_TRUE(has(zsh, "'" + command.name + ":")) << command.name;
        for (OptionDescription const& option : command.options) {
            for (std::string const& name : option.names) {
                if (option.positional) continue;
                EXPECT_TRUE(std::regex_search(in_bash, std::regex(" " + name + "[ \n]"))) << command.name << " " << name;
                EXPECT_TRUE(std::regex_search(in_zsh, std::regex("[ '{,}]" + name + "['},]"))) << command.name << " " << name;
                std::string const of_fish = name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
                EXPECT_TRUE(std::regex_search(fish, std::regex(in_fish + "[^\n]*" + of_fish + " "))) << command.name << " " << name;
            }
        }
    }
    for (KeyReference const& key : known_keys()) {
        std::regex const word(" " + std::string(key.name) + "[ '\n]");
        for (std::string const* const script : {&bash, &zsh}) EXPECT_TRUE(std::regex_search(*script, word)) << key.name;
        EXPECT_TRUE(has(fish, " " + std::string(key.name) + "=")) << key.name;
        for (std::string_view const choice : key.choices) EXPECT_TRUE(has(fish, fmt::format(" {}={} ", key.name, choice))) << key.name;
    }
    EXPECT_THROW(completion(commands, "csh"), SceneError);
}

/// As a shell splits it, up to a redirection.
std::vector<std::string> words_of(std::string line) {
    std::vector<std::string> words;
    line = line.substr(0, line.find(" >"));
    for (bool quoted = false; char const c : " " + line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ' ' && !quoted)
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

TEST(CommandLine, HasExamplesThatItTakes) {
    for (CommandDescription const& command : command_descriptions()) {
        EXPECT_FALSE(command.examples.empty()) << command.name;
        for (Example const& example : command.examples) {
            if (!example.line.starts_with("slideway ")) continue;
            std::vector<std::string> const words = words_of(example.line);
            std::vector<char const*> argv;
            for (std::string const& word : words) argv.push_back(word.c_str());
            EXPECT_EQ(words[1], command.name) << example.line;
            EXPECT_NO_THROW(parse_arguments(static_cast<int>(argv.size()), argv.data())) << example.line;
        }
    }
}

TEST(WrappedText, EndsBeforeItsColumnAndLosesNothing) {
    EXPECT_EQ(wrapped("one two three", 0, 0), "one two three");
    EXPECT_EQ(wrapped("one two three", 0, 7), "one two\nthree");
    EXPECT_EQ(wrapped("one two three", 2, 7), "one\n  two\n  three");
    EXPECT_EQ(wrapped("  a   word beside", 4, 10, 0), "  a   word\n    beside");
    EXPECT_EQ(wrapped("unbreakable word", 0, 4), "unbreakable\nword");
    EXPECT_EQ(wrapped("ΔΔΔ ± ≥", 0, 7), "ΔΔΔ ± ≥") << "characters count, not bytes";
    EXPECT_EQ(wrapped("", 3, 10), "");
}

}  // namespace
}  // namespace slideway::testing
