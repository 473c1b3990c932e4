#pragma once
#include <algorithm>

#include "reference/text/machine_apart.hpp"

/// What a traced Machine notes of a step: its operands before it runs, since a step may write where it reads, and its
/// results behind it.
namespace lockstep::text {

namespace tracing {

inline bool is_comparison(std::uint16_t op) {
    return (op >= spv::OpIEqual && op <= spv::OpFUnordGreaterThanEqual) || op == spv::OpIsNan || op == spv::OpIsInf;
}

inline bool takes_reals(std::uint16_t op) {
    return (op >= spv::OpFOrdEqual && op <= spv::OpFUnordGreaterThanEqual) || op == spv::OpIsNan || op == spv::OpIsInf;
}

/// Whether a word is a float of a usual size, or an integer beyond 2^29.
inline bool looks_real(std::uint32_t bits) {
    const std::uint32_t exponent = bits >> 23U & 0xffU;
    return exponent > 0x40 && exponent < 0xc0;
}

/// Whether the result is a float.
inline bool makes_real(std::uint16_t op) {
    if (op >= code::extended) {
        const int function = op - code::extended;
        const bool is_whole = function == GLSLstd450SAbs || function == GLSLstd450SSign || function == GLSLstd450UMin ||
                              function == GLSLstd450SMin || function == GLSLstd450UMax || function == GLSLstd450SMax ||
                              function == GLSLstd450UClamp || function == GLSLstd450SClamp ||
                              (function >= GLSLstd450PackSnorm4x8 && function <= GLSLstd450PackHalf2x16) ||
                              (function >= GLSLstd450FindILsb && function <= GLSLstd450FindUMsb);
        return !is_whole;
    }
    switch (op) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpDot:
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
        return true;
    default:
        return false;
    }
}

} // namespace tracing

