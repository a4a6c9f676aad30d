#include "bench/command_line.hpp"

#include <CLI/CLI.hpp>

namespace slideway::bench {

struct CommandLine::App : CLI::App {
    using CLI::App::App;
};

CommandLine::CommandLine(std::string const& what) : app_(std::make_unique<App>(what)) {}
CommandLine::~CommandLine() = default;

void CommandLine::flag(std::string const& name, bool& value, std::string const& help) {
    app_->add_flag(name, value, help);
}
void CommandLine::option(std::string const& name, std::string& value, std::string const& help) {
    app_->add_option(name, value, help);
}
void CommandLine::option(std::string const& name, double& value, std::string const& help) {
    app_->add_option(name, value, help);
}
void CommandLine::count(std::string const& name, int& value, std::string const& help) {
    app_->add_option(name, value, help)->check(CLI::PositiveNumber);
}
void CommandLine::folder(std::string const& name, std::string& value, std::string const& help) {
    app_->add_option(name, value, help)->check(CLI::ExistingDirectory);
}

std::optional<int> CommandLine::parse(int argc, char const* const* argv) {
    try {
        app_->parse(argc, argv);
    } catch (CLI::ParseError const& error) {
        return app_->exit(error);
    }
    return std::nullopt;
}

}  // namespace slideway::bench
