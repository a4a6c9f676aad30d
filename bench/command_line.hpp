// Options of a benchmark.  A front of CLI11, which takes seconds to compile, so that only one unit has to.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace slideway::bench {

class CommandLine {
public:
    explicit CommandLine(std::string const& what);
    ~CommandLine();

    void flag(std::string const& name, bool& value, std::string const& help);
    void option(std::string const& name, std::string& value, std::string const& help);
    void option(std::string const& name, double& value, std::string const& help);
    /// A number above 0.
    void count(std::string const& name, int& value, std::string const& help);
    /// One that exists.
    void folder(std::string const& name, std::string& value, std::string const& help);

    /// Sets the values.  @return the exit code where the program ends here: help was asked for, or the words are wrong.
    std::optional<int> parse(int argc, char const* const* argv);

private:
    struct App;
    std::unique_ptr<App> app_;
};

}  // namespace slideway::bench
