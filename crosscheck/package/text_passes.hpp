#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/system.hpp"
#include "crosscheck/package/divergent_pass.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "gpu/shader_use.hpp"
#include "reference/known_operations.hpp"

namespace lockstep {

/// A system with its shaders: a scene's, or that of what a frame of it draws.
struct ShadedSystem {
    System& system;
    const std::vector<GlPass>& passes;
    ArithmeticSwitch arithmetic;
};

/// Of passes, the stages that the files are of.
std::vector<PassStages> stages_of(const std::vector<GlPass>& passes, ArithmeticSwitch arithmetic);

/// `references`: the shaders of `folder`, --reference. Throws Error where one is of a stage whose text is no reference.
void check_references(const ShaderUse& references, const std::filesystem::path& folder, std::span<const GlPass> passes);

/// Of each pass, its shader's text; null: it is not the user's own, or not interpreted.
using OwnTexts = std::vector<std::shared_ptr<const PassText>>;

/// Texts that are references, and a line for each.
struct References {
    OwnTexts texts;
    std::vector<std::string> lines;
};

/// Takes those that are a pass's as the references of the passes, instead of the twins. `gpu`: where the GPU's shaders
/// are, if that is known. Throws Error for one that is not interpreted.
References take_references(const ShadedSystem& of, const ShaderUse& references, const std::filesystem::path& folder,
                           const std::optional<std::filesystem::path>& gpu);

/// Of each pass whose shader is the user's own: what its text leaves open is legal (open_pass.hpp). A text that is not
/// interpreted leaves the pass as it is. Returns the texts.
OwnTexts open_by_own_text(const ShadedSystem& of, const ShaderUse& use, const std::filesystem::path& shaders);

/// The text of what dispatches pass p, in the user's folder or the shipped one; null: it has none, or its dispatch
/// wrote what it reads. Throws Error where it is not interpreted.
std::shared_ptr<const PassText> text_of_pass(const ShadedSystem& of, std::size_t p,
                                             const std::filesystem::path& shaders);

/// Has each pass show what its shader's text computes, item by item. `shaders`: where the user's own are.
void show_texts(const ShadedSystem& of, const std::filesystem::path& shaders);

/// Where a check is DIVERGENT in a pass whose shader is the user's own: the lines of its text that have no counterpart
/// in the reference's, which is in `reference` or the shipped one (text/witness.hpp).
std::vector<std::string> lines_without_counterpart(const ShadedSystem& of, const OwnTexts& own, const ShaderUse& use,
                                                   const std::filesystem::path& reference, DivergentPass& divergence);

} // namespace lockstep
