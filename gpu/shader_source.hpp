#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/bindings.hpp"
#include "reference/model/arithmetic_switch.hpp"

namespace lockstep {

struct SpirvModule;

/// Shaders are files NAME.vert, NAME.geom, NAME.frag, NAME.comp and the .glsl files they include, or SPIR-V modules
/// NAME.vert.spv, ...
enum class Stage { vertex, geometry, fragment, compute };

/// File name extension, with its dot.
std::string_view extension(Stage stage);

/// Folders a shader file is looked for in, in this order.
using ShaderFolders = std::vector<std::filesystem::path>;

/// `user` (--shaders DIR), if given, then the built-in folder of `system`, if it has one, then the one that all systems
/// share (data_folder.hpp). Throws Error if `user` is no folder, or there is no built-in one.
ShaderFolders shader_folders(const std::filesystem::path& user = {}, std::string_view system = {});

/// The text of a shader's file, without a byte order mark, or a SPIR-V module. Throws Error naming the file: it is no
/// file, too long, or no UTF-8 text.
std::string read_shader_file(const std::filesystem::path& path);

/// Preprocessor definitions, name and value.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

/// Files that are in no folder, by their names.
using ShaderTexts = std::map<std::string, std::string>;

/// With what a pass's files are put together.
struct StageInput {
    ShaderDefines defines = {};
    ShaderTexts texts = {};
    bool operator==(const StageInput&) const = default;
};

/// A choice among named values: a number for each value and the one that is chosen, in upper case:
/// BASE_TEXEL_TRUNCATE 0, BASE_TEXEL_FLOOR 1, BASE_TEXEL BASE_TEXEL_FLOOR.
ShaderDefines choice_defines(std::string_view name, std::span<const std::string_view> values, std::size_t chosen);

/// The choices of all switches of a system, whose for_each_switch lies beside them.
template <class Switches> ShaderDefines switch_defines(const Switches& switches) {
    ShaderDefines all;
    for_each_switch(switches, [&](std::string_view name, auto value, const std::vector<std::string_view>& names) {
        const ShaderDefines one = choice_defines(name, names, static_cast<std::size_t>(value));
        all.insert(all.end(), one.begin(), one.end());
    });
    return all;
}

/// What arithmetic.glsl asks for.
ShaderDefines arithmetic_defines(ArithmeticSwitch arithmetic);

/// What an input of a full-screen fragment stage is: its place in the image, 0 to 1, which is gl_FragCoord.xy times
/// 1 / size; or the same for all, given as a uniform of its name.
enum class InputBy : std::uint8_t { place, uniform };
using GivenInputs = std::map<std::string, InputBy>;

/// One stage, ready to compile: definitions inserted after #version and `#include "file.glsl"` lines replaced by the
/// file (as in C, also where an #if excludes it).
struct ShaderSource {
    /// Where a line of `text` comes from. Kept here and not in #line directives: Mesa 22.3 loses their file number
    /// inside expressions, and before GLSL 3.30 they count lines another way.
    struct Origin {
        std::size_t file = 0; ///< index into files
        int line = 1;         ///< from 1; an inserted definition counts as the #version line
    };
    Stage stage = Stage::vertex;
    std::string text;
    std::vector<Origin> origins;    ///< one a line of text
    std::vector<std::string> files; ///< the stage's own file first; shipped ones as "shaders/NAME", wherever they lie
    std::shared_ptr<const Bindings> bindings = {};  ///< beside the stage's own file, else beside one that it includes
    std::shared_ptr<const SpirvModule> module = {}; ///< a stage in SPIR-V, which has no text; null: GLSL
    GivenInputs given = {};                         ///< of a full-screen fragment stage
};

/// Whether a stage says `precise` of something.
bool says_precise(const ShaderSource& stage);

/// Whether its text asks an array for its length; a module may.
bool asks_length(const ShaderSource& stage);

/// The text of bindings.json for the shaders of a folder, until take_bindings: it counts in the place of the file
/// there. Throws Error where a text was given already.
void give_bindings(const std::filesystem::path& folder, std::string text);
void take_bindings(const std::filesystem::path& folder) noexcept;

/// Throws Error naming the folders if a file is in none of them; FILE:LINE if an include is malformed, missing or
/// circular, or the stage has no #version. Of a SPIR-V module there are no definitions.
/// Throws Error where both kinds of a stage lie in one folder.
ShaderSource load_stage(const ShaderFolders& folders, std::string_view name, Stage stage,
                        const ShaderDefines& defines = {});

/// `stage` with the text of `end`, which has no definitions, behind its own, whose #version holds for both.
ShaderSource continued(ShaderSource stage, const ShaderSource& end);

/// The stages of one program. A geometry stage's file that holds nothing but white space leaves the stage out, so a
/// user's folder can do without a built-in one. Throws Error where another stage's file does. `texts` are looked for
/// first.
std::vector<ShaderSource> load_stages(const ShaderFolders& folders, std::string_view name,
                                      std::span<const Stage> stages, const ShaderDefines& defines = {},
                                      const ShaderTexts& texts = {});

} // namespace lockstep