template <class R, int W> void Machine<R, W>::note_operands(const Step& s) {
    static_assert(W == 1);
    using Kind = TraceRow::Kind;
    Trace& noted = *noted_;
    const auto step = static_cast<std::uint32_t>(&s - p_.steps.data());
    noted_step_ = step;
    if (s.op == code::call) {
        noted.calls.push_back({step, calls_});
        calls_ = static_cast<std::uint32_t>(noted.calls.size());
        return;
    }
    if (s.op == code::finish && calls_ != 0) {
        calls_ = noted.calls[calls_ - 1].outer;
        return;
    }
    const auto operand = [&](std::uint32_t number) {
        noted.operands.push_back(
            {made_by_[number] == 0 ? TraceOperand::no_row : made_by_[number] - 1, cell(number)->word()});
    };
    const auto assign = [&](std::uint32_t number) {
        if (number < p_.output_cells)
            assigned_[number] = {step, calls_, true};
    };
    /// A row whose operands have been noted from `first` on.
    const auto note = [&](Kind kind, std::size_t first, std::uint32_t cell, bool is_real,
                          const WrittenPlace& place = {}) {
        pending_.push_back({{kind, is_real, s.op, step, p_.lines[step], 0, static_cast<std::uint32_t>(first),
                             static_cast<std::uint32_t>(noted.operands.size() - first), place, calls_},
                            cell,
                            kind != Kind::store});
        assign(cell);
    };
    const auto copied = [&](std::uint32_t out, std::uint32_t from) {
        moves_.emplace_back(out, made_by_[from]);
        assign(out);
    };
    const auto texel_word = [&](std::uint32_t image, std::uint32_t first, std::uint32_t axes, std::uint32_t c) {
        return first_word(memory_.image(image), texel_place(first, axes, 0)) + c;
    };
    using Space = WrittenPlace::Space;
    switch (s.op) {
    case code::finish: // the outputs as they are; each where it was made, or assigned
        for (const StageVariable& output : p_.stage_outputs)
            for (std::uint32_t c = output.cell; c < output.cell + output.cells; ++c) {
                const Assigned assigned = assigned_[c];
                if (!assigned.is_set)
                    continue;
                const std::size_t first = noted.operands.size();
                operand(c);
                note(Kind::store, first, c, output.is_real, {Space::output, 0, c});
                TraceRow& row = pending_.back().row;
                row.step = assigned.step, row.line = p_.lines[assigned.step], row.calls = assigned.calls;
                if (made_by_[c] == 0)
                    continue;
                const TraceRow& maker = noted.rows[made_by_[c] - 1];
                row.step = maker.step, row.line = maker.line, row.calls = maker.calls;
            }
        return;
    case code::copy:
    case code::real_bits:
    case code::bits_as_real:
        for (std::uint32_t c = 0; c < s.n; ++c)
            copied(s.out + c, s.a + c);
        return;
    case code::load_variable:
        for (std::uint32_t c = 0; c < s.n; ++c)
            copied(s.out + c, s.a + cell(s.b)->word() + c);
        return;
    case code::store_variable:
        for (std::uint32_t c = 0; c < s.n; ++c)
            copied(s.a + cell(s.b)->word() + c, s.c + c);
        return;
    case code::address: {
        const std::size_t first = noted.operands.size();
        for (std::uint32_t k = 0; k < s.n; ++k)
            operand(p_.operands[s.d + 3 * k]);
        return note(Kind::operation, first, s.out, false);
    }
    case code::load_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const std::size_t first = noted.operands.size();
            const Leaf leaf = p_.leaves[s.d + c];
            operand(s.b);
            note(Kind::load, first, s.out + c, leaf.is_real, {Space::block, s.a, cell(s.b)->word() + leaf.word});
        }
        return;
    case code::store_block:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const std::size_t first = noted.operands.size();
            const Leaf leaf = p_.leaves[s.d + c];
            operand(s.c + c);
            operand(s.b);
            note(Kind::store, first, s.c + c, leaf.is_real, {Space::block, s.a, cell(s.b)->word() + leaf.word});
        }
        return;
    case code::load_shared:
    case code::store_shared:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const bool is_load = s.op == code::load_shared;
            const std::size_t first = noted.operands.size();
            if (!is_load)
                operand(s.c + c);
            operand(s.b);
            note(is_load ? Kind::load : Kind::store, first, is_load ? s.out + c : s.c + c, false,
                 {Space::shared, 0, cell(s.b)->word() + c});
        }
        return;
    case code::atomic_shared:
    case code::atomic_block:
    case code::atomic_texel: {
        const WrittenPlace at = atomic_place(s);
        const bool has_value =
            s.n != spv::OpAtomicLoad && s.n != spv::OpAtomicIIncrement && s.n != spv::OpAtomicIDecrement;
        const auto operands_of_place = [&] {
            const std::uint32_t axes = s.op == code::atomic_texel ? p_.images[cell(s.a)->word()].shape.axes() : 1;
            for (std::uint32_t axis = 0; axis < axes; ++axis)
                operand(s.b + axis);
        };
        if (s.n != spv::OpAtomicLoad) {
            const std::size_t first = noted.operands.size();
            if (has_value)
                operand(s.c);
            operands_of_place();
            note(Kind::store, first, has_value ? s.c : s.b, false, at);
        }
        if (s.out == no_cell)
            return;
        const std::size_t first = noted.operands.size();
        operands_of_place();
        return note(Kind::load, first, s.out, false, at);
    }
    case code::load_texel:
    case code::fetch_texel:
    case code::sample_texel:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const std::size_t first = noted.operands.size();
            const std::uint32_t image = cell(s.a)->word();
            for (std::uint32_t axis = 0; axis < s.c; ++axis)
                operand(s.b + axis);
            // What is between texels is known by its place's bits alone.
            const std::uint64_t word = s.op == code::sample_texel
                                           ? std::uint64_t{cell(s.b)->word()} << 32U | cell(s.b + s.c - 1)->word()
                                           : texel_word(image, s.b, s.c, c);
            note(Kind::load, first, s.out + c, p_.images[image].is_real, {Space::texel, image, word});
        }
        return;
    case code::store_texel: {
        const std::uint32_t image = cell(s.a)->word();
        for (std::uint32_t c = 0; c < s.n && c < memory_.image(image).components; ++c) {
            const std::size_t first = noted.operands.size();
            operand(s.c + c);
            for (std::uint32_t axis = 0; axis < s.d; ++axis)
                operand(s.b + axis);
            note(Kind::store, first, s.c + c, p_.images[image].is_real,
                 {Space::texel, image, texel_word(image, s.b, s.d, c)});
        }
        return;
    }
    case code::array_length:
    case code::image_size:
    case code::query_levels:
        for (std::uint32_t c = 0; c < s.n; ++c)
            moves_.emplace_back(s.out + c, 0U);
        return;
    case spv::OpSelect:
        for (std::uint32_t c = 0; c < s.n; ++c)
            copied(s.out + c, (cell(s.d != 0 ? s.a + c : s.a)->word() != 0 ? s.b : s.c) + c);
        return;
    case spv::OpVectorExtractDynamic: {
        const std::uint32_t index = cell(s.b)->word();
        return copied(s.out, s.a + (index < s.d ? index : 0));
    }
    case spv::OpVectorInsertDynamic:
        for (std::uint32_t c = 0; c < s.n; ++c)
            copied(s.out + c, cell(s.c)->word() == c ? s.b : s.a + c);
        return;
    case spv::OpTranspose:
        for (std::uint32_t column = 0; column < s.c; ++column)
            for (std::uint32_t row = 0; row < s.d; ++row)
                copied(s.out + row * s.c + column, s.a + column * s.d + row);
        return;
    default:
        break;
    }
    if (s.op >= code::own)
        return;
    const StepOperands operands = operands_of(s);
    for (std::uint32_t c = 0; c < s.n; ++c) {
        const std::size_t first = noted.operands.size();
        if (operands.by_component)
            for (std::size_t k = 0; k < operands.count; ++k)
                operand(operands.cell(k, c));
        else
            for (std::size_t k = 0; k < operands.count; ++k)
                for (std::uint32_t part = 0; part < operands.ranges[k].second; ++part)
                    operand(operands.ranges[k].first + part);
        const bool compares = tracing::is_comparison(s.op);
        note(compares ? Kind::comparison : Kind::operation, first, s.out + c,
             compares ? tracing::takes_reals(s.op) : tracing::makes_real(s.op));
    }
}

