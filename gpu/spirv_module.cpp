#include "gpu/spirv_module.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <spirv_glsl.hpp>
#include <spirv_parser.hpp>

#include "gpu/child_process.hpp"
#include "gpu/glsl_type.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/spirv_check.hpp"
#include "gpu/spirv_module_bytes.hpp"
#include "gpu/spirv_translation.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using spirv_cross::SPIRType;

/// spirv-cross trusts what it reads, and so do validators up to a point.
constexpr ChildRules reader{"spirv-cross", 20, true};

spv::ExecutionModel execution_model(Stage stage) {
    switch (stage) {
    case Stage::vertex:
        return spv::ExecutionModelVertex;
    case Stage::geometry:
        return spv::ExecutionModelGeometry;
    case Stage::fragment:
        return spv::ExecutionModelFragment;
    case Stage::compute:
        break;
    }
    return spv::ExecutionModelGLCompute;
}

/// As glslangValidator -S calls it.
std::string_view stage_word(Stage stage) { return extension(stage).substr(1); }

std::string remedy(Stage stage) {
    return fmt::format("`glslangValidator -G -S {}` compiles GLSL for OpenGL (docs/translators.md)", stage_word(stage));
}

GLenum numeric_type(const SPIRType& type) {
    const bool is_double = type.basetype == SPIRType::Double;
    std::string_view scalar, prefix;
    switch (type.basetype) {
    case SPIRType::Float:
        scalar = "float";
        break;
    case SPIRType::Double:
        scalar = "double", prefix = "d";
        break;
    case SPIRType::Int:
        scalar = "int", prefix = "i";
        break;
    case SPIRType::UInt:
        scalar = "uint", prefix = "u";
        break;
    case SPIRType::Boolean:
        scalar = "bool", prefix = "b";
        break;
    default:
        return 0;
    }
    if (type.columns == 1 && type.vecsize == 1)
        return type_named(scalar);
    if (type.columns == 1)
        return type_named(fmt::format("{}vec{}", prefix, type.vecsize));
    const std::string_view matrix = is_double ? "dmat" : "mat";
    return type_named(type.columns == type.vecsize ? fmt::format("{}{}", matrix, type.columns)
                                                   : fmt::format("{}{}x{}", matrix, type.columns, type.vecsize));
}

GLenum opaque_type(const spirv_cross::Compiler& module, const SPIRType& type) {
    const SPIRType::BaseType of = module.get_type(type.image.type).basetype;
    const std::string_view prefix = of == SPIRType::Int ? "i" : of == SPIRType::UInt ? "u" : "";
    const std::string_view kind = type.basetype == SPIRType::Image ? "image" : "sampler";
    constexpr std::array<std::string_view, 6> dimensions{"1D", "2D", "3D", "Cube", "2DRect", "Buffer"};
    const auto dimension = static_cast<std::size_t>(type.image.dim);
    return dimension >= dimensions.size()
               ? 0
               : type_named(fmt::format("{}{}{}{}{}{}", prefix, kind, dimensions[dimension], type.image.ms ? "MS" : "",
                                        type.image.arrayed ? "Array" : "",
                                        type.image.depth && kind == "sampler" ? "Shadow" : ""));
}

bool is_opaque(const SPIRType& type) {
    return type.basetype == SPIRType::Image || type.basetype == SPIRType::SampledImage;
}

/// Reads what a module declares through spirv-cross.
class ModuleReader {
  public:
    ModuleReader(spirv_cross::Compiler& module, const spirv_cross::ParsedIR& parsed, Stage stage, SpirvModule& made)
        : module_(module), parsed_(parsed), stage_(stage), made_(made),
          active_(module.get_active_interface_variables()) {}

