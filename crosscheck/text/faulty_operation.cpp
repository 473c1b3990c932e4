#include "crosscheck/text/faulty_operation.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <GLSL.std.450.h>
#include <fmt/format.h>

#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// An operation in GLSL. `a`, `b` and `c` are its operands; letters of `types` their types, the last the result's: f,
/// i, u, b as a component, F as a vector of floats whose size the operation's operands say.
struct Form {
    std::string_view text, types;
};

struct KnownForm {
    int op;
    Form form;
};

constexpr std::array of_spirv{
    KnownForm{spv::OpFNegate, {"-a", "ff"}},
    KnownForm{spv::OpFAdd, {"a + b", "fff"}},
    KnownForm{spv::OpFSub, {"a - b", "fff"}},
    KnownForm{spv::OpFMul, {"a * b", "fff"}},
    KnownForm{spv::OpFDiv, {"a / b", "fff"}},
    KnownForm{spv::OpFMod, {"mod(a, b)", "fff"}},
    KnownForm{spv::OpVectorTimesScalar, {"a * b", "fff"}},
    KnownForm{spv::OpMatrixTimesScalar, {"a * b", "fff"}},
    KnownForm{spv::OpDot, {"dot(a, b)", "FFf"}},
    KnownForm{spv::OpSNegate, {"-a", "ii"}},
    KnownForm{spv::OpIAdd, {"a + b", "uuu"}},
    KnownForm{spv::OpISub, {"a - b", "uuu"}},
    KnownForm{spv::OpIMul, {"a * b", "uuu"}},
    KnownForm{spv::OpSDiv, {"a / b", "iii"}},
    KnownForm{spv::OpUDiv, {"a / b", "uuu"}},
    KnownForm{spv::OpSMod, {"a % b", "iii"}},
    KnownForm{spv::OpUMod, {"a % b", "uuu"}},
    KnownForm{spv::OpShiftLeftLogical, {"a << b", "uuu"}},
    KnownForm{spv::OpShiftRightLogical, {"a >> b", "uuu"}},
    KnownForm{spv::OpShiftRightArithmetic, {"a >> b", "iui"}},
    KnownForm{spv::OpBitwiseAnd, {"a & b", "uuu"}},
    KnownForm{spv::OpBitwiseOr, {"a | b", "uuu"}},
    KnownForm{spv::OpBitwiseXor, {"a ^ b", "uuu"}},
    KnownForm{spv::OpNot, {"~a", "uu"}},
    KnownForm{spv::OpBitCount, {"bitCount(a)", "ui"}},
    KnownForm{spv::OpBitReverse, {"bitfieldReverse(a)", "uu"}},
    KnownForm{spv::OpConvertFToS, {"int(a)", "fi"}},
    KnownForm{spv::OpConvertFToU, {"uint(a)", "fu"}},
    KnownForm{spv::OpConvertSToF, {"float(a)", "if"}},
    KnownForm{spv::OpConvertUToF, {"float(a)", "uf"}},
    KnownForm{spv::OpIEqual, {"a == b", "uub"}},
    KnownForm{spv::OpINotEqual, {"a != b", "uub"}},
    KnownForm{spv::OpULessThan, {"a < b", "uub"}},
    KnownForm{spv::OpULessThanEqual, {"a <= b", "uub"}},
    KnownForm{spv::OpUGreaterThan, {"a > b", "uub"}},
    KnownForm{spv::OpUGreaterThanEqual, {"a >= b", "uub"}},
    KnownForm{spv::OpSLessThan, {"a < b", "iib"}},
    KnownForm{spv::OpSLessThanEqual, {"a <= b", "iib"}},
    KnownForm{spv::OpSGreaterThan, {"a > b", "iib"}},
    KnownForm{spv::OpSGreaterThanEqual, {"a >= b", "iib"}},
    KnownForm{spv::OpFOrdEqual, {"a == b", "ffb"}},
    KnownForm{spv::OpFUnordNotEqual, {"a != b", "ffb"}},
    KnownForm{spv::OpFOrdLessThan, {"a < b", "ffb"}},
    KnownForm{spv::OpFOrdLessThanEqual, {"a <= b", "ffb"}},
    KnownForm{spv::OpFOrdGreaterThan, {"a > b", "ffb"}},
    KnownForm{spv::OpFOrdGreaterThanEqual, {"a >= b", "ffb"}},
    KnownForm{spv::OpIsNan, {"isnan(a)", "fb"}},
    KnownForm{spv::OpIsInf, {"isinf(a)", "fb"}},
};

