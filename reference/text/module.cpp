#include "reference/text/module.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/text/constant_result.hpp"

namespace lockstep::text {
namespace {

constexpr std::size_t header_words = 5;
using Words = std::span<const std::uint32_t>;

std::string string_at(Words words) {
    std::string text;
    for (const std::uint32_t word : words)
        for (int shift = 0; shift < 32; shift += 8) {
            const char c = static_cast<char>(word >> shift & 0xffU);
            if (c == 0)
                return text;
            text += c;
        }
    return text;
}

} // namespace

class ModuleReader {
  public:
    explicit ModuleReader(Module& made) : made_(made) {}

    void read() {
        const std::vector<std::uint32_t>& words = made_.words;
        if (words.size() < header_words || words[0] != spv::MagicNumber)
            throw Error("no SPIR-V module: it does not begin with SPIR-V's magic number");
        constexpr std::uint32_t most_ids = 1U << 22U;
        if (words[3] > most_ids)
            throw Error(fmt::format("SPIR-V module of {} ids; at most {} are read", words[3], most_ids));
        made_.types.resize(words[3]);
        made_.ids.resize(words[3]);
        made_.constant_of_.resize(words[3]);
        // Names and decorations come before what they are about.
        for (std::size_t at = header_words; at < words.size();) {
            const std::uint32_t count = words[at] >> 16U;
            if (count == 0 || at + count > words.size())
                throw Error(fmt::format("SPIR-V module ends within the instruction at word {}", at));
            instruction(static_cast<spv::Op>(words[at] & 0xffffU), Words(words).subspan(at + 1, count - 1));
            at += count;
        }
        if (made_.entry == 0)
            throw Error("SPIR-V module without an entry point");
    }

  private:
    std::uint32_t checked_id(std::uint32_t id) const {
        if (id >= made_.ids.size())
            throw Error(fmt::format("SPIR-V id {} is beyond the module's bound {}", id, made_.ids.size()));
        return id;
    }
    Type::Member& member(std::uint32_t type, std::uint32_t number) {
        constexpr std::uint32_t most = 1U << 14U;
        if (number > most)
            throw Error(fmt::format("SPIR-V structure {} of more than {} members", type, most));
        std::vector<Type::Member>& members = made_.types[checked_id(type)].members;
        members.resize(std::max<std::size_t>(members.size(), number + 1));
        return members[number];
    }
    [[noreturn]] void refuse(std::string_view what) const { made_.refuse(line_, what); }

    void instruction(spv::Op op, Words w) {
        if (op == spv::OpLine)
            line_ = w[1], has_line_ = true;
        if (op == spv::OpLabel)
            has_line_ = false;
        if (op == spv::OpFunction) {
            Function& f = made_.functions.emplace_back();
            f.id = checked_id(w[1]);
            f.result = w[0];
            inside_ = true;
        } else if (op == spv::OpFunctionEnd) {
            inside_ = false;
        } else if (op == spv::OpFunctionParameter) {
            made_.ids[checked_id(w[1])].type = w[0];
            made_.functions.back().parameters.push_back(w[1]);
        } else if (op == spv::OpUndef) {
            constant(w[0], w[1], std::vector<std::uint32_t>(made_.types[w[0]].cells)).is_undefined = true;
        } else if (inside_) {
            bool has_result = false, has_type = false;
            spv::HasResultAndType(op, &has_result, &has_type);
            if (has_result && has_type)
                made_.ids[checked_id(w[1])].type = checked_id(w[0]);
            made_.functions.back().body.push_back({op, line_, has_result && has_type ? w[1] : 0, has_line_, w});
        } else {
            annotate(op, w);
            declare(op, w);
        }
    }

