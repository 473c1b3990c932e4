#include <algorithm>

#include <fmt/format.h>

#include "reference/text/decoder.hpp"

namespace lockstep::text {
namespace {

/// Operations of which component c needs no other component of its operands.
bool is_by_component(std::uint16_t op) {
    if (op >= code::own)
        return op == code::copy || op == code::real_bits || op == code::bits_as_real;
    return (op >= spv::OpConvertFToU && op <= spv::OpConvertUToF) || (op >= spv::OpSNegate && op <= spv::OpFMod) ||
           (op >= spv::OpShiftRightLogical && op <= spv::OpNot) || op == spv::OpLogicalNot;
}

} // namespace

bool Decoder::lasts(std::uint32_t id, std::size_t number, std::uint32_t first, std::uint32_t count) {
    const std::vector<Instruction>& body = function_->body;
    const auto overlaps = [&](std::uint32_t pointer) {
        for (std::size_t i = number + 1; !address_.contains(pointer) && i < body.size(); ++i)
            if ((body[i].op == spv::OpAccessChain || body[i].op == spv::OpInBoundsAccessChain) &&
                body[i].words[1] == pointer) {
                pointer = body[i].words[2];
                i = number;
            }
        const auto at = address_.find(pointer);
        if (at == address_.end() || at->second.dynamic != none)
            return true;
        const Address& to = at->second;
        return to.space == Address::Space::variable && to.place + to.offset < first + count &&
               first < to.place + to.offset + type(to.type).cells;
    };
    if (last_use_[id] >= body.size())
        return false;
    for (std::size_t i = number + 1; i < last_use_[id]; ++i) {
        const Instruction& at = body[i];
        if (at.op == spv::OpLabel || at.op == spv::OpFunctionCall || at.op == spv::OpCopyMemory ||
            (at.op == spv::OpStore && overlaps(at.words[0])))
            return false;
    }
    return true;
}

/// Pointers, loads and stores (SPIR-V 3.42.8). Returns false for other instructions.
bool Decoder::memory(const Instruction& at, std::size_t number) {
    const Words w = at.words;
    switch (at.op) {
    case spv::OpAccessChain:
    case spv::OpInBoundsAccessChain:
        access(w);
        return true;
    case spv::OpLoad:
        load(w, number);
        return true;
    case spv::OpStore:
        store(w);
        return true;
    case spv::OpCopyMemory: {
        const Address to = address_.at(w[0]), from = address_.at(w[1]);
        const std::uint32_t between = take_cells(type(from.type).cells);
        note_read(from);
        load_from(from, between, from.type);
        store_to(to, between, to.type);
        return true;
    }
    case spv::OpArrayLength: {
        const Address of = address_.at(w[2]);
        made(code::array_length, w).a = of.place;
        return true;
    }
    case spv::OpImageTexelPointer: {
        const Address image = address_.at(w[2]);
        std::uint32_t held = image.place + image.offset;
        if (image.dynamic != none) {
            held = take_cells(1);
            load_from(image, held, image.type);
        }
        const ImageShape& shape = type(image.type).shape;
        const std::uint32_t place =
            shape.has_samples ? place_of_sample(cell(w[3]), shape.axes(), cell(w[4])) : cell(w[3]);
        address_[w[1]] = {.space = Address::Space::texel, .place = held, .dynamic = place, .type = type(w[0]).element};
        return true;
    }
    default:
        return false;
    }
}

Decoder::Address Decoder::member(Address of, std::uint32_t number) const {
    const Type& t = type(of.type);
    const bool in_words = of.space == Address::Space::block;
    switch (t.kind) {
    case Type::Kind::structure:
        if (number >= t.members.size())
            refuse(fmt::format("member {} of {}, which has {}", number, t.name, t.members.size()));
        if (in_words)
            of.offset += t.members[number].offset / word_bytes;
        else
            for (std::uint32_t m = 0; m < number; ++m)
                of.offset += type(t.members[m].type).cells;
        of.matrix = {t.members[number].matrix_stride, t.members[number].is_row_major};
        of.type = t.members[number].type;
        return of;
    case Type::Kind::array:
        of.offset += number * (in_words ? t.stride / word_bytes : type(t.element).cells);
        break;
    case Type::Kind::matrix:
        of.offset += number * (!in_words                ? type(t.element).cells
                               : of.matrix.is_row_major ? 1
                                                        : of.matrix.stride / word_bytes);
        of.is_column = in_words && of.matrix.is_row_major;
        break;
    default:
        of.offset += number * (of.is_column ? of.matrix.stride / word_bytes : 1);
        of.is_column = false;
    }
    of.type = t.element;
    return of;
}

void Decoder::access(Words w) {
    const auto base = address_.find(w[2]);
    if (base == address_.end())
        refuse("a pointer made at run time is not interpreted");
    Address at = base->second;
    std::vector<std::uint32_t> terms; // of the offset: cell, stride, count
    if (at.dynamic != none)
        terms = {at.dynamic, 1, 0};
    for (const std::uint32_t index : w.subspan(3)) {
        const Constant* constant = module_.constant(index);
        const Type& t = type(at.type);
        if (at.is_blocks) {
            if (constant == nullptr || constant->words.front() >= t.count)
                refuse("a block of an array of blocks by an index that is no constant is not interpreted");
            at.place += constant->words.front();
            at.type = t.element;
            at.is_blocks = false;
            continue;
        }
        const bool is_inside = constant != nullptr &&
                               (t.kind == Type::Kind::structure || t.count == 0 || constant->words.front() < t.count);
        if (is_inside) {
            at = member(at, constant->words.front());
            continue;
        }
        const std::uint32_t first = at.offset;
        const Address second = member(at, 1); // tells the stride
        terms.insert(terms.end(), {cell(index), second.offset - first, t.count});
        at = member(at, 0);
    }
    if (terms.empty()) {
        at.dynamic = none;
        address_[w[1]] = at;
        return;
    }
    const std::uint32_t out = take_cells(1);
    Step& step = add(code::address);
    step.out = out;
    step.n = static_cast<std::uint16_t>(terms.size() / 3);
    step.c = 0;
    step.d = static_cast<std::uint32_t>(p_.operands.size());
    p_.operands.insert(p_.operands.end(), terms.begin(), terms.end());
    at.dynamic = out;
    address_[w[1]] = at;
}

std::uint32_t Decoder::offset_cell(const Address& of) {
    if (of.dynamic == none)
        return word_cell(of.offset);
    if (of.offset == 0)
        return of.dynamic;
    const std::uint32_t out = take_cells(1);
    Step& step = add(code::address);
    step.out = out;
    step.n = 1;
    step.c = of.offset;
    step.d = static_cast<std::uint32_t>(p_.operands.size());
    p_.operands.insert(p_.operands.end(), {of.dynamic, 1, 0});
    return out;
}

std::uint32_t Decoder::leaves_of(const Address& of, std::uint32_t type_id) {
    const auto first = static_cast<std::uint32_t>(p_.leaves.size());
    if (of.is_column)
        for (std::uint32_t c = 0; c < type(type_id).count; ++c)
            p_.leaves.push_back({c * of.matrix.stride / word_bytes, true});
    else
        lay(module_, type_id, 0, of.matrix, p_.leaves);
    if (of.space == Address::Space::shared) // cell after cell
        for (std::uint32_t c = 0; first + c < p_.leaves.size(); ++c)
            p_.leaves[first + c].word = c;
    return first;
}

void Decoder::load_from(const Address& from, std::uint32_t out, std::uint32_t type_id) {
    const auto n = static_cast<std::uint16_t>(type(type_id).cells);
    if (from.space == Address::Space::texel)
        refuse("a texel's pointer is loaded; expected an atomic operation on it");
    const bool is_fixed = from.space == Address::Space::variable && from.dynamic == none;
    const std::uint32_t offset = is_fixed ? 0 : offset_cell(from);
    const std::uint32_t leaves = from.space != Address::Space::variable ? leaves_of(from, type_id) : 0;
    Step& step = add(is_fixed                                 ? code::copy
                     : from.space == Address::Space::variable ? code::load_variable
                     : from.space == Address::Space::shared   ? code::load_shared
                                                              : code::load_block);
    step.out = out;
    step.n = n;
    step.a = is_fixed ? from.place + from.offset : from.place;
    step.b = offset;
    step.d = leaves;
}

void Decoder::store_to(const Address& to, std::uint32_t from, std::uint32_t type_id) {
    const auto n = static_cast<std::uint16_t>(type(type_id).cells);
    const bool is_fixed = to.space == Address::Space::variable && to.dynamic == none;
    const std::uint32_t offset = is_fixed ? 0 : offset_cell(to);
    const std::uint32_t leaves = to.space != Address::Space::variable ? leaves_of(to, type_id) : 0;
    Step& step = add(is_fixed                               ? code::copy
                     : to.space == Address::Space::variable ? code::store_variable
                     : to.space == Address::Space::shared   ? code::store_shared
                                                            : code::store_block);
    step.n = n;
    step.c = from;
    step.a = to.place;
    step.b = offset;
    step.d = leaves;
    if (is_fixed) {
        step.out = to.place + to.offset;
        step.a = from;
        step.c = 0;
    }
}

void Decoder::load(Words w, std::size_t number) {
    const auto at = address_.find(w[2]);
    if (at == address_.end())
        refuse("a pointer made at run time is not interpreted");
    const Address from = at->second;
    const Type::Kind kind = type(w[0]).kind;
    const bool is_fixed = from.space == Address::Space::variable && from.dynamic == none;
    note_read(from);
    const bool is_image = kind == Type::Kind::image || kind == Type::Kind::sampled_image || kind == Type::Kind::sampler;
    if (is_fixed && (is_image || lasts(w[1], number, from.place + from.offset, type(w[0]).cells))) {
        cell_[w[1]] = from.place + from.offset;
        return;
    }
    const std::uint32_t out = cell(w[1]);
    load_from(from, out, w[0]);
    maker_ = w[1];
}

/// Whether the step that made the value can write it to the variable itself: this store is the value's only use.
bool Decoder::takes_store(const Address& to, std::uint32_t id) {
    if (maker_ != id || uses_[id] != 2 || to.space != Address::Space::variable || to.dynamic != none)
        return false;
    const Step& step = p_.steps.back();
    const std::uint32_t first = to.place + to.offset;
    if (!is_by_component(step.op) || step.out != cell_[id])
        return false;
    const auto is_safe = [&](std::uint32_t operand) {
        return operand == first || operand + step.n <= first || first + step.n <= operand;
    };
    return is_safe(step.a) && is_safe(step.b);
}

void Decoder::store(Words w) {
    const auto at = address_.find(w[0]);
    if (at == address_.end())
        refuse("a pointer made at run time is not interpreted");
    const Address to = at->second;
    if (to.space == Address::Space::texel)
        refuse("a texel's pointer is stored to; expected an atomic operation on it");
    if (takes_store(to, w[1])) {
        p_.steps.back().out = to.place + to.offset;
        maker_ = none;
        return;
    }
    store_to(to, cell(w[1]), module_.ids[w[1]].type);
}

} // namespace lockstep::text
