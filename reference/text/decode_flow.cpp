#include <algorithm>
#include <tuple>

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
        merge_ = none;
        begins_loop_ = false;
        step_of_[w[0]] = static_cast<std::uint32_t>(p_.steps.size());
        maker_ = none;
        return true;
    case spv::OpBranch:
        leave({w[0]});
        is_stated_ = is_stated_ && !begins_loop_; // that is the condition's line, which may be behind the body
        add(code::jump);
        jump_to(here(), &Step::a, w[0]);
        return true;
    case spv::OpBranchConditional: {
        leave({w[1], w[2]});
        add(code::branch).a = cell(w[0]);
        note_decision(w, false);
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
        note_decision(w, true);
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

/// What the branch that was just made is in the text, as glslang writes it.
void Decoder::note_decision(Words w, bool is_switch) {
    if (module_.constant(w[0]) != nullptr)
        return;
    Decision made{.step = static_cast<std::uint32_t>(p_.steps.size()) - 1, .line = line_};
    const auto ends_loop = [&](std::uint32_t label) { return loop_ends_.contains(label); };
    if (is_switch) {
        made.kind = Decision::Kind::cases;
        made.has_default = w[1] != merge_;
        made.is_signed = module_.type_of(w[0]).is_signed;
    } else if (merge_ == none && (ends_loop(w[1]) || ends_loop(w[2]))) {
        made.kind = step_of_.contains(w[1]) ? Decision::Kind::loop_again : Decision::Kind::loop;
    } else if (merge_ != none && has_phi_[merge_]) {
        // Where its left side is false, `&&` has that value; `||` asks for its opposite.
        const auto& body = function_->body;
        const auto label = std::ranges::find_if(
            body, [&](const Instruction& one) { return one.op == spv::OpLabel && one.words[0] == merge_; });
        const Words phi = label == body.end() ? Words() : (label + 1)->words;
        for (std::size_t i = 2; i + 1 < phi.size(); i += 2) {
            if (phi[i + 1] != block_)
                continue;
            const bool is_opposite = std::ranges::any_of(body, [&](const Instruction& one) {
                return one.op == spv::OpLogicalNot && one.result == w[0] && one.words[2] == phi[i];
            });
            made.kind = phi[i] == w[0] ? Decision::Kind::left_of_and
                        : is_opposite  ? Decision::Kind::left_of_or
                                       : Decision::Kind::condition;
        }
    }
    p_.decisions.push_back(made);
}

const Decoder::Address* Decoder::pointed(std::uint32_t id) const {
    const auto at = address_.find(id);
    return at == address_.end() ? nullptr : &at->second;
}

void Decoder::copy(std::uint32_t to, std::uint32_t from, std::uint32_t n) {
    Step& step = add(code::copy);
    step.out = to;
    step.a = from;
    step.n = static_cast<std::uint16_t>(n);
}

void Decoder::call(Words w, std::size_t number) {
    const auto found = callees_.find(w[2]);
    if (found == callees_.end())
        refuse(fmt::format("function {} has no body", module_.ids[w[2]].name));
    const Callee& callee = found->second;
    constexpr std::size_t most_in_place = 1U << 18U;
    if (callee.is_block && p_.steps.size() < most_in_place)
        return in_place(w, number, callee);
    const Words arguments = w.subspan(3);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const Address* address = pointed(arguments[i]);
        if (address != nullptr && (address->space != Address::Space::variable || address->dynamic != none))
            refuse(fmt::format("an argument of {} is a pointer, which is not interpreted", module_.ids[w[2]].name));
        for (std::size_t k = 0; address != nullptr && k < i; ++k)
            if (arguments[k] == arguments[i] && std::count(callee.written.begin(), callee.written.end(), i) > 0)
                refuse(fmt::format("two arguments of {} are one variable", module_.ids[w[2]].name));
        if (address != nullptr) {
            note_read(*address);
            copy(callee.parameters[i], address->place + address->offset, type(address->type).cells);
        } else {
            copy(callee.parameters[i], cell(arguments[i]), module_.type_of(arguments[i]).cells);
        }
    }
    if (std::find(called_.begin(), called_.end(), callee.function) == called_.end())
        called_.push_back(callee.function);
    add(code::call);
    jump_to(static_cast<std::uint32_t>(p_.steps.size()) - 1, &Step::a, w[2]);
    for (const std::uint32_t i : callee.written) {
        const Address& to = *pointed(arguments[i]);
        copy(to.place + to.offset, callee.parameters[i], type(to.type).cells);
    }
    take_result(w, number, callee.result, false);
}

/// A function of one block takes the place of its call. Its parameters are the arguments themselves.
void Decoder::in_place(Words w, std::size_t number, const Callee& callee) {
    const Function& of = *callee.function;
    for (std::size_t i = 0; i < of.parameters.size(); ++i) {
        const std::uint32_t parameter = of.parameters[i], argument = w[3 + i];
        if (const Address* const at = pointed(argument)) {
            address_[parameter] = Address(*at);
            continue;
        }
        cell_[parameter] = cell(argument);
        if (cell_[parameter] < p_.variables) { // it may be changed on the way
            copy(callee.parameters[i], cell(argument), module_.type_of(argument).cells);
            cell_[parameter] = callee.parameters[i];
        }
    }
    for (const Instruction& at : of.body)
        if (at.result != 0 && at.op != spv::OpVariable)
            cell_[at.result] = none;
    const auto [function, block, line, own, stated] = std::tuple(function_, block_, line_, p_.cells, is_stated_);
    function_ = &of;
    p_.in_place.push_back({line_, in_place_of_});
    in_place_of_ = static_cast<std::uint32_t>(p_.in_place.size());
    std::uint32_t returned = none;
    for (std::size_t i = 0; i < of.body.size(); ++i) {
        const Instruction& at = of.body[i];
        if (at.op == spv::OpReturnValue)
            returned = cell(at.words[0]);
        else if (at.op != spv::OpLabel && at.op != spv::OpReturn && at.op != spv::OpUnreachable)
            instruction(at, i);
    }
    in_place_of_ = p_.in_place[in_place_of_ - 1].outer;
    function_ = function;
    block_ = block;
    line_ = line;
    is_stated_ = stated;
    if (returned != none)
        take_result(w, number, returned, returned >= own);
}

/// A call's result, which lies from `first` on; `stays`: for good, in cells of its own.
void Decoder::take_result(Words w, std::size_t number, std::uint32_t first, bool stays) {
    const std::uint32_t n = type(w[0]).cells;
    if (n == 0)
        return;
    if (stays || lasts(w[1], number, first, n)) {
        cell_[w[1]] = first;
    } else {
        Step& step = made(code::copy, w);
        step.a = first;
    }
    if (!stays)
        maker_ = none;
    else if (maker_ != none && cell_[maker_] == first) // the last step made it, and a store may still go there
        maker_ = w[1];
}

} // namespace lockstep::text
