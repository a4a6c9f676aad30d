// Prints the words of scenes and command lines as a dictionary of libFuzzer: keys, choices and units, from the tables of the program.
#include <cstdio>
#include <set>
#include <string>

#include "host/config/key_reference.hpp"

int main() {
    using namespace slideway;
    std::set<std::string> words;
    for (Setting const& key : known_keys()) {
        std::string const name(key.name);
        auto const dot = name.rfind('.');
        words.insert(name);
        if (dot != name.npos) {
            words.insert("[" + name.substr(0, dot) + "]\n");
            words.insert(name.substr(dot + 1) + " = ");
        }
        for (std::string_view const choice : key.all_choices()) words.insert("\"" + std::string(choice) + "\"");
        if (!key.unit.empty()) words.insert(" " + std::string(key.unit));
    }
    for (std::string const& word : words) {
        std::string escaped;
        for (char const byte : word) escaped += byte == '"' || byte == '\\' ? std::string("\\") + byte : byte == '\n' ? "\\x0A" : std::string(1, byte);
        std::printf("\"%s\"\n", escaped.c_str());
    }
}