    void read() {
        check_kinds();
        parsed_.for_each_typed_id<spirv_cross::SPIRVariable>([&](std::uint32_t id, const spirv_cross::SPIRVariable& v) {
            if (v.storage == spv::StorageClassInput)
                add_varying(id, made_.inputs);
            else if (v.storage == spv::StorageClassOutput)
                add_varying(id, made_.outputs);
            else if (v.storage == spv::StorageClassUniformConstant && is_active(id))
                add_uniform(id, v.initializer != 0);
        });
        const spirv_cross::ShaderResources resources = module_.get_shader_resources(active_);
        for (const spirv_cross::Resource& one : resources.uniform_buffers)
            made_.uniform_blocks.push_back(block(one));
        for (const spirv_cross::Resource& one : resources.storage_buffers)
            made_.storage_blocks.push_back(block(one));
        for (const auto* const blocks : {&made_.uniform_blocks, &made_.storage_blocks})
            check_bindings(*blocks);
        locate_uniforms();
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("shader {}: {}", made_.file, what));
    }

    [[nodiscard]] bool is_active(std::uint32_t id) const { return active_.contains(spirv_cross::VariableID(id)); }

    /// What Vulkan has and GL has not.
    void check_kinds() const {
        const spirv_cross::ShaderResources all = module_.get_shader_resources();
        const std::array<std::pair<std::string_view, const spirv_cross::SmallVector<spirv_cross::Resource>*>, 4> kinds{{
            {"a push constant", &all.push_constant_buffers},
            {"an image without its sampler", &all.separate_images},
            {"a sampler without its image", &all.separate_samplers},
            {"a subpass input", &all.subpass_inputs},
        }};
        for (const auto& [kind, found] : kinds)
            if (!found->empty())
                fail(fmt::format("{} ({}) is Vulkan's, and GL has none; {}, `spirv-cross --version 450` translates it "
                                 "to GLSL",
                                 kind, found->front().name, remedy(stage_)));
        for (const auto& [builtin, name, right] :
             {std::tuple{spv::BuiltInVertexIndex, "gl_VertexIndex", "gl_VertexID"},
              std::tuple{spv::BuiltInInstanceIndex, "gl_InstanceIndex", "gl_InstanceID"}})
            if (module_.has_active_builtin(builtin, spv::StorageClassInput))
                fail(fmt::format("{} is Vulkan's, GL has {}; {}", name, right, remedy(stage_)));
    }

    [[nodiscard]] std::string named(std::string name, const char* what, std::uint32_t id) const {
        if (name.empty())
            fail(fmt::format("{} {} has no name; the names were stripped (OpName), and bindings go by them; {}", what,
                             id, remedy(stage_)));
        spirv_cross::ParsedIR::sanitize_underscores(name);
        spirv_cross::ParsedIR::sanitize_identifier(name, false, false);
        return name;
    }

    [[nodiscard]] std::string member_name(const SPIRType& type, std::uint32_t member) const {
        return named(module_.get_member_name(type.self, member), "a member of block", type.self);
    }

    [[nodiscard]] GLint decoration(std::uint32_t id, spv::Decoration which) const {
        return module_.has_decoration(spirv_cross::ID(id), which)
                   ? static_cast<GLint>(module_.get_decoration(spirv_cross::ID(id), which))
                   : -1;
    }

    /// 0: it has none until it runs.
    [[nodiscard]] GLint length(const SPIRType& array) const {
        const std::uint32_t size = array.array.back();
        return static_cast<GLint>(array.array_size_literal.back() ? size : module_.get_constant(size).scalar());
    }

    /// Of the built-in ones gl_Position, which can be captured.
    void add_built_in(std::uint32_t id, const SPIRType& type, std::vector<SpirvModule::Variable>& to) const {
        SpirvModule::Variable made{"gl_Position", GL_FLOAT_VEC4};
        made.id = module_.has_decoration(id, spv::DecorationBuiltIn) ? id : std::uint32_t{type.self};
        if (made.id == id && module_.get_decoration(id, spv::DecorationBuiltIn) == spv::BuiltInPosition)
            to.push_back(made);
        for (std::uint32_t m = 0; made.id != id && m < type.member_types.size(); ++m) {
            made.member = static_cast<int>(m);
            if (module_.get_member_decoration(type.self, m, spv::DecorationBuiltIn) == spv::BuiltInPosition)
                to.push_back(made);
        }
    }

    void add_varying(std::uint32_t id, std::vector<SpirvModule::Variable>& to) const {
        const SPIRType& type = module_.get_type_from_variable(id);
        const bool is_block = module_.has_decoration(type.self, spv::DecorationBlock);
        if (module_.has_decoration(id, spv::DecorationBuiltIn) ||
            (is_block && module_.has_member_decoration(type.self, 0, spv::DecorationBuiltIn))) {
            if (&to == &made_.outputs)
                add_built_in(id, type, to);
            return;
        }
        const bool each_vertex = stage_ == Stage::geometry && &to == &made_.inputs; // an array of the vertices
        if (!is_block) {
            SpirvModule::Variable made{named(module_.get_name(id), "a variable", id), numeric_type(type)};
            made.size = each_vertex || type.array.empty() ? 1 : length(type);
            made.location = decoration(id, spv::DecorationLocation);
            made.id = id;
            to.push_back(std::move(made));
            return;
        }
        GLint next = decoration(id, spv::DecorationLocation);
        for (std::uint32_t m = 0; m < type.member_types.size(); ++m) {
            const SPIRType& of = module_.get_type(type.member_types[m]);
            if (module_.has_member_decoration(type.self, m, spv::DecorationLocation))
                next = static_cast<GLint>(module_.get_member_decoration(type.self, m, spv::DecorationLocation));
            to.push_back({member_name(type, m), numeric_type(of), of.array.empty() ? 1 : length(of), next, false,
                          type.self, static_cast<int>(m)});
            next += static_cast<GLint>(of.columns) * to.back().size;
        }
    }

    void add_uniform(std::uint32_t id, bool is_initialised) {
        const SPIRType& type = module_.get_type_from_variable(id);
        const std::string name = named(module_.get_name(id), "a uniform", id);
        const GLenum kind = is_opaque(type) ? opaque_type(module_, type) : numeric_type(type);
        if (kind == 0)
            fail(fmt::format("uniform {} is a structure, or of a type that is not supported here in SPIR-V; right is "
                             "a member of a uniform block",
                             name));
        made_.uniforms.push_back({name, kind, type.array.empty() ? 1 : length(type),
                                  decoration(id, spv::DecorationLocation), is_initialised, id});
    }

    [[nodiscard]] InterfaceBlock block(const spirv_cross::Resource& resource) const {
        const SPIRType& type = module_.get_type(resource.base_type_id);
        InterfaceBlock made{named(module_.get_name(resource.base_type_id), "a block", resource.id)};
        made.binding = decoration(resource.id, spv::DecorationBinding);
        if (made.binding < 0)
            fail(fmt::format("block {} has no binding; right is layout(binding = ...), or glslangValidator's "
                             "--auto-map-bindings",
                             made.name));
        if (!module_.get_type_from_variable(resource.id).array.empty())
            fail(fmt::format("block {} is an array of blocks, which is not supported here", made.name));
        made.bytes = static_cast<GLint>(module_.get_declared_struct_size(type));
        add_members(type, "", 0, true, {}, made.members);
        return made;
    }

    /// Those of a structure; `like` has what holds for all within.
    void add_members(const SPIRType& type, const std::string& prefix, GLint offset, bool at_top, BlockMember like,
                     std::vector<BlockMember>& to) const {
        for (std::uint32_t m = 0; m < type.member_types.size(); ++m) {
            const auto has = [&](spv::Decoration which) { return module_.has_member_decoration(type.self, m, which); };
            const auto value = [&](spv::Decoration which) {
                return static_cast<GLint>(module_.get_member_decoration(type.self, m, which));
            };
            like.matrix_stride = has(spv::DecorationMatrixStride)
                                     ? static_cast<GLint>(module_.type_struct_member_matrix_stride(type, m))
                                     : 0;
            like.row_major = has(spv::DecorationRowMajor);
            add_member(type.member_types[m], prefix + member_name(type, m), offset + value(spv::DecorationOffset),
                       at_top, like, to);
        }
    }

    void add_member(std::uint32_t id, const std::string& name, GLint offset, bool at_top, BlockMember made,
                    std::vector<BlockMember>& to) const {
        const SPIRType& type = module_.get_type(id);
        made.name = name;
        made.offset = offset;
        if (type.array.empty() && type.basetype == SPIRType::Struct)
            return add_members(type, name + ".", offset, false, made, to);
        if (type.array.empty()) {
            made.type = numeric_type(type);
            to.push_back(std::move(made));
            return;
        }
        const GLint size = length(type), stride = static_cast<GLint>(parsed_.find_meta(id)->decoration.array_stride);
        const SPIRType& element = module_.get_type(type.parent_type);
        const bool is_plain = element.array.empty() && element.basetype != SPIRType::Struct;
        if (is_plain) {
            made.name += "[0]";
            made.type = numeric_type(element);
            made.size = size;
            made.array_stride = stride;
            to.push_back(std::move(made));
        } else if (at_top) {
            made.top_level_size = size;
            made.top_level_stride = stride;
            add_member(type.parent_type, name + "[0]", offset, false, made, to);
        } else {
            for (GLint i = 0; i < size; ++i)
                add_member(type.parent_type, fmt::format("{}[{}]", name, i), offset + i * stride, false, made, to);
        }
    }

    void check_bindings(const std::vector<InterfaceBlock>& blocks) const {
        for (std::size_t b = 0; b < blocks.size(); ++b)
            for (std::size_t other = 0; other < b; ++other)
                if (blocks[b].binding == blocks[other].binding)
                    fail(fmt::format("blocks {} and {} both have binding {}; right is one each", blocks[other].name,
                                     blocks[b].name, blocks[b].binding));
    }

    void locate_uniforms() {
        std::set<GLint> taken;
        for (const SpirvModule::Variable& one : made_.uniforms)
            for (GLint i = 0; one.location >= 0 && i < one.size; ++i)
                taken.insert(one.location + i);
        GLint next = taken.empty() ? 0 : *taken.rbegin() + 1;
        std::vector<std::uint32_t> added;
        for (SpirvModule::Variable& one : made_.uniforms)
            if (one.location < 0) {
                one.location = std::exchange(next, next + one.size);
                added.insert(added.end(), {4U << 16U | spv::OpDecorate, one.id, spv::DecorationLocation,
                                           static_cast<std::uint32_t>(one.location)});
            }
        decorate(added);
    }

    void decorate(const std::vector<std::uint32_t>& added);

    spirv_cross::Compiler& module_;
    const spirv_cross::ParsedIR& parsed_;
    Stage stage_;
    SpirvModule& made_;
    std::unordered_set<spirv_cross::VariableID> active_;
};

