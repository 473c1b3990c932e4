#include "reference/text/text_machine.hpp"

#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/machine_memory.hpp"

namespace lockstep::text {

/// Operations on cells alone are taken for all lanes where enough of them are at the step; those that are not get their
/// cells back.
template <> LOCKSTEP_VECTOR_CLONES void TextMachine::run_on_vectors() {
    constexpr std::uint32_t W = lanes_at_once;
    while (count_ > 0) {
        const Step& s = p_.steps[at_++];
        const bool is_operation = s.op < code::own ? !is_subgroup_operation(s.op)
                                                   : s.op == code::copy || s.op == code::address ||
                                                         s.op == code::real_bits || s.op == code::bits_as_real;
        if (together_ || !is_operation || count_ < W / 8) {
            take(s);
            continue;
        }
        const std::size_t words = (s.op == code::address ? 1 : s.n) * std::size_t{W};
        C* const out = cell(s.out);
        moved_.assign(out, out + words);
        together_ = true;
        take(s);
        together_ = false;
        const C* const before = moved_.data();
        for (std::size_t c = 0; c < words; c += W)
            all([&](Lane l, bool is_here) { out[c + l].w = is_here ? out[c + l].w : before[c + l].w; });
    }
}

template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
