#include "gpu/program_interface.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "gpu/glsl_type.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {

void ProgramInterface::add(ProgramVariable variable) {
    std::string name = variable.name;
    add(std::move(variable), name);
}

void ProgramInterface::add(ProgramVariable variable, const std::string& name) {
    given_.emplace(name, Given{variables_.size()});
    variables_.push_back(std::move(variable));
}

void ProgramInterface::add(ProgramVariable variable, const UniformBinding& binding, const std::string& file) {
    const std::size_t given = std::max(binding.names.size(), binding.numbers.size());
    const auto wanted = static_cast<std::size_t>(output_components(variable.type));
    if (given != wanted)
        throw Error(fmt::format("{}: {}: {} value{} for a {}", file, binding.path, given, given == 1 ? "" : "s",
                                type_name(variable.type)));
    for (std::size_t c = 0; c < binding.names.size(); ++c)
        given_.emplace(binding.names[c], Given{variables_.size(), static_cast<int>(c)});
    variable.declared.is_initialised = variable.declared.is_initialised || !binding.numbers.empty();
    variables_.push_back(std::move(variable));
}

std::vector<ProgramInterface::Given> ProgramInterface::asked(std::string_view name, GLenum type) const {
    if (!asked_for_.contains(name))
        asked_for_.emplace(name, type);
    std::vector<Given> found;
    const auto [first, last] = given_.equal_range(name);
    for (auto one = first; one != last; ++one) {
        const ProgramVariable& variable = variables_[one->second.variable];
        if (one->second.component < 0 && variable.type != type)
            throw Error(fmt::format("shader {}: {} {} is {}, but is to be {}", variable.declared.place, kind_,
                                    variable.name, type_name(variable.type), type_name(type)));
        found.push_back(one->second);
    }
    return found;
}

std::string ProgramInterface::meant_by(std::string_view name, GLenum type) const {
    std::string nearest;
    std::size_t fewest = std::max<std::size_t>(2, name.size() / 3) + 1; // a slip, not another name
    for (const auto& [known, known_type] : asked_for_) {
        const std::size_t distance = edits(known, name) + (known_type == type ? 0 : 1); // a slip in the type as well
        if (distance >= fewest)
            continue;
        fewest = distance;
        nearest = fmt::format("; did you mean {} {}?", type_name(known_type), known);
    }
    return nearest;
}

std::vector<std::string> ProgramInterface::unknown() const {
    std::vector<std::string> found;
    for (const auto& [name, given] : given_) {
        const ProgramVariable& variable = variables_[given.variable];
        if (asked_for_.contains(name) || variable.declared.is_initialised || variable.name.starts_with("gl_"))
            continue;
        const std::string bound = name == variable.name ? "" : fmt::format(" (bound to {})", name);
        found.push_back(fmt::format("{}: nothing is given for {} {}{}{}", variable.declared.place, kind_, variable.name,
                                    bound, meant_by(name, variable.type)));
    }
    return found;
}

namespace {

std::string block_name(GLuint program, GLuint block) {
    char name[256] = {};
    gl::GetActiveUniformBlockName(program, block, sizeof name, nullptr, name);
    return name;
}

GLint about(GLuint program, GLuint uniform, GLenum property) {
    GLint value = 0;
    gl::GetActiveUniformsiv(program, 1, &uniform, property, &value);
    return value;
}

/// What a uniform block's member is called in it: "tick" of "Frame.tick".
std::string member_name(const std::string& name) { return name.substr(name.find_last_of('.') + 1); }

/// Where the first uniform block that nothing is given for begins.
std::string block_place(std::span<const ShaderSource> stages, const std::string& block) {
    for (const ShaderSource& stage : stages) {
        std::string before, last;
        for (ShaderWords words(stage.text); words.next();) {
            if (words.token() == "{" && before == "uniform" && last == block) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                return fmt::format("{}:{}", stage.files[origin.file], origin.line);
            }
            before = std::exchange(last, std::string(words.token()));
        }
    }
    return stages.front().files.front();
}

} // namespace

UniformValues::UniformValues(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings) {
    GLint count = 0, blocks = 0;
    gl::GetProgramiv(program, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLuint b = 0; b < static_cast<GLuint>(blocks); ++b) {
        const std::string name = block_name(program, b);
        if (bindings == nullptr || !bindings->binds_block(name))
            throw Error(fmt::format("shader {}: nothing is given for uniform block {}; {} beside the shader binds its "
                                    "members (docs/own_shader.md)",
                                    block_place(stages, name), name, bindings_file));
        GLint bytes = 0;
        gl::GetActiveUniformBlockiv(program, b, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        gl::UniformBlockBinding(program, b, b);
        gl::BindBuffer(GL_UNIFORM_BUFFER, blocks_.emplace_back().id());
        gl::BufferData(GL_UNIFORM_BUFFER, bytes, std::vector<std::byte>(static_cast<std::size_t>(bytes)).data(),
                       GL_DYNAMIC_DRAW);
    }
    gl::GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLuint u = 0; u < static_cast<GLuint>(count); ++u) {
        char name[256] = {};
        GLint size = 0;
        ProgramVariable variable;
        gl::GetActiveUniform(program, u, sizeof name, nullptr, &size, &variable.type, name);
        variable.name = name;
        variable.location = gl::GetUniformLocation(program, name);
        variable.block = about(program, u, GL_UNIFORM_BLOCK_INDEX);
        if (variable.block >= 0) {
            variable.offset = about(program, u, GL_UNIFORM_OFFSET);
            variable.matrix_stride = about(program, u, GL_UNIFORM_MATRIX_STRIDE);
            variable.row_major = about(program, u, GL_UNIFORM_IS_ROW_MAJOR) != 0;
            const std::string block = block_name(program, static_cast<GLuint>(variable.block));
            variable.declared.place = block_place(stages, block);
            variable.name = fmt::format("{}.{}", block, member_name(name));
        } else {
            variable.declared = find_declaration(stages, "uniform",
                                                 std::string_view(name).substr(0, variable.name.find_first_of("[.")));
        }
        add(std::move(variable), bindings);
    }
    gl::UseProgram(program);
    for (const auto& [variable, numbers] : constants_)
        for (std::size_t c = 0; c < numbers.size(); ++c)
            set_component({variable, static_cast<int>(c)}, GL_FLOAT,
                          std::bit_cast<std::uint32_t>(static_cast<float>(numbers[c])));
    gl::UseProgram(0);
}