constexpr std::array of_glsl{
    KnownForm{GLSLstd450Round, {"round(a)", "ff"}},
    KnownForm{GLSLstd450RoundEven, {"roundEven(a)", "ff"}},
    KnownForm{GLSLstd450Trunc, {"trunc(a)", "ff"}},
    KnownForm{GLSLstd450FAbs, {"abs(a)", "ff"}},
    KnownForm{GLSLstd450SAbs, {"abs(a)", "ii"}},
    KnownForm{GLSLstd450FSign, {"sign(a)", "ff"}},
    KnownForm{GLSLstd450SSign, {"sign(a)", "ii"}},
    KnownForm{GLSLstd450Floor, {"floor(a)", "ff"}},
    KnownForm{GLSLstd450Ceil, {"ceil(a)", "ff"}},
    KnownForm{GLSLstd450Fract, {"fract(a)", "ff"}},
    KnownForm{GLSLstd450Radians, {"radians(a)", "ff"}},
    KnownForm{GLSLstd450Degrees, {"degrees(a)", "ff"}},
    KnownForm{GLSLstd450Sin, {"sin(a)", "ff"}},
    KnownForm{GLSLstd450Cos, {"cos(a)", "ff"}},
    KnownForm{GLSLstd450Tan, {"tan(a)", "ff"}},
    KnownForm{GLSLstd450Asin, {"asin(a)", "ff"}},
    KnownForm{GLSLstd450Acos, {"acos(a)", "ff"}},
    KnownForm{GLSLstd450Atan, {"atan(a)", "ff"}},
    KnownForm{GLSLstd450Atan2, {"atan(a, b)", "fff"}},
    KnownForm{GLSLstd450Sinh, {"sinh(a)", "ff"}},
    KnownForm{GLSLstd450Cosh, {"cosh(a)", "ff"}},
    KnownForm{GLSLstd450Tanh, {"tanh(a)", "ff"}},
    KnownForm{GLSLstd450Pow, {"pow(a, b)", "fff"}},
    KnownForm{GLSLstd450Exp, {"exp(a)", "ff"}},
    KnownForm{GLSLstd450Log, {"log(a)", "ff"}},
    KnownForm{GLSLstd450Exp2, {"exp2(a)", "ff"}},
    KnownForm{GLSLstd450Log2, {"log2(a)", "ff"}},
    KnownForm{GLSLstd450Sqrt, {"sqrt(a)", "ff"}},
    KnownForm{GLSLstd450InverseSqrt, {"inversesqrt(a)", "ff"}},
    KnownForm{GLSLstd450FMin, {"min(a, b)", "fff"}},
    KnownForm{GLSLstd450UMin, {"min(a, b)", "uuu"}},
    KnownForm{GLSLstd450SMin, {"min(a, b)", "iii"}},
    KnownForm{GLSLstd450FMax, {"max(a, b)", "fff"}},
    KnownForm{GLSLstd450UMax, {"max(a, b)", "uuu"}},
    KnownForm{GLSLstd450SMax, {"max(a, b)", "iii"}},
    KnownForm{GLSLstd450FClamp, {"clamp(a, b, c)", "ffff"}},
    KnownForm{GLSLstd450UClamp, {"clamp(a, b, c)", "uuuu"}},
    KnownForm{GLSLstd450SClamp, {"clamp(a, b, c)", "iiii"}},
    KnownForm{GLSLstd450FMix, {"mix(a, b, c)", "ffff"}},
    KnownForm{GLSLstd450Step, {"step(a, b)", "fff"}},
    KnownForm{GLSLstd450SmoothStep, {"smoothstep(a, b, c)", "ffff"}},
    KnownForm{GLSLstd450Fma, {"fma(a, b, c)", "ffff"}},
    KnownForm{GLSLstd450Length, {"length(a)", "Ff"}},
    KnownForm{GLSLstd450Distance, {"distance(a, b)", "FFf"}},
    KnownForm{GLSLstd450Cross, {"cross(a, b)", "FFF"}},
    KnownForm{GLSLstd450Normalize, {"normalize(a)", "FF"}},
    KnownForm{GLSLstd450Reflect, {"reflect(a, b)", "FFF"}},
    KnownForm{GLSLstd450PackHalf2x16, {"packHalf2x16(a)", "Fu"}},
    KnownForm{GLSLstd450PackUnorm4x8, {"packUnorm4x8(a)", "Fu"}},
    KnownForm{GLSLstd450UnpackHalf2x16, {"unpackHalf2x16(a)", "uF"}},
    KnownForm{GLSLstd450UnpackUnorm4x8, {"unpackUnorm4x8(a)", "uF"}},
};