template <class R, int W> void Machine<R, W>::note_results() {
    const auto note_setting = [&](std::uint32_t number) {
        if (!noted_->notes_settings || number >= p_.variables)
            return;
        noted_->settings.push_back(
            {static_cast<std::uint32_t>(noted_->rows.size()), noted_step_, number, cell(number)->word()});
    };
    for (const auto& [out, row] : moves_) {
        made_by_[out] = row;
        note_setting(out);
    }
    moves_.clear();
    for (PendingRow& pending : pending_) {
        const auto row = static_cast<std::uint32_t>(noted_->rows.size());
        if (pending.is_result)
            for (const ForcedRow& one : forced_)
                if (one.turned ? row >= one.row && pending.row.step == *one.turned : one.row == row)
                    cell(pending.cell)->set(one.turned ? cell(pending.cell)->word() ^ 1U : one.bits);
        pending.row.bits = cell(pending.cell)->word();
        if (pending.row.place.space == WrittenPlace::Space::shared) // which has no type here
            pending.row.is_real = pending.row.is_real || tracing::looks_real(pending.row.bits);
        noted_->rows.push_back(pending.row);
        if (pending.is_result) {
            made_by_[pending.cell] = row + 1;
            note_setting(pending.cell);
        }
    }
    pending_.clear();
}

} // namespace lockstep::text
