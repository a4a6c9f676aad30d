#include "host/commands/description.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "host/commands/commands.hpp"
#include "host/commands/text.hpp"
#include "host/config/key_reference.hpp"

namespace slideway::testing::description_test {
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
    ASSERT_EQ(commands.size(), 11u);
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
    for (Setting const& key : known_keys()) EXPECT_TRUE(has(page, "\n\\fB" + std::string(key.name) + "\\fR")) << key.name;
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

TEST(CommandLine, HasItsCommandsOptionsAndKeysInCompletions) {
    auto const commands = command_descriptions();
    auto const offers = [&](std::vector<std::string> const& words, std::string_view candidate) {
        return has("\n" + candidates(commands, words), fmt::format("\n{}\t", candidate));
    };
    for (CommandDescription const& command : commands) {
        EXPECT_TRUE(offers({""}, command.name));
        for (OptionDescription const& option : command.options) {
            for (std::string const& name : option.names) EXPECT_NE(option.positional, offers({command.name, "-"}, name)) << command.name << " " << name;
        }
    }
    for (Setting const& key : known_keys()) {
        EXPECT_TRUE(offers({"run", "--set", ""}, fmt::format("{}=", key.name)));
        for (std::string_view const choice : key.all_choices()) EXPECT_TRUE(offers({"run", "--set", fmt::format("{}=", key.name)}, fmt::format("{}={}", key.name, choice)));
    }
    EXPECT_EQ(candidates(commands, std::vector<std::string>{"nonsense", ""}), "");
    EXPECT_EQ(candidates(commands, std::vector<std::string>{"run", "--member=1"}), "");
    EXPECT_THROW(completion("csh"), SceneError);
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
    EXPECT_EQ(wrapped("a longword b", 6, 10), "a\n  longword\n      b") << "a word may take the room of its indent";
    EXPECT_EQ(wrapped("a unbreakable b", 6, 10), "a\nunbreakable\n      b");
    EXPECT_EQ(wrapped("ΔΔΔ ± ≥", 0, 7), "ΔΔΔ ± ≥") << "characters count, not bytes";
    EXPECT_EQ(wrapped("", 3, 10), "");
}

}  // namespace
}  // namespace slideway::testing::description_test
