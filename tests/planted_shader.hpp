#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>

#include "tests/shipped_shaders.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test {

/// Changes `text` to `replacement` in `folder`'s copy of the shader `file`, first made from the shipped one. `text`
/// stands there exactly once, or the test fails: a plant that changes nothing proves nothing.
inline void plant(const TemporaryFolder& folder, const std::string& file, const std::string& text,
                  const std::string& replacement) {
    const bool planted = std::filesystem::exists(folder.path() / file);
    std::ifstream stream((planted ? folder.path() : shipped_shaders(file)) / file, std::ios::binary);
    std::string shader{std::istreambuf_iterator<char>(stream), {}};
    INFO("shader " << file << ": " << text);
    const std::size_t place = shader.find(text);
    REQUIRE(place != std::string::npos);
    REQUIRE(shader.find(text, place + 1) == std::string::npos);
    folder.write(file, shader.replace(place, text.size(), replacement));
}

} // namespace lockstep::test
