#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crosscheck/text/glsl_module.hpp"
#include "reference/text/dispatch.hpp"

namespace lockstep::test {

inline std::vector<std::uint32_t> words_of(const std::vector<float>& floats) {
    std::vector<std::uint32_t> words;
    for (const float x : floats)
        words.push_back(std::bit_cast<std::uint32_t>(x));
    return words;
}
inline std::vector<float> floats_of(const std::vector<std::uint32_t>& words) {
    std::vector<float> floats;
    for (const std::uint32_t word : words)
        floats.push_back(std::bit_cast<float>(word));
    return floats;
}

/// A stage's text of its own, and what its blocks, uniforms and images hold, by name.
struct BoundText {
    BoundText(Stage stage, const std::string& text, const std::string& file)
        : program(text::decoded(module_of(stage, text, file))) {}

    static text::Module module_of(Stage stage, const std::string& text, const std::string& file) {
        auto source = std::make_shared<ShaderSource>();
        source->stage = stage;
        const bool is_whole = text.starts_with("#version");
        source->text = is_whole ? text : "#version 450 core\n" + text;
        source->files = {file};
        for (int line = 0; line <= std::count(source->text.begin(), source->text.end(), '\n'); ++line)
            source->origins.push_back({0, is_whole ? line + 1 : std::max(line, 1)}); // the text begins at line 1
        return text::read_module(spirv_of(*source), [source](std::uint32_t line) { return line_name(*source, line); });
    }
    [[nodiscard]] text::Bindings bindings() {
        text::Bindings all;
        for (const text::Block& block : program.blocks)
            all.blocks.emplace_back(blocks.at(block.name));
        for (const text::PlainUniform& uniform : program.uniforms)
            all.uniforms.push_back(uniforms[uniform.name]);
        for (const text::ImageUniform& image : program.images) {
            text::TexelMemory texels = images.at(image.name).memory;
            texels.name = image.name;
            texels.words = images.at(image.name).words;
            all.images.push_back(texels);
        }
        return all;
    }

    struct TexelWords {
        text::TexelMemory memory;
        std::vector<std::uint32_t> words;
    };
    text::Program program;
    std::map<std::string, std::vector<std::uint32_t>> blocks, uniforms;
    std::map<std::string, TexelWords> images;
    text::Findings findings;
    bool is_watched = false;
    std::uint32_t subgroup_size = 0;
    std::uint32_t most_branches = 50'000'000;
    text::Coverage* coverage = nullptr;
};

struct TextKernel : BoundText {
    explicit TextKernel(const std::string& text) : BoundText(Stage::compute, text, "kernel.comp") {}

    void run(std::array<std::uint32_t, 3> groups = {1, 1, 1}, const Profile& profile = named_profile("llvmpipe")) {
        text::run_dispatch(program,
                           {.groups = groups,
                            .is_watched = is_watched,
                            .most_branches = most_branches,
                            .subgroup_size = subgroup_size,
                            .coverage = coverage},
                           bindings(), profile, findings);
    }
};

/// What invocation 0 of `statements`, behind `declarations`, leaves in `float x[]`, of 16.
inline std::vector<float> computed(const std::string& statements, const std::string& declarations = "",
                                   const std::vector<float>& given = {}) {
    TextKernel kernel("layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n" +
                      declarations + "\nvoid main() {\n" + statements + "\n}\n");
    std::vector<float> floats = given;
    floats.resize(16);
    kernel.blocks["Out"] = words_of(floats);
    kernel.run();
    return floats_of(kernel.blocks["Out"]);
}

} // namespace lockstep::test
