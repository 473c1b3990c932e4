#include "reference/text/constant_result.hpp"

#include <algorithm>
#include <array>

#include "reference/text/text_machine.hpp"

namespace lockstep::text {

/// Runs the operation as a program of one step.
std::optional<std::vector<std::uint32_t>> constant_result(spv::Op op, std::uint32_t components,
                                                          std::span<const std::vector<std::uint32_t>> operands) {
    const bool is_known = (op >= spv::OpSNegate && op <= spv::OpIAdd && op != spv::OpFNegate) || op == spv::OpISub ||
                          op == spv::OpIMul || op == spv::OpUDiv || op == spv::OpSDiv ||
                          (op >= spv::OpUMod && op <= spv::OpSMod) ||
                          (op >= spv::OpLogicalEqual && op <= spv::OpSLessThanEqual) ||
                          (op >= spv::OpShiftRightLogical && op <= spv::OpNot);
    if (!is_known || operands.empty() || operands.size() > 3)
        return std::nullopt;
    Program program;
    program.stage = spv::ExecutionModelVertex; // it has outputs
    Step step{.op = static_cast<std::uint16_t>(op), .n = static_cast<std::uint16_t>(components)};
    program.output_cells = program.cells = components;
    const std::array<std::uint32_t Step::*, 3> fields{&Step::a, &Step::b, &Step::c};
    for (std::size_t k = 0; k < operands.size(); ++k) {
        step.*fields[k] = program.cells;
        for (const std::uint32_t word : operands[k])
            program.constants.push_back({program.cells++, word, false});
    }
    if (op == spv::OpSelect)
        step.d = operands[0].size() > 1 ? 1 : 0;
    program.steps = {step, {.op = code::finish}};
    program.lines = {0, 0};
    Findings findings;
    const Bindings bindings;
    TextValues values{Profile{}};
    Memory memory(program, bindings, findings, nullptr);
    TextMachine machine(values, program, memory, bindings, {1, 1, 1}, 1);
    const Invocation one;
    machine.start({&one, 1});
    machine.run();
    std::vector<std::uint32_t> words;
    for (const TextMachine::C& made : machine.made(0))
        words.push_back(made.word());
    return words;
}

} // namespace lockstep::text