bool is_decoration(spv::Op op) {
    return op == spv::OpDecorate || op == spv::OpMemberDecorate || op == spv::OpDecorateId ||
           op == spv::OpDecorateString || op == spv::OpMemberDecorateString;
}

/// Decorations stand before the first type.
void insert_decorations(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> added) {
    std::size_t end = 0, at = spirv_header_words;
    for_each_instruction(words, [&](spv::Op op, std::span<const std::uint32_t> instruction) {
        at += instruction.size();
        if (is_decoration(op))
            end = at;
    });
    if (end > 0)
        words.insert(words.begin() + static_cast<std::ptrdiff_t>(end), added.begin(), added.end());
}

void ModuleReader::decorate(const std::vector<std::uint32_t>& added) { insert_decorations(made_.words, added); }

std::vector<std::uint32_t> module_words(std::string_view content) {
    std::vector<std::uint32_t> words(content.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), content.data(), words.size() * sizeof(std::uint32_t));
    if (!words.empty() && words.front() != spv::MagicNumber)
        for (std::uint32_t& word : words)
            word = word << 24U | (word << 8U & 0xff0000U) | (word >> 8U & 0xff00U) | word >> 24U;
    return words;
}

/// What a module of whole words declares. Nothing says that it is a right one.
SpirvModule declared_by(const std::string& file, std::string_view content, Stage stage) {
    const auto fail = [&](const std::string& what) { throw Error(fmt::format("shader {}: {}", file, what)); };
    SpirvModule made;
    made.file = file;
    made.words = module_words(content);
    if (const std::string fault = spirv_fault(made.words); !fault.empty())
        fail(fmt::format("is no SPIR-V module that can be read: {}", fault));
    try {
        spirv_cross::Parser parser(made.words);
        parser.parse();
        spirv_cross::Compiler module(parser.get_parsed_ir());
        std::string others;
        for (const spirv_cross::EntryPoint& entry : module.get_entry_points_and_stages())
            if (entry.execution_model == execution_model(stage) && made.entry_point.empty())
                made.entry_point = entry.name;
            else if (entry.execution_model == execution_model(stage))
                fail(fmt::format("has two entry points of this stage, {} and {}; right is one", made.entry_point,
                                 entry.name));
        if (made.entry_point.empty())
            fail(fmt::format("has no entry point of a {} stage; {}", stage_word(stage), remedy(stage)));
        module.set_entry_point(made.entry_point, execution_model(stage));
        module.update_active_builtins();
        ModuleReader(module, parser.get_parsed_ir(), stage, made).read();
    } catch (const spirv_cross::CompilerError& error) {
        fail(fmt::format("is no SPIR-V module that can be read: {}", error.what()));
    }
    std::uint32_t functions = 0; // the set that GLSL's have
    for_each_instruction(made.words, [&](spv::Op op, std::span<const std::uint32_t> words) {
        if (op == spv::OpExtInstImport && words.size() > 3 && words[2] == 0x4c534c47U && words[3] == 0x6474732eU)
            functions = words[1]; // "GLSL", ".std"
        const auto calls = [&](std::uint32_t function) {
            return op == spv::OpExtInst && words.size() > 4 && words[3] == functions && words[4] == function;
        };
        made.calls_normalize = made.calls_normalize || calls(GLSLstd450Normalize);
        made.calls_inverse_sqrt = made.calls_inverse_sqrt || calls(GLSLstd450InverseSqrt);
        made.asks_length = made.asks_length || op == spv::OpArrayLength;
        made.says_precise = made.says_precise || (op == spv::OpDecorate && words[2] == spv::DecorationNoContraction);
    });
    return made;
}

