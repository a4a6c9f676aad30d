// Scripts that complete the command line in bash, zsh and fish.  Each has the keys of scenes for --set, and for those that are a choice their values.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/backend.hpp"
#include "host/base/error.hpp"
#include "host/commands/description.hpp"
#include "host/commands/options.hpp"
#include "host/config/key_reference.hpp"
#include "host/config/values.hpp"

namespace slideway::cli {
namespace {

/// What may stand for the value of an option.
struct Candidates {
    enum class Kind { nothing, words, files, folders, keys } kind = Kind::nothing;
    std::string words;  // separated by blanks; of files: how their names end
};
using Kind = Candidates::Kind;

std::string all_isa_words() {
    std::string words = "auto";
    for (Isa const isa : built_isas()) words += fmt::format(" {}", name_of(isa));
    return words;
}

Candidates candidates(std::string const& value, std::vector<CommandDescription> const& commands) {
    if (value == "KEY=VALUE") return {Kind::keys, {}};
    if (value == "SCENE") return {Kind::files, "toml"};
    if (value == "FILE") return {Kind::files, "nc csv"};
    if (value == "DIR") return {Kind::folders, {}};
    if (value == "ISA") return {Kind::words, all_isa_words()};
    if (value == "BACKEND") return {Kind::words, fmt::format("{}", fmt::join(backend_words, " "))};
    if (value == "SHELL") return {Kind::words, fmt::format("{}", fmt::join(shell_names, " "))};
    if (value == "COMMAND") {
        Candidates names{Kind::words, {}};
        for (CommandDescription const& command : commands) names.words += (names.words.empty() ? "" : " ") + command.name;
        return names;
    }
    auto const dot = value.rfind('.');
    if (dot != value.npos && value.find("..") == value.npos) return {Kind::files, value.substr(dot + 1)};
    return {};
}

/// Keys of scenes and, of a choice or a switch, their values, separated by blanks.
std::vector<std::pair<KeyReference const*, std::string>> keys_with_values() {
    std::vector<std::pair<KeyReference const*, std::string>> all;
    for (KeyReference const& key : known_keys()) {
        bool const truth = key.type == Setting::Type::truth;
        all.emplace_back(&key, truth ? "true false" : fmt::format("{}", fmt::join(key.choices, " ")));
    }
    return all;
}

/// Lines `joint.clearance) set -- a b ;;` of a case over the keys that have values.
std::string value_cases(char const* action) {
    std::string text;
    for (auto const& [key, values] : keys_with_values()) {
        if (!values.empty()) text += fmt::format("            {}) {} {} ;;\n", key->name, action, values);
    }
    return text;
}

std::string key_names() {
    std::string names;
    for (KeyReference const& key : known_keys()) names += fmt::format(" {}", key.name);
    return names;
}

// ---- bash ----

std::string bash_action(Candidates const& candidates) {
    switch (candidates.kind) {
        case Kind::words: return fmt::format("_slideway_words {}", candidates.words);
        case Kind::files: return fmt::format("_slideway_files {}", candidates.words);
        case Kind::folders: return "_slideway_files";
        case Kind::keys: return "_slideway_keys";
        case Kind::nothing: return ":";
    }
    return ":";
}

constexpr std::string_view bash_functions = R"(_slideway_words() { COMPREPLY+=($(compgen -W "$*" -- "$cur")); }
_slideway_files() {  # folders, and files whose names end in one of the arguments
    local IFS=$'\n' ending
    compopt -o filenames 2>/dev/null
    COMPREPLY+=($(compgen -d -- "$cur"))
    for ending; do COMPREPLY+=($(compgen -f -X "!*.$ending" -- "$cur")); done
}
)";

constexpr std::string_view bash_main = R"(_slideway() {
    local cur=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD left= whole= option i
    COMPREPLY=()
    # Where = breaks words, "a=b" comes as three of them; else as one.
    if [[ $cur == = ]]; then
        cur= left=${COMP_WORDS[at - 1]}
        ((at -= 1))
    elif ((at > 1)) && [[ ${COMP_WORDS[at - 1]} == = ]]; then
        left=${COMP_WORDS[at - 2]}
        ((at -= 2))
    elif [[ $cur == *=* ]]; then
        left=${cur%%=*} whole=$left= cur=${cur#*=}
    fi
    if ((at == 1)); then
        _slideway_words "$slideway_commands" --help --version
        return
    fi
    if [[ $left == -* ]]; then
        option=$left left=
    else
        option=${COMP_WORDS[at - 1]}
        # --set takes all words up to the next option.
        for ((i = at - 1; i > 1; --i)); do
            [[ ${COMP_WORDS[i]} == -* ]] && break
        done
        ((i > 1)) && [[ ${COMP_WORDS[i]} == --set && $cur != -* ]] && option=--set
    fi
    _slideway_of "${COMP_WORDS[1]}" "$option"
    [[ -n $whole ]] && COMPREPLY=("${COMPREPLY[@]/#/$whole}")
}
complete -F _slideway slideway
)";