const Form* form_of(std::uint16_t op) {
    const auto find = [](const auto& all, int number) -> const Form* {
        const auto found = std::ranges::find(all, number, &KnownForm::op);
        return found == all.end() ? nullptr : &found->form;
    };
    return op >= text::code::own        ? nullptr
           : op >= text::code::extended ? find(of_glsl, op - text::code::extended)
                                        : find(of_spirv, op);
}

/// One kind of operation, with the operands that it was come by with.
struct Kind {
    const Form* form = nullptr;
    std::uint32_t words = 0;   ///< of all operands
    std::uint32_t results = 1; ///< components
    bool is_precise = false;
    std::uint32_t step = 0; ///< the first of it
    std::set<std::vector<std::uint32_t>> operands = {};

    [[nodiscard]] std::string_view of_operands() const { return form->types.substr(0, form->types.size() - 1); }
    [[nodiscard]] char of_result() const { return form->types.back(); }
    /// Components of an operand.
    [[nodiscard]] std::uint32_t size_of(char type) const {
        if (type != 'F')
            return 1;
        const auto vectors = static_cast<std::uint32_t>(std::ranges::count(of_operands(), 'F'));
        return vectors == 0 ? 1 : (words - (static_cast<std::uint32_t>(of_operands().size()) - vectors)) / vectors;
    }
};

std::string type_name(char type, std::uint32_t size) {
    if (type == 'F' && size > 1)
        return fmt::format("vec{}", size);
    return type == 'f' || type == 'F' ? "float" : type == 'i' ? "int" : type == 'u' ? "uint" : "bool";
}

constexpr int with_compute_stages = 430; ///< the first GLSL that has them

/// A compute stage that makes the operation and nothing else, of the words of a block.
std::string repro_of(const Kind& kind) {
    std::string text = fmt::format(
        "#version {}\nlayout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Operands {{ uint x[]; }};\n",
        with_compute_stages);
    text += fmt::format("layout(std430, binding = 1) buffer Results {{ {} y[]; }};\n\nvoid main() {{\n",
                        kind.of_result() == 'f' || kind.of_result() == 'F' ? "float" : "uint");
    text += fmt::format("    const uint at = gl_GlobalInvocationID.x;\n");
    std::uint32_t word = 0;
    char letter = 'a';
    for (const char type : kind.of_operands()) {
        const std::uint32_t size = kind.size_of(type);
        std::string value;
        for (std::uint32_t c = 0; c < size; ++c, ++word) {
            const std::string read = fmt::format("x[at * {} + {}]", kind.words, word);
            value += (c == 0 ? "" : ", ") + (type == 'f' || type == 'F' ? fmt::format("uintBitsToFloat({})", read)
                                             : type == 'i'              ? fmt::format("int({})", read)
                                                                        : read);
        }
        const std::string name = type_name(type, size);
        text += fmt::format("    {} {} = {};\n", name, letter++, size > 1 ? fmt::format("{}({})", name, value) : value);
    }
    text += fmt::format("    {}{} made = {};\n", kind.is_precise && kind.of_result() != 'b' ? "precise " : "",
                        type_name(kind.of_result(), kind.results), kind.form->text);
    for (std::uint32_t c = 0; c < kind.results; ++c) {
        const std::string part = kind.results > 1 ? fmt::format("made.{}", "xyzw"[c]) : "made";
        text += fmt::format("    y[at * {} + {}] = {};\n", kind.results, c,
                            kind.of_result() == 'b'                              ? part + " ? 1u : 0u"
                            : kind.of_result() == 'f' || kind.of_result() == 'F' ? part
                                                                                 : fmt::format("uint({})", part));
    }
    return text + "}\n";
}

