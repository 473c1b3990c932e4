#pragma once
#include <filesystem>
#include <string>

namespace lockstep::test {

/// The folder of the shipped shader `file`: the collision system's, or the one that systems share.
inline std::filesystem::path shipped_shaders(const std::string& file) {
    const std::filesystem::path own = "shaders/collision";
    return std::filesystem::exists(own / file) ? own : own.parent_path();
}

} // namespace lockstep::test
