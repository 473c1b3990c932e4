#include <algorithm>

#include <fmt/format.h>

#include "reference/text/decoder.hpp"

namespace lockstep::text {

void Decoder::jump_to(std::uint32_t step, std::uint32_t Step::*field, std::uint32_t label) {
    patches_.push_back({step, label, field});
}

/// Blocks, branches and ends of functions (SPIR-V 3.42.17). Returns false for other instructions.
bool Decoder::flow(const Instruction& at) {
    const Words w = at.words;
    // Which block lanes come from matters where one begins with OpPhi.
    const auto leave = [&](std::initializer_list<std::uint32_t> labels) {
        if (std::any_of(labels.begin(), labels.end(), [&](std::uint32_t label) { return has_phi_[label]; }))
            add(code::leave_block).a = block_;
    };
    const auto here = [&] { return static_cast<std::uint32_t>(p_.steps.size()) - 1; };
    switch (at.op) {
    case spv::OpLabel:
        block_ = w[0];
        step_of_[w[0]] = static_cast<std::uint32_t>(p_.steps.size());
        maker_ = none;
        return true;
    case spv::OpBranch:
        leave({w[0]});
        add(code::jump);
        jump_to(here(), &Step::a, w[0]);
        return true;
    case spv::OpBranchConditional: {
        leave({w[1], w[2]});
        add(code::branch).a = cell(w[0]);
        jump_to(here(), &Step::b, w[1]);
        jump_to(here(), &Step::c, w[2]);
        return true;
    }
    case spv::OpSwitch: {
        for (std::size_t i = 1; i < w.size(); i += i == 1 ? 1 : 2)
            if (has_phi_[w[i == 1 ? 1 : i]]) {
                add(code::leave_block).a = block_;
                break;
            }
        Step& step = add(code::choose);
        step.a = cell(w[0]);
        step.n = static_cast<std::uint16_t>((w.size() - 2) / 2);
        step.d = static_cast<std::uint32_t>(p_.operands.size());
        jump_to(here(), &Step::b, w[1]);
        for (std::size_t i = 2; i + 1 < w.size(); i += 2) {
            p_.operands.push_back(w[i]);
            patches_.push_back({static_cast<std::uint32_t>(p_.operands.size()), w[i + 1], nullptr});
            p_.operands.push_back(0);
        }
        return true;
    }
    case spv::OpPhi: {
        const std::vector<std::uint32_t> pairs = [&] {
            std::vector<std::uint32_t> all;
            for (std::size_t i = 2; i + 1 < w.size(); i += 2) {
                all.push_back(w[i + 1]);
                all.push_back(cell(w[i]));
            }
            return all;
        }();
        Step& step = made(code::from_block, w);
        step.a = static_cast<std::uint32_t>(pairs.size() / 2);
        step.d = static_cast<std::uint32_t>(p_.operands.size());
        p_.operands.insert(p_.operands.end(), pairs.begin(), pairs.end());
        for (std::size_t k = p_.steps.size() - 1; k-- > step_of_[block_];) // those before it have one more behind
            ++p_.steps[k].b;
        maker_ = none;
        return true;
    }
    case spv::OpReturn:
        add(code::finish);
        return true;
    case spv::OpUnreachable:
        add(code::finish);
        return true;
    case spv::OpReturnValue: {
        const std::uint32_t n = module_.type_of(w[0]).cells;
        Step& step = add(code::copy);
        step.out = callees_.at(function_->id).result;
        step.a = cell(w[0]);
        step.n = static_cast<std::uint16_t>(n);
        add(code::finish);
        return true;
    }
    default:
        return false;
    }
}

void Decoder::call(Words w, std::size_t number) {
    const auto found = callees_.find(w[2]);
    if (found == callees_.end())
        refuse(fmt::format("function {} has no body", module_.ids[w[2]].name));
    const Callee& callee = found->second;
    const auto copy = [&](std::uint32_t to, std::uint32_t from, std::uint32_t n) {
        Step& step = add(code::copy);
        step.out = to;
        step.a = from;
        step.n = static_cast<std::uint16_t>(n);
    };
    const Words arguments = w.subspan(3);
    const auto pointed = [&](std::size_t i) -> const Address* {
        const auto at = address_.find(arguments[i]);
        return at == address_.end() ? nullptr : &at->second;
    };
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const Address* address = pointed(i);
        if (address != nullptr && (address->space != Address::Space::variable || address->dynamic != none))
            refuse(fmt::format("an argument of {} is a pointer, which is not interpreted", module_.ids[w[2]].name));
        for (std::size_t k = 0; address != nullptr && k < i; ++k)
            if (arguments[k] == arguments[i] && std::count(callee.written.begin(), callee.written.end(), i) > 0)
                refuse(fmt::format("two arguments of {} are one variable", module_.ids[w[2]].name));
        if (address != nullptr)
            copy(callee.parameters[i], address->place + address->offset, type(address->type).cells);
        else
            copy(callee.parameters[i], cell(arguments[i]), module_.type_of(arguments[i]).cells);
    }
    add(code::call);
    jump_to(static_cast<std::uint32_t>(p_.steps.size()) - 1, &Step::a, w[2]);
    for (const std::uint32_t i : callee.written)
        copy(pointed(i)->place + pointed(i)->offset, callee.parameters[i], type(pointed(i)->type).cells);
    const std::uint32_t n = type(w[0]).cells;
    if (n > 0 && lasts(w[1], number, callee.result, n)) {
        cell_[w[1]] = callee.result;
    } else if (n > 0) {
        Step& step = made(code::copy, w);
        step.a = callee.result;
    }
    maker_ = none;
}

} // namespace lockstep::text
