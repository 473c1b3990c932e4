#pragma once
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "reference/text/stage_run.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test {

/// A vertex, geometry or fragment stage's text of its own, and what it is given, by name.
struct TextStage {
    TextStage(Stage stage, const std::string& text) : program(text::decoded(module_of(stage, text))) {}

    static text::Module module_of(Stage stage, const std::string& text) {
        auto source = std::make_shared<ShaderSource>();
        source->stage = stage;
        source->text = "#version 450 core\n" + text;
        source->files = {"stage"};
        for (int line = 0; line <= std::count(source->text.begin(), source->text.end(), '\n'); ++line)
            source->origins.push_back({0, std::max(line, 1)}); // the text begins at line 1
        return text::read_module(spirv_of(*source), [source](std::uint32_t line) { return line_name(*source, line); });
    }
    text::StageResult run(std::uint32_t invocations) {
        text::Bindings bindings;
        for (const text::Block& block : program.blocks)
            bindings.blocks.emplace_back(blocks.at(block.name));
        for (const text::PlainUniform& uniform : program.uniforms)
            bindings.uniforms.push_back(uniforms[uniform.name]);
        for (const text::ImageUniform& image : program.images) {
            text::TexelMemory texels = images.at(image.name).memory;
            texels.name = image.name;
            texels.words = images.at(image.name).words;
            bindings.images.push_back(texels);
        }
        return text::run_stage(program, {invocations, inputs, are_quads, is_watched, most_branches}, bindings,
                               named_profile("llvmpipe"), findings);
    }
    /// "LINE rule", and what it is of.
    [[nodiscard]] std::vector<std::string> found() const {
        std::vector<std::string> all;
        for (const text::Finding& one : findings.all())
            all.push_back(std::to_string(one.place.line - 1) + " " + one.rule.substr(0, one.rule.find(" (")) + ": " +
                          one.what);
        return all;
    }

    text::Program program;
    text::StageWords inputs;
    std::map<std::string, std::vector<std::uint32_t>> blocks, uniforms;
    std::map<std::string, TextKernel::TexelWords> images;
    text::Findings findings;
    bool is_watched = false, are_quads = false;
    std::uint32_t most_branches = 50'000'000;
};

} // namespace lockstep::test
