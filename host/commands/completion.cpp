// What may stand next on a command line: the program says it, as `slideway __complete -- WORD...`, and the scripts show it in their shells.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/backend/backend.hpp"
#include "host/base/error.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/description.hpp"
#include "host/config/key_reference.hpp"

namespace slideway::cli {
namespace {

using Commands = std::vector<CommandDescription>;

/// "candidate<TAB>meaning", one a line.
std::string line(std::string_view candidate, std::string_view meaning = "") { return fmt::format("{}\t{}\n", candidate, meaning); }

template <class Words> std::string lines(std::string_view left, Words const& words, std::string_view meaning = "") {
    std::string text;
    for (std::string_view const word : words) text += line(fmt::format("{}{}", left, word), meaning);
    return text;
}

/// Keys of scenes, or behind `key=` the values of a choice or a switch.
std::string of_keys(std::string_view word) {
    std::string text;
    auto const sign = word.find('=');
    for (Setting const& key : known_keys()) {
        if (sign == word.npos)
            text += line(fmt::format("{}=", key.name), key.meaning);
        else if (key.name == word.substr(0, sign))
            text += key.type == Setting::Type::truth ? lines(word.substr(0, sign + 1), std::to_array<std::string_view>({"true", "false"}), key.meaning)
                                                     : lines(word.substr(0, sign + 1), key.all_choices(), key.meaning);
    }
    return text;
}

/// @param left of the word, which its candidates begin with: "--isa="  @param word what stands behind it
std::string of_value(std::string const& value, std::string_view left, std::string_view word, Commands const& commands) {
    if (value == "KEY=VALUE") return of_keys(word);
    if (value == "SCENE") return "*/\n*.toml\n";
    if (value == "FILE") return "*/\n*.nc\n*.csv\n";
    if (value == "DIR") return "*/\n";
    if (value == "ISA") {
        std::string text = line(fmt::format("{}auto", left));
        for (Isa const isa : built_isas()) text += line(fmt::format("{}{}", left, name_of(isa)));
        return text;
    }
    if (value == "BACKEND") return lines(left, backend_words);
    if (value == "SHELL") return lines(left, shell_names);
    if (value == "COMMAND") {
        std::string text;
        for (CommandDescription const& command : commands) text += line(command.name, command.summary);
        return text;
    }
    if (auto const bar = value.find('|'); bar != value.npos && value.starts_with("OUT.")) {
        std::string const others = of_value(value.substr(bar + 1), left, word, commands);
        return of_value(value.substr(0, bar), left, word, commands) + others.substr(others.find('\n') + 1);  // folders once
    }
    auto const dot = value.rfind('.');
    return dot != value.npos && value.find("..") == value.npos ? fmt::format("*/\n*{}\n", value.substr(dot)) : std::string();
}

constexpr std::string_view bash_script = R"(# bash completion for slideway, written by: slideway help --completion bash
_slideway() {
    local IFS=$'\n' cur=${COMP_WORDS[COMP_CWORD]} program line i
    local words=() files=
    # bash breaks words at =, the program does not.
    for ((i = 1; i <= COMP_CWORD; ++i)); do
        if ((i > 1)) && [[ ${COMP_WORDS[i]} == = || ${COMP_WORDS[i - 1]} == = ]]; then
            words[${#words[@]} - 1]+=${COMP_WORDS[i]}
        else
            words+=("${COMP_WORDS[i]}")
        fi
    done
    local word=${words[${#words[@]} - 1]}
    [[ $cur == = ]] && cur=
    local broken=${word%"$cur"}
    [[ $cur == --*=* ]] && files=${cur%%=*}=
    program=$(type -P -- "${1/#\~/$HOME}")
    COMPREPLY=()
    while read -r line; do
        case $line in
            '*'*) compopt -o filenames 2>/dev/null ;;&
            '*/') COMPREPLY+=($(compgen -P "$files" -d -- "${cur#"$files"}")) ;;
            '*.'*) COMPREPLY+=($(compgen -P "$files" -f -X "!$line" -- "${cur#"$files"}")) ;;
            "$word"*)
                line=${line%%$'\t'*}
                [[ $line == *= ]] && compopt -o nospace 2>/dev/null
                COMPREPLY+=("${line#"$broken"}")
                ;;
        esac
    done < <("${program:-slideway}" __complete -- "${words[@]}" 2>/dev/null)
}
complete -F _slideway slideway
)";

constexpr std::string_view zsh_script = R"(#compdef slideway
# zsh completion for slideway, written by: slideway help --completion zsh
_slideway() {
    local line word meaning folders
    local -a files keys others
    for line in "${(@f)$(command ${~words[1]} __complete -- "${(@Q)words[2,CURRENT-1]}" "$PREFIX" 2>/dev/null)}"; do
        word=${${line%%$'\t'*}//:/\\:} meaning=${line#*$'\t'}
        case $line in
            '*/') folders=1 ;;
            '*.'*) files+=($line) ;;
            *=$'\t'*) keys+=("$word:$meaning") ;;
            ?*) others+=("$word:$meaning") ;;
        esac
    done
    (($#keys)) && _describe key keys -S ''
    (($#others)) && _describe word others
    [[ -n $folders ]] && compset -P '--*='
    if (($#files)); then _files -g "$files"; elif [[ -n $folders ]]; then _files -/; fi
}
if [[ $funcstack[1] == _slideway ]]; then _slideway "$@"; else compdef _slideway slideway; fi
)";

constexpr std::string_view fish_script = R"(# fish completion for slideway, written by: slideway help --completion fish
function __slideway_complete
    set -l words (commandline -opc)
    for line in (command $words[1] __complete -- $words[2..] (commandline -ct) 2>/dev/null)
        switch $line
            case '\*/'
                __fish_complete_directories (string replace -r -- '^--[a-z]*=' '' (commandline -ct))
            case '\*.*'
                __fish_complete_suffix (string sub -s 2 -- $line)
            case '*'
                echo $line
        end
    end
end
complete -c slideway -f -k -a '(__slideway_complete)'
)";

}  // namespace

std::string candidates(Commands const& commands, std::span<std::string const> words) {
    std::string_view const word = words.empty() ? std::string_view() : words.back();
    if (words.size() < 2) {
        if (word.starts_with('-')) return line("--help", "What slideway does") + line("--version", "Version and commit");
        return of_value("COMMAND", "", word, commands);
    }
    auto const command = std::ranges::find(commands, words[0], &CommandDescription::name);
    if (command == commands.end()) return {};
    auto const find_option = [&](std::string_view name) -> OptionDescription const* {
        for (OptionDescription const& option : command->options) {
            if (std::ranges::find(option.names, name) != option.names.end() && !option.positional && !option.value.empty() && !option.optional) return &option;
        }
        return nullptr;
    };
    if (auto const sign = word.find('='); word.starts_with('-') && sign != word.npos) {
        OptionDescription const* const option = find_option(word.substr(0, sign));
        return option ? of_value(option->value, word.substr(0, sign + 1), word.substr(sign + 1), commands) : std::string();
    }
    std::string text;
    // fish would look for the letters of an option in meanings, too.
    if (word.starts_with('-')) {
        for (OptionDescription const& option : command->options) {
            for (std::string const& name : option.names) text += !option.positional && name.starts_with(word) ? line(name, option.meaning) : "";
        }
        return text;
    }
    auto const before = words.first(words.size() - 1);
    if (OptionDescription const* const option = find_option(before.back())) return of_value(option->value, "", word, commands);
    // --set takes all words up to the next option.
    auto const last = std::ranges::find_if(before.rbegin(), before.rend(), [](std::string_view one) { return one.starts_with('-'); });
    OptionDescription const* const list = last == before.rend() ? nullptr : find_option(*last);
    if (list && list->repeats) return of_value(list->value, "", word, commands);
    for (OptionDescription const& option : command->options) {
        if (option.positional) text += of_value(option.value, "", word, commands);
    }
    return text;
}

std::string completion(std::string const& shell) {
    if (shell == "bash") return std::string(bash_script);
    if (shell == "zsh") return std::string(zsh_script);
    if (shell == "fish") return std::string(fish_script);
    throw SceneError(fmt::format("--completion {}: no such shell; use one of {}", shell, fmt::join(shell_names, ", ")));
}

}  // namespace slideway::cli
