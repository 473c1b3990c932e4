#include "gpu/desktop_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spirv_glsl.hpp>

#include "gpu/glsl_compiler.hpp"
#include "gpu/glslang_tables.hpp"
#include "gpu/old_glsl.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/spirv_translation.hpp"
#include "gpu/stage_texts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Words of Vulkan alone, and `set` in a layout, and images and samplers apart.
bool says_vulkan(const std::string& text) {
    static constexpr std::array<std::string_view, 6> own{"push_constant", "gl_VertexIndex", "gl_InstanceIndex",
                                                         "subpassInput",  "constant_id",    "input_attachment_index"};
    std::string_view before, last;
    for (ShaderWords words(text); words.next(); before = std::exchange(last, words.token())) {
        const std::string_view word = words.token();
        if (std::ranges::find(own, word) != own.end())
            return true;
        if (word == "=" && last == "set" && (before == "(" || before == ","))
            return true;
        if (last == "uniform" && (word == "sampler" || word == "texture2D" || word == "texture3D"))
            return true;
    }
    return false;
}

/// Names that a module has of its text.
std::set<std::string> names_in(std::span<const std::uint32_t> words) {
    std::set<std::string> names;
    for_each_instruction(words, [&](spv::Op op, std::span<const std::uint32_t> instruction) {
        const std::size_t first = op == spv::OpName ? 2 : 3;
        if ((op == spv::OpName || op == spv::OpMemberName) && instruction.size() > first) {
            const std::span<const std::uint32_t> text = instruction.subspan(first);
            const char* const name = reinterpret_cast<const char*>(text.data());
            names.emplace(name, strnlen(name, text.size_bytes()));
        }
    });
    return names;
}

/// spirv-cross puts _ before names that are functions' too: `step`. A text may have these, but for words of the later
/// language.
std::string with_own_names(const std::string& text, const std::set<std::string>& names) {
    static const std::set<std::string, std::less<>> words{"buffer", "shared", "precise"};
    std::string made;
    std::size_t copied = 0;
    for (ShaderWords all(text); all.next();) {
        const std::string own(all.token().substr(1));
        if (all.token().front() != '_' || !names.contains(own) || names.contains("_" + own) || words.contains(own))
            continue;
        const auto at = static_cast<std::size_t>(all.token().data() - text.data());
        made.append(text, copied, at - copied);
        copied = at + 1;
    }
    return made.append(text, copied);
}

/// `located`: what goes from stage to stage does by location, else by name.
std::string translated(const std::string& bytes, bool located) {
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    const std::set<std::string> names = names_in(words);
    spirv_cross::CompilerGLSL compiler(std::move(words));
    spirv_cross::CompilerGLSL::Options options = compiler.get_common_options();
    options.version = 450;
    options.es = false;
    options.enable_420pack_extension = false;
    options.emit_push_constant_as_uniform_buffer = true;
    options.emit_line_directives = true;
    compiler.set_common_options(options);
    compiler.build_combined_image_samplers();
    for (const spirv_cross::CombinedImageSampler& one : compiler.get_combined_image_samplers())
        compiler.set_name(one.combined_id, compiler.get_name(one.image_id));
    const spirv_cross::ShaderResources all = compiler.get_shader_resources();
    for (const auto* const some :
         {&all.uniform_buffers, &all.storage_buffers, &all.storage_images, &all.sampled_images})
        for (const spirv_cross::Resource& one : *some)
            for (const spv::Decoration which : {spv::DecorationBinding, spv::DecorationDescriptorSet})
                compiler.unset_decoration(one.id, which);
    for (const spirv_cross::VariableID id : compiler.get_active_interface_variables())
        if (compiler.get_storage_class(id) == spv::StorageClassUniformConstant)
            for (const spv::Decoration which : {spv::DecorationLocation, spv::DecorationBinding})
                compiler.unset_decoration(id, which);
    if (!located)
        unset_locations(compiler, all);
    return with_own_names(compiler.compile(), names);
}

/// The number of a line `#line N "FILE"`; 0: it is none.
std::size_t renumbered(std::string_view line) {
    constexpr std::string_view begin = "#line ";
    std::size_t number = 0;
    const std::size_t at = line.find_first_not_of(' ');
    if (at != std::string_view::npos && line.substr(at).starts_with(begin))
        std::from_chars(line.data() + at + begin.size(), line.data() + line.size(), number);
    return number;
}

/// What `layout(location = 0) in vec2 v_uv;` becomes where v_uv is given; any other line stays.
std::string with_given(const std::string& line, const GivenInputs& given) {
    const std::size_t name = line.rfind(' ') + 1, type = line.rfind(' ', name < 2 ? 0 : name - 2) + 1;
    if (type < 3 || !line.ends_with(';') || line.substr(type - 3, 3) != "in " || (type > 3 && line[type - 4] != ' '))
        return line;
    const auto found = given.find(line.substr(name, line.size() - name - 1));
    if (found == given.end())
        return line;
    return found->second == InputBy::place
               ? fmt::format("precise vec2 {} = gl_FragCoord.xy * {};", found->first, texel_size_uniform)
               : fmt::format("uniform {}", line.substr(type));
}

} // namespace

bool is_other_dialect(const std::string& text) {
    constexpr int oldest = 330;
    const GlslVersion version = version_in(text);
    return version.number == 0 ? says_old_glsl(text)
                               : version.profile == "es" || version.number < oldest || says_vulkan(text);
}

ShaderSource in_desktop_glsl(ShaderSource stage) {
    const std::string text = in_glslang_child(stage, [&] {
        std::pair<std::string, GlslReading> made = compile_any_dialect(stage);
        try {
            made.first = translated(made.first, goes_by_location(stage));
        } catch (const spirv_cross::CompilerError& error) {
            throw Error(
                fmt::format("shader {}: cannot be translated to desktop GLSL: {}", stage.files.front(), error.what()));
        }
        return made;
    });
    const std::vector<ShaderSource::Origin> origins = std::exchange(stage.origins, {});
    stage.text.clear();
    ShaderSource::Origin origin{0, 1};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (const std::size_t number = renumbered(line)) {
            origin = number <= origins.size() ? origins[number - 1] : ShaderSource::Origin{0, 1};
            continue;
        }
        if (line.starts_with("#extension GL_GOOGLE_"))
            continue;
        stage.text += with_given(line, stage.given) + "\n";
        stage.origins.push_back(origin);
        if (line.starts_with("#version") && !stage.given.empty()) {
            stage.text += fmt::format("uniform vec2 {};\n", texel_size_uniform);
            stage.origins.push_back(origin);
        }
    }
    return stage;
}

} // namespace lockstep