void UniformValues::add(ProgramVariable variable, const Bindings* bindings) {
    const auto none = std::map<std::string, UniformBinding, std::less<>>::const_iterator{};
    const auto found = bindings == nullptr ? none : bindings->uniforms.find(variable.name);
    if (bindings == nullptr || found == bindings->uniforms.end())
        return interface_.add(std::move(variable));
    const UniformBinding& binding = found->second;
    if (binding.numbers.empty() && !binding.by_component)
        return interface_.add(std::move(variable), binding.names.front());
    if (!binding.numbers.empty())
        constants_[interface_.size()] = binding.numbers;
    interface_.add(std::move(variable), binding, bindings->file);
}

void UniformValues::set(std::string_view name, GLenum type, std::span<const std::uint32_t> words) const {
    for (const ProgramInterface::Given& given : interface_.asked(name, type)) {
        if (given.component < 0)
            write(given.variable, words);
        else if (words.size() == 1)
            set_component(given, type, words.front());
        else
            throw Error(fmt::format("shader {}: {} of uniform {} is to be one number, but {} is {}",
                                    interface_[given.variable].declared.place, "xyzw"[given.component],
                                    interface_[given.variable].name, name, type_name(type)));
    }
}

void UniformValues::set_component(const ProgramInterface::Given& given, GLenum type, std::uint32_t word) const {
    const GLenum whole = interface_[given.variable].type;
    if (is_float_type(whole) != is_float_type(type)) {
        if (type == GL_FLOAT)
            word = std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(std::bit_cast<float>(word)));
        else if (type == GL_UNSIGNED_INT)
            word = std::bit_cast<std::uint32_t>(static_cast<float>(word));
        else
            word = std::bit_cast<std::uint32_t>(static_cast<float>(std::bit_cast<std::int32_t>(word)));
    }
    std::array<std::uint32_t, 4>& all = by_component_[given.variable];
    all[static_cast<std::size_t>(given.component)] = word;
    write(given.variable, {all.data(), static_cast<std::size_t>(output_components(whole))});
}

void UniformValues::write(std::size_t variable, std::span<const std::uint32_t> words) const {
    const ProgramVariable& to = interface_[variable];
    if (to.block >= 0) {
        gl::BindBuffer(GL_UNIFORM_BUFFER, blocks_[static_cast<std::size_t>(to.block)].id());
        if (to.type != GL_FLOAT_MAT4) {
            gl::BufferSubData(GL_UNIFORM_BUFFER, to.offset, static_cast<GLsizeiptr>(words.size_bytes()), words.data());
            return;
        }
        for (std::size_t line = 0; line < 4; ++line) {
            std::array<std::uint32_t, 4> values{};
            for (std::size_t i = 0; i < 4; ++i)
                values[i] = to.row_major ? words[4 * i + line] : words[4 * line + i];
            gl::BufferSubData(GL_UNIFORM_BUFFER, to.offset + static_cast<GLintptr>(line) * to.matrix_stride,
                              sizeof values, values.data());
        }
        return;
    }
    const auto* const floats = reinterpret_cast<const GLfloat*>(words.data());
    const auto* const integers = reinterpret_cast<const GLint*>(words.data());
    // glUniform ignores location -1, an unused uniform's.
    switch (to.type) {
    case GL_FLOAT:
        return gl::Uniform1f(to.location, *floats);
    case GL_FLOAT_VEC2:
        return gl::Uniform2fv(to.location, 1, floats);
    case GL_FLOAT_VEC3:
        return gl::Uniform3fv(to.location, 1, floats);
    case GL_FLOAT_VEC4:
        return gl::Uniform4fv(to.location, 1, floats);
    case GL_INT_VEC2:
        return gl::Uniform2iv(to.location, 1, integers);
    case GL_INT_VEC3:
        return gl::Uniform3iv(to.location, 1, integers);
    case GL_INT_VEC4:
        return gl::Uniform4iv(to.location, 1, integers);
    case GL_UNSIGNED_INT:
        return gl::Uniform1ui(to.location, words.front());
    case GL_FLOAT_MAT4:
        return gl::UniformMatrix4fv(to.location, 1, GL_FALSE, floats);
    default: // int, bool, samplers and images
        return gl::Uniform1i(to.location, *integers);
    }
}

void UniformValues::bind() const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        gl::BindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(b), blocks_[b].id());
}

} // namespace lockstep