    void annotate(spv::Op op, Words w) {
        switch (op) {
        case spv::OpExtInstImport:
            if (string_at(w.subspan(1)) == "GLSL.std.450")
                made_.extension = w[0];
            break;
        case spv::OpEntryPoint:
            made_.stage = static_cast<spv::ExecutionModel>(w[0]);
            made_.entry = checked_id(w[1]);
            break;
        case spv::OpExecutionMode:
            if (w[1] == spv::ExecutionModeLocalSize)
                made_.group = {w[2], w[3], w[4]};
            else if (w[1] == spv::ExecutionModeOutputVertices)
                made_.most_vertices = w[2];
            else if (w[1] == spv::ExecutionModeDerivativeGroupQuadsNV)
                made_.are_quads = made_.are_square_quads = true;
            else if (w[1] == spv::ExecutionModeDerivativeGroupLinearNV)
                made_.are_quads = true;
            break;
        case spv::OpName:
            made_.ids[checked_id(w[0])].name = string_at(w.subspan(1));
            break;
        case spv::OpMemberName:
            member(w[0], w[1]).name = string_at(w.subspan(2));
            break;
        case spv::OpDecorate:
            decorate(made_.ids[checked_id(w[0])], w);
            break;
        case spv::OpMemberDecorate: {
            Type::Member& of = member(w[0], w[1]);
            if (w[2] == spv::DecorationOffset)
                of.offset = w[3];
            else if (w[2] == spv::DecorationMatrixStride)
                of.matrix_stride = w[3];
            else if (w[2] == spv::DecorationRowMajor)
                of.is_row_major = true;
            else if (w[2] == spv::DecorationBuiltIn)
                of.builtin = static_cast<spv::BuiltIn>(w[3]);
            else if (w[2] == spv::DecorationLocation)
                of.location = w[3];
            else if (w[2] == spv::DecorationFlat)
                of.is_flat = true;
            else if (w[2] == spv::DecorationCoherent || w[2] == spv::DecorationVolatile)
                of.is_coherent = true;
            break;
        }
        default:
            break;
        }
    }
    void decorate(IdInfo& id, Words w) {
        switch (w[1]) {
        case spv::DecorationNoContraction:
            id.is_precise = true;
            break;
        case spv::DecorationBuiltIn:
            id.builtin = static_cast<spv::BuiltIn>(w[2]);
            break;
        case spv::DecorationLocation:
            id.location = w[2];
            break;
        case spv::DecorationFlat:
            id.is_flat = true;
            break;
        case spv::DecorationBlock:
            id.is_block = true;
            break;
        case spv::DecorationBufferBlock:
            id.is_buffer_block = true;
            break;
        case spv::DecorationBinding:
            id.binding = w[2];
            break;
        case spv::DecorationDescriptorSet:
            id.set = w[2];
            break;
        case spv::DecorationCoherent:
        case spv::DecorationVolatile: // it is coherent, too (GLSL 4.60, 4.10)
            id.is_coherent = true;
            break;
        case spv::DecorationArrayStride:
            made_.types[w[0]].stride = w[2];
            break;
        default:
            break;
        }
    }

    Type& make(Words w, Type::Kind kind, std::uint32_t element = 0, std::uint32_t count = 1) {
        Type& type = made_.types[checked_id(w[0])];
        type.kind = kind;
        type.element = element;
        type.count = count;
        type.name = made_.ids[w[0]].name;
        set_cells(type, std::uint64_t{element == 0 ? 1 : made_.types[checked_id(element)].cells} * count);
        return type;
    }
    void set_cells(Type& type, std::uint64_t cells) const {
        constexpr std::uint64_t most = 1U << 20U;
        if (cells > most)
            refuse(fmt::format("a value of {} numbers; at most {} are interpreted", cells, most));
        type.cells = static_cast<std::uint32_t>(cells);
    }

    void declare(spv::Op op, Words w) {
        using enum Type::Kind;
        switch (op) {
        case spv::OpTypeVoid:
            make(w, nothing).cells = 0;
            break;
        case spv::OpTypeFunction:
            make(w, function).cells = 0;
            break;
        case spv::OpTypeBool:
            make(w, boolean);
            break;
        case spv::OpTypeInt:
            if (w[1] != 32)
                refuse(fmt::format("integers of {} bits are not interpreted; expected 32", w[1]));
            make(w, integer).is_signed = w[2] != 0;
            break;
        case spv::OpTypeFloat:
            if (w[1] != 32)
                refuse(fmt::format("floats of {} bits are not interpreted; expected 32", w[1]));
            make(w, real);
            break;
        case spv::OpTypeVector:
            make(w, vector, w[1], w[2]);
            break;
        case spv::OpTypeMatrix:
            make(w, matrix, w[1], w[2]);
            break;
        case spv::OpTypeArray:
            make(w, array, w[1], known(w[2]));
            break;
        case spv::OpTypeRuntimeArray:
            make(w, array, w[1], 0);
            break;
        case spv::OpTypeStruct:
            structure_of(w);
            break;
        case spv::OpTypePointer: {
            Type& type = make(w, pointer, w[2]);
            type.storage = static_cast<spv::StorageClass>(w[1]);
            type.cells = 1;
            break;
        }
        case spv::OpTypeImage: {
            Type& type = make(w, image, w[1]);
            type.shape = {static_cast<spv::Dim>(w[2]), w[4] != 0, w[5] != 0, static_cast<spv::ImageFormat>(w[7])};
            type.is_storage = w[6] == 2;
            type.cells = 1;
            break;
        }
        case spv::OpTypeSampledImage: {
            const Type of = made_.types[checked_id(w[1])];
            Type& type = make(w, sampled_image, of.element);
            type.shape = of.shape;
            type.cells = 1;
            break;
        }
        case spv::OpTypeSampler:
            make(w, sampler);
            break;
        case spv::OpConstantTrue:
        case spv::OpSpecConstantTrue:
            constant(w[0], w[1], {1});
            break;
        case spv::OpConstantFalse:
        case spv::OpSpecConstantFalse:
            constant(w[0], w[1], {0});
            break;
        case spv::OpConstant:
        case spv::OpSpecConstant:
            constant(w[0], w[1], {w[2]});
            break;
        case spv::OpConstantNull:
            constant(w[0], w[1], std::vector<std::uint32_t>(made_.types[w[0]].cells));
            break;
        case spv::OpConstantComposite:
        case spv::OpSpecConstantComposite: {
            std::vector<std::uint32_t> parts;
            for (const std::uint32_t part : w.subspan(2)) {
                const Constant* of = made_.constant(checked_id(part));
                if (of == nullptr)
                    throw Error(fmt::format("SPIR-V constant {} is made of {}, which is none", w[1], part));
                parts.insert(parts.end(), of->words.begin(), of->words.end());
            }
            constant(w[0], w[1], std::move(parts));
            break;
        }
        case spv::OpSpecConstantOp:
            folded(w);
            break;
        case spv::OpVariable:
            if (w[2] == spv::StorageClassAtomicCounter)
                pack(made_.types[w[0]].element);
            made_.ids[checked_id(w[1])].type = w[0];
            made_.variables.push_back({w[1], made_.types[w[0]].element, static_cast<spv::StorageClass>(w[2]),
                                       w.size() > 3 ? checked_id(w[3]) : 0});
            break;
        default:
            break;
        }
    }

