#include "gpu/program_interface.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "gpu/glsl_type.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/spirv_module.hpp"
#include "gpu/uniform_words.hpp"
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
    const std::size_t given = binding.values.size();
    const auto wanted = static_cast<std::size_t>(output_components(variable.type));
    if (given != wanted || wanted > 4)
        throw Error(fmt::format("{}: {}: {} value{} for a {}", file, binding.path, given, given == 1 ? "" : "s",
                                type_name(variable.type)));
    bool names_any = false;
    for (std::size_t c = 0; c < given; ++c)
        if (const auto* name = std::get_if<std::string>(&binding.values[c])) {
            given_.emplace(*name, Given{variables_.size(), static_cast<int>(c)});
            names_any = true;
        }
    variable.declared.is_initialised = variable.declared.is_initialised || !names_any;
    variables_.push_back(std::move(variable));
}

std::vector<ProgramInterface::Given> ProgramInterface::asked(std::string_view name, GLenum type) const {
    if (!asked_for_.contains(name))
        asked_for_.emplace(name, type);
    std::vector<Given> found;
    const auto [first, last] = given_.equal_range(name);
    for (auto one = first; one != last; ++one) {
        const ProgramVariable& variable = variables_[one->second.variable];
        // In a block a bool is a word.
        const bool is_bool_word = variable.block >= 0 && variable.type == GL_BOOL && type == GL_UNSIGNED_INT;
        if (one->second.component < 0 && variable.type != type && !is_bool_word)
            throw Error(fmt::format("shader {}: {} {} is {}, but must be {}", variable.declared.place, kind_,
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
    std::set<std::string> arrays; // of which an element was found
    std::set<std::size_t> whole;  // variables bound by component to a vector's components
    for (const auto& [name, given] : given_) {
        const ProgramVariable& variable = variables_[given.variable];
        if (asked_for_.contains(name) || variable.declared.is_initialised || variable.name.starts_with("gl_"))
            continue;
        if (variable.name.ends_with(']') && !arrays.insert(variable.name.substr(0, variable.name.rfind('['))).second)
            continue;
        const std::size_t dot = name.rfind('.');
        if (given.component >= 0 && dot != std::string::npos && asked_for_.contains(name.substr(0, dot))) {
            if (whole.insert(given.variable).second)
                found.push_back(fmt::format("{}: {} {} is bound to {}, a component; right is {} as a whole",
                                            variable.declared.place, kind_, variable.name, name, name.substr(0, dot)));
            continue;
        }
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

/// What a uniform block's member is called in it: "sun.colour" of "Frame.sun.colour", of an instance.
std::string name_in_block(const std::string& name, const std::string& block) {
    return name.starts_with(block + ".") ? name.substr(block.size() + 1) : name;
}

/// "tick" of "Frame.now.tick".
std::string last_name(const std::string& name) { return name.substr(name.find_last_of('.') + 1); }

/// Each element of an array by itself, "weights[0]" and so on; else the variable alone.
std::vector<ProgramVariable> elements(const ProgramVariable& variable, GLint size, GLint stride) {
    if (!variable.name.ends_with("[0]"))
        return {variable};
    std::vector<ProgramVariable> all;
    const std::string name = variable.name.substr(0, variable.name.size() - 3);
    for (GLint i = 0; i < size; ++i) {
        all.push_back(variable);
        all.back().name = fmt::format("{}[{}]", name, i);
        all.back().offset += i * stride;
        all.back().location += variable.location < 0 ? 0 : i;
    }
    return all;
}

/// What is given for the array or structure that a variable is of: for "lights" of "Frame.lights[0].colour[1]", which
/// is "Frame.lights" in a block. Null: nothing.
const UniformBinding* binding_of_whole(const ProgramVariable& variable, const Bindings& bindings) {
    const std::size_t first = variable.block >= 0 ? variable.name.find('.') + 1 : 0;
    for (std::size_t end = variable.name.find_first_of("[.", first); end != std::string::npos;
         end = variable.name.find_first_of("[.", end + 1))
        if (const auto found = bindings.uniforms.find(variable.name.substr(0, end)); found != bindings.uniforms.end())
            return &found->second;
    return nullptr;
}

/// Types that values here have, and numbers of a shader's own can.
bool has_value(GLenum type) {
    const int components = output_components(type);
    return (components > 0 && components <= 4 && type != GL_FLOAT_MAT2) || type == GL_FLOAT_MAT4;
}

/// Throws Error for a number of bindings.json that a component of the variable does not hold.
void check_number(double number, const ProgramVariable& variable, const UniformBinding& binding,
                  const std::string& file) {
    if (!word_of(number, variable.type))
        throw Error(fmt::format("{}: {}: {} is no value of {}, which is {}; expected a whole number that it holds",
                                file, binding.path, number, variable.name, type_name(variable.type)));
}

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
    if (stages.front().module != nullptr) {
        add_modules(stages, bindings);
    } else {
        add_blocks(program, stages, bindings);
        add_uniforms(program, stages, bindings);
    }
    gl::UseProgram(program);
    for (const auto& [component, number] : constants_)
        set_component(component, interface_[component.variable].type,
                      *word_of(number, interface_[component.variable].type));
    gl::UseProgram(0);
}

void UniformValues::add_block(const std::string& name, const std::string& place, GLint bytes, GLuint point,
                              const Bindings* bindings) {
    if (bindings == nullptr || !bindings->binds_block(name))
        throw Error(fmt::format("shader {}: nothing is given for uniform block {}; {} beside the shader binds its "
                                "members (docs/own_shader.md)",
                                place, name, bindings_file));
    gl::BindBuffer(GL_UNIFORM_BUFFER, blocks_.emplace_back().id());
    gl::BufferData(GL_UNIFORM_BUFFER, bytes, std::vector<std::byte>(static_cast<std::size_t>(bytes)).data(),
                   GL_DYNAMIC_DRAW);
    points_.push_back(point);
}

void UniformValues::add_blocks(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings) {
    GLint blocks = 0;
    gl::GetProgramiv(program, GL_ACTIVE_UNIFORM_BLOCKS, &blocks);
    for (GLuint b = 0; b < static_cast<GLuint>(blocks); ++b) {
        const std::string name = block_name(program, b);
        GLint bytes = 0;
        gl::GetActiveUniformBlockiv(program, b, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
        gl::UniformBlockBinding(program, b, b);
        add_block(name, block_place(stages, name), bytes, b, bindings);
    }
}

/// By the modules alone: their blocks keep the binding points that they say.
void UniformValues::add_modules(std::span<const ShaderSource> stages, const Bindings* bindings) {
    for (const ShaderSource& stage : stages) {
        for (const InterfaceBlock& block : stage.module->uniform_blocks) {
            const auto point = static_cast<GLuint>(block.binding);
            if (std::find(points_.begin(), points_.end(), point) != points_.end())
                continue; // of a stage before
            add_block(block.name, stage.files.front(), block.bytes, point, bindings);
            for (const BlockMember& member : block.members)
                for (ProgramVariable& one : elements({fmt::format("{}.{}", block.name, member.name),
                                                      -1,
                                                      member.type,
                                                      {stage.files.front()},
                                                      static_cast<GLint>(blocks_.size()) - 1,
                                                      member.offset,
                                                      member.matrix_stride,
                                                      member.row_major},
                                                     member.size, member.array_stride))
                    add(std::move(one), bindings);
        }
        for (const SpirvModule::Variable& uniform : stage.module->uniforms)
            for (ProgramVariable& one : elements({uniform.size == 1 ? uniform.name : uniform.name + "[0]",
                                                  uniform.location,
                                                  uniform.type,
                                                  {stage.files.front(), uniform.is_initialised}},
                                                 uniform.size, 0))
                add(std::move(one), bindings);
    }
}

void UniformValues::add_uniforms(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings) {
    GLint count = 0;
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
            variable.name = fmt::format("{}.{}", block, name_in_block(name, block));
        } else {
            variable.declared = find_declaration(stages, "uniform",
                                                 std::string_view(name).substr(0, variable.name.find_first_of("[.")));
        }
        GLint stride = 0;
        if (variable.block >= 0)
            stride = about(program, u, GL_UNIFORM_ARRAY_STRIDE);
        for (ProgramVariable& one : elements(variable, size, stride))
            add(std::move(one), bindings);
    }
}

void UniformValues::add(ProgramVariable variable, const Bindings* bindings) {
    if (bindings == nullptr)
        return interface_.add(std::move(variable));
    auto found = bindings->uniforms.find(variable.name);
    if (found == bindings->uniforms.end() && variable.name.find('.') != std::string::npos) // a member by its own name
        found = bindings->uniforms.find(
            variable.block < 0
                ? last_name(variable.name)
                : fmt::format("{}.{}", variable.name.substr(0, variable.name.find('.')), last_name(variable.name)));
    if (found == bindings->uniforms.end()) {
        if (const UniformBinding* const whole = binding_of_whole(variable, *bindings))
            fill(variable, *whole, bindings->file);
        return interface_.add(std::move(variable));
    }
    const UniformBinding& binding = found->second;
    for (std::size_t before = 0; before < interface_.size(); ++before)
        if (interface_[before].block == variable.block && variable.name != found->first &&
            last_name(interface_[before].name) == last_name(variable.name))
            throw Error(fmt::format("{}: {}: {} and {} both have this name; right is the whole of it for each",
                                    bindings->file, binding.path, interface_[before].name, variable.name));
    const auto* const name = std::get_if<std::string>(&binding.values.front());
    const bool by_component = binding.is_list || name == nullptr;
    if (!has_value(variable.type) && by_component)
        throw Error(fmt::format("{}: {}: {} is {}; right here are numbers and vectors of float, int and uint, and mat4",
                                bindings->file, binding.path, variable.name, type_name(variable.type)));
    if (binding.transposed && variable.type != GL_FLOAT_MAT4)
        throw Error(fmt::format("{}: {}: {} is {}; transpose() is of a mat4", bindings->file, binding.path,
                                variable.name, type_name(variable.type)));
    variable.transposed = binding.transposed;
    if (!by_component)
        return interface_.add(std::move(variable), *name);
    for (std::size_t c = 0; c < binding.values.size(); ++c)
        if (const auto* number = std::get_if<double>(&binding.values[c])) {
            check_number(*number, variable, binding, bindings->file);
            constants_.push_back({{interface_.size(), static_cast<int>(c)}, *number});
        }
    interface_.add(std::move(variable), binding, bindings->file);
}

void UniformValues::fill(ProgramVariable& variable, const UniformBinding& binding, const std::string& file) {
    const auto* const number = std::get_if<double>(&binding.values.front());
    if (number == nullptr || binding.is_list)
        throw Error(fmt::format("{}: {}: {} is an element or a member of it; right for all of them is one number", file,
                                binding.path, variable.name));
    const int components = output_components(variable.type);
    if (*number != 0.0 && (!has_value(variable.type) || components > 4))
        throw Error(fmt::format("{}: {}: {} is {}; the number for it is 0", file, binding.path, variable.name,
                                type_name(variable.type)));
    check_number(*number, variable, binding, file);
    for (int c = 0; *number != 0.0 && c < components; ++c)
        constants_.push_back({{interface_.size(), c}, *number});
    variable.declared.is_initialised = true;
}

void UniformValues::set(std::string_view name, GLenum type, std::span<const std::uint32_t> words) const {
    for (const ProgramInterface::Given& given : interface_.asked(name, type)) {
        if (given.component < 0)
            write(given.variable, words);
        else if (words.size() == 1)
            set_component(given, type, words.front());
        else
            throw Error(fmt::format("shader {}: {} of uniform {} must be one number, but {} is {}",
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
        const std::size_t side = to.type == GL_FLOAT_MAT2   ? 2
                                 : to.type == GL_FLOAT_MAT3 ? 3
                                 : to.type == GL_FLOAT_MAT4 ? 4
                                                            : 0;
        if (side == 0) {
            gl::BufferSubData(GL_UNIFORM_BUFFER, to.offset, static_cast<GLsizeiptr>(words.size_bytes()), words.data());
            return;
        }
        for (std::size_t line = 0; line < side; ++line) {
            std::array<std::uint32_t, 4> values{};
            for (std::size_t i = 0; i < side; ++i)
                values[i] = to.row_major != to.transposed ? words[side * i + line] : words[side * line + i];
            gl::BufferSubData(GL_UNIFORM_BUFFER, to.offset + static_cast<GLintptr>(line) * to.matrix_stride,
                              static_cast<GLsizeiptr>(side * sizeof values[0]), values.data());
        }
        return;
    }
    if (!set_uniform_words(to.location, to.type, words, to.transposed))
        gl::Uniform1i(to.location, static_cast<GLint>(words.front())); // samplers and images
}

void UniformValues::bind() const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        gl::BindBufferBase(GL_UNIFORM_BUFFER, points_[b], blocks_[b].id());
}

} // namespace lockstep
