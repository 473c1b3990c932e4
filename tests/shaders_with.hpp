#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "tests/temporary_folder.hpp"

namespace lockstep::test {

/// The shaders of a folder into another, in one of them a text replaced wherever it stands.
inline void copy_replacing(const std::filesystem::path& from, const TemporaryFolder& to, const std::string& file,
                           const std::string& text, const std::string& replacement) {
    for (const auto& entry : std::filesystem::directory_iterator(from)) {
        std::ostringstream all;
        all << std::ifstream(entry.path()).rdbuf();
        std::string shader = all.str();
        if (entry.path().filename() == file) {
            std::size_t at = shader.find(text);
            REQUIRE(at != std::string::npos);
            for (; at != std::string::npos; at = shader.find(text, at + replacement.size()))
                shader.replace(at, text.size(), replacement);
        }
        to.write(entry.path().filename(), shader);
    }
}

} // namespace lockstep::test
