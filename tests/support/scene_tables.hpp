// Scenes that read tables, in folders of their own.
#pragma once

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>

#include "host/config/scene.hpp"

namespace slideway::testing {

/// A folder for one test, removed behind it.
class TableFolder {
public:
    TableFolder() {
        static int count = 0;
        path = std::filesystem::temp_directory_path() /
               ("slideway_tables_" + std::to_string(getpid()) + "_" + std::to_string(++count));
        std::filesystem::create_directories(path);
    }
    ~TableFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TableFolder(TableFolder const&) = delete;
    TableFolder& operator=(TableFolder const&) = delete;

    void write(std::string const& name, std::string const& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
    }
    /// The scene `scene.toml` of this folder with `schema = 1` above.
    Scene read(std::string const& text, Overrides const& overrides = {}) const {
        return parse_scene("schema = 1\n" + text, (path / "scene.toml").string(), overrides);
    }
    /// The line that refuses it, without the folder's name; empty if the scene is accepted.
    std::string error(std::string const& text, Overrides const& overrides = {}) const {
        try {
            read(text, overrides);
        } catch (SceneError const& error) {
            std::string line = error.what();
            std::string const folder = path.string() + "/";
            for (auto at = line.find(folder); at != line.npos; at = line.find(folder)) line.erase(at, folder.size());
            return line;
        }
        return {};
    }

    std::filesystem::path path;
};

}  // namespace slideway::testing
