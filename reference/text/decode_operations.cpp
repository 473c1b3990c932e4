#include <algorithm>
#include <bit>

#include <GLSL.std.450.h>
#include <fmt/format.h>

#include "reference/text/decoder.hpp"

namespace lockstep::text {

std::pair<std::uint32_t, std::uint32_t> Decoder::part(std::uint32_t type_id, Words indices) const {
    std::uint32_t offset = 0;
    for (const std::uint32_t i : indices) {
        const Type& t = type(type_id);
        if (t.kind == Type::Kind::structure) {
            for (std::uint32_t m = 0; m < i; ++m)
                offset += type(t.members[m].type).cells;
            type_id = t.members[i].type;
        } else {
            offset += i * type(t.element).cells;
            type_id = t.element;
        }
    }
    return {offset, type_id};
}

/// Values put together and taken apart (SPIR-V 3.42.12).
void Decoder::composite(const Instruction& at) {
    const Words w = at.words;
    switch (at.op) {
    case spv::OpCompositeConstruct: {
        std::uint32_t to = cell(w[1]);
        for (const std::uint32_t part : w.subspan(2)) {
            const std::uint32_t n = module_.type_of(part).cells;
            copy(to, cell(part), n);
            to += n;
        }
        break;
    }
    case spv::OpCompositeExtract:
        cell_[w[1]] = cell(w[2]) + part(module_.ids[w[2]].type, w.subspan(3)).first;
        break;
    case spv::OpCopyObject:
        cell_[w[1]] = cell(w[2]);
        break;
    case spv::OpCompositeInsert: {
        const std::uint32_t to = cell(w[1]);
        copy(to, cell(w[3]), type(w[0]).cells);
        copy(to + part(w[0], w.subspan(4)).first, cell(w[2]), module_.type_of(w[2]).cells);
        break;
    }
    case spv::OpVectorShuffle: {
        const std::uint32_t first = module_.type_of(w[2]).cells, a = cell(w[2]), b = cell(w[3]);
        const auto from = [&](std::uint32_t c) { return c == none ? a : c < first ? a + c : b + (c - first); };
        const Words order = w.subspan(4);
        bool in_order = true;
        for (std::size_t i = 1; i < order.size(); ++i)
            in_order = in_order && from(order[i]) == from(order[0]) + i;
        if (in_order) {
            cell_[w[1]] = from(order[0]);
            break;
        }
        const std::uint32_t to = cell(w[1]);
        for (std::uint32_t i = 0; i < order.size(); ++i)
            copy(to + i, from(order[i]), 1);
        break;
    }
    default:
        break;
    }
}

/// Arithmetic, comparisons and conversions (SPIR-V 3.42.11 to 3.42.15). Returns false for what is none of them.
bool Decoder::operation(const Instruction& at) {
    const Words w = at.words;
    const auto op = static_cast<std::uint16_t>(at.op);
    const auto cells_of = [&](std::size_t i) { return module_.type_of(w[i]).cells; };
    switch (at.op) {
    case spv::OpCompositeConstruct:
    case spv::OpCompositeExtract:
    case spv::OpCopyObject:
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
        composite(at);
        return true;
    case spv::OpVectorExtractDynamic:
    case spv::OpVectorInsertDynamic: {
        const std::uint32_t a = cell(w[2]), b = cell(w[3]), c = at.op == spv::OpVectorInsertDynamic ? cell(w[4]) : 0;
        Step& step = made(op, w);
        step.a = a;
        step.b = b;
        step.c = c;
        step.d = cells_of(2);
        return true;
    }
    case spv::OpTranspose: {
        const std::uint32_t a = cell(w[2]);
        Step& step = made(op, w);
        step.a = a;
        step.c = module_.type_of(w[2]).count; // columns
        step.d = type(module_.type_of(w[2]).element).count;
        return true;
    }
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix: {
        const std::uint32_t a = cell(w[2]), b = cell(w[3]);
        const Type& matrix = module_.type_of(at.op == spv::OpVectorTimesMatrix ? w[3] : w[2]);
        Step& step = made(op, w);
        step.a = a;
        step.b = b;
        step.c = matrix.count; // columns
        step.d = type(matrix.element).count;
        return true;
    }
    case spv::OpOuterProduct: { // its columns: the first vector times each component of the second
        const std::uint32_t to = cell(w[1]), column = cell(w[2]), row = cell(w[3]), rows = cells_of(2);
        for (std::uint32_t k = 0; k < cells_of(3); ++k) {
            Step& step = add(spv::OpVectorTimesScalar);
            step.out = to + k * rows;
            step.n = static_cast<std::uint16_t>(rows);
            step.a = column;
            step.b = row + k;
            p_.precise.back() = module_.ids[w[1]].is_precise ? 1 : 0;
        }
        return true;
    }
    case spv::OpBitcast: {
        const bool from_real = is_real(module_.ids[w[2]].type), to_real = is_real(w[0]);
        if (from_real == to_real) {
            cell_[w[1]] = cell(w[2]);
            return true;
        }
        const std::uint32_t a = cell(w[2]);
        made(from_real ? code::real_bits : code::bits_as_real, w).a = a;
        return true;
    }
    case spv::OpExtInst:
        extended(w);
        return true;
    case spv::OpControlBarrier: {
        if (const Constant* scope = module_.constant(w[0]);
            scope == nullptr || scope->words.front() != spv::ScopeWorkgroup)
            refuse("a barrier of another scope than a group is not interpreted");
        const Constant* semantics = module_.constant(w[2]);
        add(code::barrier).a = semantics != nullptr ? semantics->words.front() : 0;
        ++p_.barriers;
        return true;
    }
    case spv::OpMemoryBarrier: {
        const Constant* semantics = module_.constant(w[1]);
        add(code::fence).a = semantics != nullptr ? semantics->words.front() : 0;
        return true;
    }
    default:
        break;
    }
    if (at.op >= spv::OpAtomicLoad && at.op <= spv::OpAtomicXor) {
        atomic(at);
        return true;
    }
    // Operands that are values, one after the other.
    const bool is_known = (op >= spv::OpConvertFToU && op <= spv::OpConvertUToF) ||
                          (op >= spv::OpSNegate && op <= spv::OpSMulExtended && at.op != spv::OpOuterProduct) ||
                          at.op == spv::OpAny || at.op == spv::OpAll || at.op == spv::OpIsNan ||
                          at.op == spv::OpIsInf || (op >= spv::OpLogicalEqual && op <= spv::OpFUnordGreaterThanEqual) ||
                          (op >= spv::OpShiftRightLogical && op <= spv::OpBitCount);
    if (!is_known)
        return false;
    std::array<std::uint32_t, 4> values{};
    for (std::size_t i = 2; i < w.size() && i < 6; ++i)
        values[i - 2] = cell(w[i]);
    Step& step = made(op, w);
    step.a = values[0];
    step.b = values[1];
    step.c = values[2];
    step.d = values[3];
    if (at.op == spv::OpDot || at.op == spv::OpAny || at.op == spv::OpAll)
        step.d = cells_of(2);
    if (at.op == spv::OpSelect)
        step.d = cells_of(2) > 1 ? 1 : 0; // a condition a component
    return true;
}

void Decoder::atomic(const Instruction& at) {
    const Words w = at.words;
    const bool has_result = at.op != spv::OpAtomicStore, exchanges = at.op == spv::OpAtomicCompareExchange;
    const std::uint32_t pointer = has_result ? w[2] : w[0];
    const auto found = address_.find(pointer);
    if (found == address_.end() || found->second.space == Address::Space::variable)
        refuse("an atomic operation on what is no buffer, image or shared variable is not interpreted");
    const Address of = found->second;
    if (at.op == spv::OpAtomicFlagTestAndSet || at.op == spv::OpAtomicCompareExchangeWeak)
        refuse(fmt::format("SPIR-V instruction {} is not interpreted", static_cast<unsigned>(at.op)));
    const std::size_t value = exchanges ? 6 : has_result ? 5 : 3;
    const std::uint32_t operand = value < w.size() ? cell(w[value]) : 0, comparator = exchanges ? cell(w[7]) : 0;
    const std::uint32_t place = of.space == Address::Space::texel ? of.dynamic : offset_cell(of);
    const bool is_used = has_result && uses_[w[1]] > 1; // one is where it is made
    const std::uint32_t out = is_used ? cell(w[1]) : no_cell;
    Step& step = add(of.space == Address::Space::shared  ? code::atomic_shared
                     : of.space == Address::Space::block ? code::atomic_block
                                                         : code::atomic_texel);
    step.out = out;
    step.n = static_cast<std::uint16_t>(at.op);
    step.a = of.place;
    step.b = place;
    step.c = operand;
    step.d = comparator;
}

void Decoder::extended(Words w) {
    if (w[2] != module_.extension)
        refuse("an instruction of another set than GLSL.std.450 is not interpreted");
    static constexpr std::array refused{GLSLstd450Frexp, GLSLstd450PackDouble2x32, GLSLstd450UnpackDouble2x32};
    if (w[3] >= GLSLstd450InterpolateAtCentroid && w[3] <= GLSLstd450InterpolateAtOffset)
        return interpolate(w);
    if (w[3] >= GLSLstd450NMin ||
        std::find(refused.begin(), refused.end(), static_cast<GLSLstd450>(w[3])) != refused.end())
        refuse(fmt::format("GLSL.std.450 instruction {} is not interpreted", w[3]));
    if (w[3] == GLSLstd450Modf || w[3] == GLSLstd450ModfStruct)
        return parts_of_number(w);
    std::array<std::uint32_t, 3> values{};
    for (std::size_t i = 4; i < w.size() && i < 7; ++i)
        values[i - 4] = cell(w[i]);
    // fma(a, b, -0.0) is a product that nothing fuses.
    if (const Constant* added = w[3] == GLSLstd450Fma ? module_.constant(w[6]) : nullptr;
        added != nullptr && std::all_of(added->words.begin(), added->words.end(), [](std::uint32_t word) {
            return word == std::bit_cast<std::uint32_t>(-0.0F);
        })) {
        Step& product = made(static_cast<std::uint16_t>(spv::OpFMul), w);
        product.a = values[0];
        product.b = values[1];
        return;
    }
    Step& step = made(static_cast<std::uint16_t>(code::extended + w[3]), w);
    step.a = values[0];
    step.b = values[1];
    step.c = values[2];
    step.d = module_.type_of(w[4]).cells;
}

/// The input as it is given: of an examined run it is the same in all of the fragment.
void Decoder::interpolate(Words w) {
    leave_to_driver("an input between the places of a fragment");
    const auto found = address_.find(w[4]);
    if (found == address_.end() || found->second.space != Address::Space::variable)
        refuse("interpolation of what is no input is not interpreted");
    const Address from = found->second;
    note_read(from);
    load_from(from, cell(w[1]), from.type);
}

/// modf: the whole part, cut towards 0, and what is left.
void Decoder::parts_of_number(Words w) {
    const std::uint32_t n = module_.type_of(w[4]).cells, x = cell(w[4]), rest = cell(w[1]);
    const bool is_structure = w[3] == GLSLstd450ModfStruct;
    const std::uint32_t whole = is_structure ? rest + n : take_cells(n);
    Step& cut = add(static_cast<std::uint16_t>(code::extended + GLSLstd450Trunc));
    cut.out = whole;
    cut.a = x;
    cut.d = n;
    cut.n = static_cast<std::uint16_t>(n);
    Step& left = add(static_cast<std::uint16_t>(spv::OpFSub));
    left.out = rest;
    left.a = x;
    left.b = whole;
    left.n = static_cast<std::uint16_t>(n);
    if (!is_structure) {
        const Address to = address_.at(w[5]);
        store_to(to, whole, to.type);
    }
}

} // namespace lockstep::text