std::string bash_script(std::vector<CommandDescription> const& commands) {
    std::string text = "# bash completion for slideway, written by: slideway help --completion bash\n";
    text += bash_functions;
    text += "_slideway_keys() {\n    if [[ -n $left ]]; then\n        case $left in\n" + value_cases("_slideway_words") +
            "        esac\n        return\n    fi\n    compopt -o nospace 2>/dev/null\n    COMPREPLY+=($(compgen -S = -W '" + key_names() +
            "' -- \"$cur\"))\n}\n";
    text += "_slideway_of() {  # COMMAND OPTION\n    case \"$1 $2\" in\n";
    std::string defaults;
    for (CommandDescription const& command : commands) {
        std::string options, positionals;
        for (OptionDescription const& option : command.options) {
            std::string const action = bash_action(candidates(option.value, commands));
            if (option.positional) {
                positionals += "            " + action + "\n";
                continue;
            }
            std::string patterns;
            for (std::string const& name : option.names) {
                options += " " + name;
                patterns += fmt::format("{}\"{} {}\"", patterns.empty() ? "" : " | ", command.name, name);
            }
            bool const takes_value = !option.value.empty() && !option.optional;
            if (takes_value) text += fmt::format("        {}) {}; return ;;\n", patterns, action);
        }
        defaults += fmt::format("        {})\n            [[ $cur == -* ]] && _slideway_words{} && return\n{}            ;;\n", command.name, options,
                                positionals);
    }
    text += "    esac\n    case $1 in\n" + defaults + "    esac\n}\n";
    std::string const names = candidates("COMMAND", commands).words;
    std::string main(bash_main);
    return text + main.replace(main.find("\"$slideway_commands\""), std::string_view("\"$slideway_commands\"").size(), names);
}

// ---- zsh ----

/// In an explanation of _arguments brackets and colons have a meaning.
std::string zsh_text(std::string_view text) {
    std::string out;
    for (char const c : text) out += std::string(c == '[' || c == ']' || c == ':' || c == '\\' ? "\\" : "") + c;
    return out;
}

std::string zsh_action(Candidates const& candidates) {
    switch (candidates.kind) {
        case Kind::words: return fmt::format("({})", candidates.words);
        case Kind::files: {
            std::string endings = candidates.words;
            std::ranges::replace(endings, ' ', '|');
            // A single word in parentheses would be qualifiers of the pattern.
            return endings == candidates.words ? "_files -g \"*." + endings + "\"" : "_files -g \"*.(" + endings + ")\"";
        }
        case Kind::folders: return "_files -/";
        case Kind::keys: return "_slideway_keys";
        case Kind::nothing: return " ";
    }
    return " ";
}

std::string zsh_spec(OptionDescription const& option, Candidates const& values) {
    if (option.positional) return shell_quoted(fmt::format(":{}{}:{}", option.optional ? ":" : "", option.value, zsh_action(values)));
    std::string value = option.value.empty() ? "" : fmt::format("{}:{}:{}", option.optional ? ":" : "", zsh_text(option.value), zsh_action(values));
    std::string const rest = shell_quoted(fmt::format("[{}]{}", zsh_text(option.meaning), value)), all = fmt::format("{}", fmt::join(option.names, " "));
    if (option.names.size() > 1) return fmt::format("'({})'{{{}}}{}", all, fmt::join(option.names, ","), rest);
    return fmt::format("{}{}{}", option.repeats ? "'*'" : "", all, rest);
}