    /// Arrays of atomic counters, to which modules give no stride, have none between theirs.
    void pack(std::uint32_t id) {
        Type& type = made_.types[id];
        if (type.kind == Type::Kind::array && type.stride == 0) {
            pack(type.element);
            type.stride = made_.types[type.element].cells * sizeof(std::uint32_t);
        }
    }

    void structure_of(Words w) {
        const Words members = w.subspan(1);
        for (std::uint32_t m = 0; m < members.size(); ++m)
            member(w[0], m).type = checked_id(members[m]);
        std::uint64_t cells = 0;
        for (const std::uint32_t m : members)
            cells += made_.types[m].cells;
        set_cells(make(w, Type::Kind::structure), cells);
    }

    Constant& constant(std::uint32_t type, std::uint32_t id, std::vector<std::uint32_t> words) {
        made_.ids[checked_id(id)].type = type;
        made_.constants.push_back({id, type, std::move(words)});
        made_.constant_of_[id] = static_cast<std::uint32_t>(made_.constants.size());
        return made_.constants.back();
    }
    /// An expression of specialisation constants, whose values are those of the text.
    void folded(Words w) {
        const auto op = static_cast<spv::Op>(w[2]);
        const bool takes_part = op == spv::OpCompositeExtract;
        std::vector<std::vector<std::uint32_t>> operands;
        for (const std::uint32_t id : takes_part ? w.subspan(3, 1) : w.subspan(3)) {
            const Constant* of = made_.constant(checked_id(id));
            if (of == nullptr)
                refuse(fmt::format("SPIR-V instruction {} of what is no constant is not interpreted", w[2]));
            operands.push_back(of->words);
        }
        if (takes_part && w.size() == 5 && w[4] < operands[0].size()) {
            constant(w[0], w[1], {operands[0][w[4]]});
            return;
        }
        std::optional<std::vector<std::uint32_t>> words = constant_result(op, made_.types[w[0]].cells, operands);
        if (!words)
            refuse(fmt::format("SPIR-V instruction {} of specialisation constants is not interpreted", w[2]));
        constant(w[0], w[1], std::move(*words));
    }
    [[nodiscard]] std::uint32_t known(std::uint32_t id) const {
        const Constant* found = made_.constant(checked_id(id));
        if (found == nullptr || found->words.empty())
            refuse("an array whose length is no constant is not interpreted");
        return found->words.front();
    }

    Module& made_;
    std::uint32_t line_ = 0;
    bool has_line_ = false; ///< Instruction::has_line
    bool inside_ = false;
};

const Type& Module::scalar_of(std::uint32_t type) const {
    while (types[type].kind == Type::Kind::vector || types[type].kind == Type::Kind::matrix ||
           types[type].kind == Type::Kind::array)
        type = types[type].element;
    return types[type];
}

const Constant* Module::constant(std::uint32_t id) const {
    return id < constant_of_.size() && constant_of_[id] != 0 ? &constants[constant_of_[id] - 1] : nullptr;
}

void Module::refuse(std::uint32_t line, std::string_view what) const {
    throw Error(fmt::format("shader {}: {}", line_name(line), what));
}

Module read_module(std::vector<std::uint32_t> words, LineName line_name) {
    Module made;
    made.words = std::move(words);
    made.line_name = std::move(line_name);
    ModuleReader(made).read();
    return made;
}

} // namespace lockstep::text
