#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace lockstep::test {

/// The folder of the shipped shader `file`: the collision system's, the one that systems share, or another system's.
inline std::filesystem::path shipped_shaders(const std::string& file) {
    for (const char* folder : {"shaders/collision", "shaders", "shaders/dust", "shaders/lifecycle", "shaders/lights"})
        if (std::filesystem::exists(std::filesystem::path(folder) / file))
            return folder;
    return "shaders/fluid";
}

/// The text of the shipped shader shaders/`path`.
inline std::string shipped_text(const std::string& path) {
    std::ifstream stream("shaders/" + path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace lockstep::test