std::string zsh_script(std::vector<CommandDescription> const& commands) {
    std::string text = "#compdef slideway\n# zsh completion for slideway, written by: slideway help --completion zsh\n"
                       "_slideway_keys() {\n    if compset -P '*='; then\n"
                       "        case ${${IPREFIX%=}##*=} in\n" + value_cases("compadd --") +
                       "        esac\n        return\n    fi\n    compadd -S = --" + key_names() +
                       "\n}\n_slideway() {\n    if ((CURRENT == 2)); then\n        local -a commands=(\n";
    for (CommandDescription const& command : commands) text += "            " + shell_quoted(command.name + ":" + zsh_text(command.summary)) + "\n";
    text += "        )\n        [[ $PREFIX == -* ]] && compadd -- --help --version || _describe command commands\n        return\n    fi\n"
            "    local command=$words[2]\n    shift words\n    ((CURRENT -= 1))\n    case $command in\n";
    for (CommandDescription const& command : commands) {
        text += fmt::format("        {})\n            _arguments", command.name);
        for (OptionDescription const& option : command.options) text += " \\\n                " + zsh_spec(option, candidates(option.value, commands));
        text += "\n            ;;\n";
    }
    return text + "    esac\n}\nif [[ $funcstack[1] == _slideway ]]; then _slideway \"$@\"; else compdef _slideway slideway; fi\n";
}

// ---- fish ----

std::string fish_action(Candidates const& candidates) {
    switch (candidates.kind) {
        case Kind::words: return fmt::format(" -a '{}'", candidates.words);
        case Kind::files: {
            std::string calls;
            std::string_view rest = candidates.words;
            while (!rest.empty()) {
                auto const end = std::min(rest.find(' '), rest.size());
                calls += fmt::format("(__fish_complete_suffix .{})", rest.substr(0, end));
                rest.remove_prefix(std::min(end + 1, rest.size()));
                if (!rest.empty()) calls += " ";
            }
            return fmt::format(" -k -a '{}'", calls);
        }
        case Kind::folders: return " -a '(__fish_complete_directories)'";
        case Kind::keys: return " -a '(__slideway_keys)'";
        case Kind::nothing: return "";
    }
    return "";
}

/// 'text' for fish, in which a backslash means something between quotes.
std::string fish_quoted(std::string_view text) {
    std::string out = "'";
    for (char const c : text) out += std::string(c == '\'' || c == '\\' ? "\\" : "") + c;
    return out + "'";
}

std::string fish_script(std::vector<CommandDescription> const& commands) {
    std::string text = "# fish completion for slideway, written by: slideway help --completion fish\n"
                       "function __slideway_at_command\n    test (count (commandline -opc)) -eq 1\nend\n"
                       "function __slideway_in\n    set -l words (commandline -opc)\n    test (count $words) -gt 1; and test $words[2] = $argv[1]\nend\n"
                       "function __slideway_keys\n    printf '%s\\t%s\\n'";
    for (auto const& [key, values] : keys_with_values()) {
        std::string const meaning = fish_quoted(key->meaning);
        if (values.empty()) text += fmt::format(" \\\n        {}= {}", key->name, meaning);
        for (std::size_t at = 0; at < values.size();) {
            auto const end = std::min(values.find(' ', at), values.size());
            text += fmt::format(" \\\n        {}={} {}", key->name, values.substr(at, end - at), meaning);
            at = end + 1;
        }
    }
    text += "\nend\ncomplete -c slideway -f\ncomplete -c slideway -n __slideway_at_command -l help -s h -d 'What slideway does'\n"
            "complete -c slideway -n __slideway_at_command -l version -d 'Version and commit'\n";
    for (CommandDescription const& command : commands) {
        text += fmt::format("complete -c slideway -n __slideway_at_command -a {} -d {}\n", command.name, fish_quoted(command.summary));
        for (OptionDescription const& option : command.options) {
            std::string const when = fmt::format("complete -c slideway -n '__slideway_in {}'", command.name);
            std::string const values = fish_action(candidates(option.value, commands));
            if (option.positional) {
                text += when + values + "\n";
                continue;
            }
            std::string const action = option.value.empty() || option.optional ? "" : " -x" + values;
            std::string names;
            for (std::string const& name : option.names) names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            text += fmt::format("{}{}{} -d {}\n", when, names, action, fish_quoted(option.meaning));
        }
    }
    return text;
}

}  // namespace

std::string completion(std::vector<CommandDescription> const& commands, std::string const& shell) {
    if (shell == "bash") return bash_script(commands);
    if (shell == "zsh") return zsh_script(commands);
    if (shell == "fish") return fish_script(commands);
    throw SceneError(fmt::format("--completion {}: no such shell; use one of {}", shell, fmt::join(shell_names, ", ")));
}

}  // namespace slideway::cli