/// Kinds of operations in the order of the traces' runs.
std::vector<Kind> kinds_of(const text::Program& program, std::span<const text::Trace> traces) {
    constexpr std::size_t most_operands = 64;
    using Key = std::tuple<const Form*, std::uint32_t, std::uint32_t, bool>;
    std::map<Key, std::size_t> known;
    std::vector<Kind> kinds;
    for (const text::Trace& trace : traces)
        for (std::size_t k = 0; k < trace.rows.size(); ++k) {
            const text::TraceRow& row = trace.rows[k];
            const Form* form =
                row.kind == text::TraceRow::Kind::operation || row.kind == text::TraceRow::Kind::comparison
                    ? form_of(row.op)
                    : nullptr;
            if (form == nullptr || row.count == 0)
                continue;
            const text::Step& step = program.steps[row.step];
            const std::uint32_t results = form->types.back() == 'F' ? step.n : 1;
            const Key key{form, row.count, results, program.precise[row.step] != 0};
            const auto [found, is_new] = known.try_emplace(key, kinds.size());
            if (is_new)
                kinds.push_back({form, row.count, results, std::get<3>(key), row.step});
            std::vector<std::uint32_t> words;
            for (const text::TraceOperand& operand : trace.of(row))
                words.push_back(operand.bits);
            Kind& kind = kinds[found->second];
            if (kind.operands.size() < most_operands)
                kind.operands.insert(std::move(words));
        }
    return kinds;
}

std::optional<std::string> fault_of(const MeasuredGl& gl, const Kind& kind, const std::string& repro) {
    auto source = std::make_shared<ShaderSource>();
    source->stage = Stage::compute;
    source->text = repro;
    source->files = {"alone.comp"};
    for (int line = 1; line <= std::ranges::count(repro, '\n'); ++line)
        source->origins.push_back({0, line});
    const StageText stage = stage_text(std::move(source), "alone.comp");
    MadeUpWorld world;
    std::vector<std::uint32_t> operands;
    for (const std::vector<std::uint32_t>& one : kind.operands)
        operands.insert(operands.end(), one.begin(), one.end());
    const std::size_t runs = kind.operands.size();
    for (const text::Block& block : stage.program.blocks)
        world.words.push_back(block.name == "Operands" ? operands
                                                       : std::vector<std::uint32_t>(runs * kind.results, 0U));
    for (std::vector<std::uint32_t>& words : world.words)
        world.bindings.blocks.emplace_back(words);
    const GpuComparison compared =
        compare_with_gpu(gl, stage, {static_cast<std::uint32_t>(runs), 1, 1}, world, text::Findings());
    if (!compared.first_wrong || !compared.first_wrong->invocation)
        return {};
    const std::uint32_t run = *compared.first_wrong->invocation;
    const std::string_view types = kind.of_operands();
    std::string numbers;
    std::uint32_t word = run * kind.words;
    for (const char type : types)
        for (std::uint32_t c = 0; c < kind.size_of(type); ++c)
            numbers += (numbers.empty() ? "" : ", ") + text::value_text(operands[word++], type == 'f' || type == 'F');
    const bool is_real = kind.of_result() == 'f' || kind.of_result() == 'F';
    return fmt::format("{} of {}: {}", kind.form->text, numbers,
                       both_values(*compared.first_wrong, is_real, "the driver made"));
}

} // namespace

std::optional<FaultyOperation> faulty_operation(const MeasuredGl& gl, const text::Program& program,
                                                std::span<const text::Trace> traces) {
    for (const Kind& kind : kinds_of(program, traces)) {
        const std::string repro = repro_of(kind);
        try {
            if (const std::optional<std::string> fault = fault_of(gl, kind, repro))
                return FaultyOperation{program.line_name(shown_line(program, kind.step).line), *fault, repro};
        } catch (const Error&) { // of an operation that this context does not run alone, nothing is said
        }
    }
    return {};
}

} // namespace lockstep