std::string translated(const SpirvModule& module, bool located) {
    try {
        spirv_cross::CompilerGLSL compiler(module.words);
        spirv_cross::CompilerGLSL::Options options = compiler.get_common_options();
        options.version = 450;
        options.enable_420pack_extension = false;
        compiler.set_common_options(options);
        if (!located)
            unset_locations(compiler, compiler.get_shader_resources());
        return compiler.compile();
    } catch (const spirv_cross::CompilerError& error) {
        throw Error(fmt::format("shader {}: cannot be translated to GLSL: {}", module.file, error.what()));
    }
}

} // namespace

const SpirvModule::Variable* SpirvModule::output(std::string_view name) const {
    const auto found = std::find_if(outputs.begin(), outputs.end(), [&](const Variable& o) { return o.name == name; });
    return found == outputs.end() ? nullptr : &*found;
}

std::vector<std::string> SpirvModule::names() const {
    std::set<std::string> all;
    for (const auto* const variables : {&inputs, &outputs, &uniforms})
        for (const Variable& one : *variables)
            all.insert(one.name);
    for (const auto* const blocks : {&uniform_blocks, &storage_blocks})
        for (const InterfaceBlock& block : *blocks) {
            all.insert(block.name);
            for (const BlockMember& member : block.members)
                for (std::size_t at = 0, end = 0; at < member.name.size(); at = end + 1) {
                    end = std::min(member.name.find('.', at), member.name.size());
                    all.insert(member.name.substr(at, std::min(member.name.find('[', at), end) - at));
                }
        }
    return {all.begin(), all.end()};
}

