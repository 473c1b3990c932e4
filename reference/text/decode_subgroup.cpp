#include <algorithm>

#include "reference/text/decoder.hpp"
#include "reference/text/subgroup_words.hpp"

namespace lockstep::text {

/// Operations of the invocations of a subgroup (SPIR-V 1.6, 3.49.21). Returns false for other instructions.
bool Decoder::subgroup_operation(const Instruction& at) {
    const Words w = at.words;
    if (at.op >= spv::OpSubgroupAllKHR && at.op <= spv::OpSubgroupAllEqualKHR) { // GL_ARB_shader_group_vote
        use_subgroups();
        const std::uint32_t a = cell(w[2]);
        Step& step = made(static_cast<std::uint16_t>(at.op - spv::OpSubgroupAllKHR + spv::OpGroupNonUniformAll), w);
        step.a = a;
        step.d = 1;
        return true;
    }
    if (!is_subgroup_operation(static_cast<std::uint16_t>(at.op)))
        return false;
    use_subgroups();
    const Constant* const scope = module_.constant(w[2]);
    if (scope == nullptr || scope->words.front() != spv::ScopeSubgroup)
        refuse("an operation of another scope than a subgroup is not interpreted");
    const bool is_arithmetic = at.op >= spv::OpGroupNonUniformIAdd && at.op <= spv::OpGroupNonUniformLogicalXor,
               has_kind = is_arithmetic || at.op == spv::OpGroupNonUniformBallotBitCount;
    const std::size_t value = has_kind ? 4 : 3;
    const std::uint32_t a = value < w.size() ? cell(w[value]) : 0, b = value + 1 < w.size() ? cell(w[value + 1]) : 0;
    Step& step = made(static_cast<std::uint16_t>(at.op), w);
    step.a = a;
    step.b = b;
    step.c = has_kind ? w[3] : 0;
    step.d = value < w.size() ? module_.type_of(w[value]).cells : 0;
    if (at.op == spv::OpGroupNonUniformAllEqual && is_real(module_.ids[w[value]].type))
        step.c = 1;
    return true;
}

void Decoder::use_subgroups() {
    if (p_.stage != spv::ExecutionModelGLCompute && p_.stage != spv::ExecutionModelFragment)
        refuse("subgroups of a vertex or geometry stage are not interpreted");
    leave_to_driver("the size of subgroups");
}

void Decoder::leave_to_driver(std::string_view choice) {
    if (p_.choice_line != 0)
        return;
    p_.choice_line = std::max(line_, 1U);
    p_.choice = choice;
}

} // namespace lockstep::text