bool is_spirv(std::string_view content) {
    return content.starts_with(std::string_view("\x03\x02\x23\x07", 4)) ||
           content.starts_with(std::string_view("\x07\x23\x02\x03", 4));
}

SpirvModule read_spirv(const std::string& file, std::string_view content, Stage stage) {
    const auto fail = [&](const std::string& what) { throw Error(fmt::format("shader {}: {}", file, what)); };
    if (!is_spirv(content))
        fail(fmt::format("does not begin as a SPIR-V module does; {}", remedy(stage)));
    if (content.size() % sizeof(std::uint32_t) != 0)
        fail(fmt::format("{} bytes are no whole number of words; the file was cut short", content.size()));
    try {
        return module_of_bytes(
            in_child_if_possible(reader, [&] { return module_bytes(declared_by(file, content, stage)); }));
    } catch (const ChildFailed& failed) {
        throw Error(fmt::format("shader {}: is no SPIR-V module that can be read: {}", file, failed.what()));
    }
}

std::vector<std::uint32_t> capturing(const SpirvModule& module, std::span<const SpirvModule::Variable> outputs) {
    std::set<std::uint32_t> ids; // whose offsets are places in a captured buffer
    for (const SpirvModule::Variable& one : module.outputs)
        ids.insert(one.id);
    std::vector<std::uint32_t> words(module.words.begin(), module.words.begin() + spirv_header_words);
    const auto put = [&](std::initializer_list<std::uint32_t> all) { words.insert(words.end(), all); };
    if (!outputs.empty())
        put({2U << 16U | spv::OpCapability, spv::CapabilityTransformFeedback});
    std::uint32_t entry = 0;
    for_each_instruction(module.words, [&](spv::Op op, std::span<const std::uint32_t> instruction) {
        if (op == spv::OpEntryPoint)
            entry = instruction[2];
        else if (entry != 0 && !outputs.empty())
            put({3U << 16U | spv::OpExecutionMode, std::exchange(entry, 0), spv::ExecutionModeXfb});
        const std::size_t which = op == spv::OpMemberDecorate ? 3 : 2;
        if ((op == spv::OpDecorate || op == spv::OpMemberDecorate) && instruction.size() > which &&
            (instruction[which] == spv::DecorationXfbBuffer || instruction[which] == spv::DecorationXfbStride ||
             (instruction[which] == spv::DecorationOffset && ids.contains(instruction[1]))))
            return;
        words.insert(words.end(), instruction.begin(), instruction.end());
    });
    std::uint32_t stride = 0;
    for (const SpirvModule::Variable& one : outputs)
        stride += static_cast<std::uint32_t>(output_components(one.type) * one.size) * 4;
    std::vector<std::uint32_t> added;
    std::uint32_t offset = 0;
    for (const SpirvModule::Variable& one : outputs) {
        for (const auto& [decoration, value] : {std::pair{spv::DecorationXfbBuffer, 0U},
                                                {spv::DecorationXfbStride, stride},
                                                {spv::DecorationOffset, offset}}) {
            if (one.member < 0)
                added.insert(added.end(), {4U << 16U | spv::OpDecorate, one.id, decoration, value});
            else
                added.insert(added.end(), {5U << 16U | spv::OpMemberDecorate, one.id,
                                           static_cast<std::uint32_t>(one.member), decoration, value});
        }
        offset += static_cast<std::uint32_t>(output_components(one.type) * one.size) * 4;
    }
    insert_decorations(words, added);
    return words;
}

std::string glsl_of(const SpirvModule& module, bool located) try {
    return in_child_if_possible(reader, [&] { return translated(module, located); });
} catch (const ChildFailed& failed) {
    throw Error(fmt::format("shader {}: cannot be translated to GLSL: {}", module.file, failed.what()));
}

} // namespace lockstep
