#include "reference/text/text_machine.hpp"

#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/machine_memory.hpp"

namespace lockstep::text {

/// Takes the steps from here on up to the first that is no operation on cells alone. Where some lanes wait elsewhere,
/// it is taken for all, and those get their cells back.
template <> LOCKSTEP_VECTOR_CLONES void TextMachine::operations() {
    constexpr std::uint32_t W = lanes_at_once;
    for (;; ++at_) {
        const Step& s = p_.steps[at_];
        if (s.op < code::own
                ? is_subgroup_operation(s.op)
                : s.op != code::copy && s.op != code::address && s.op != code::real_bits && s.op != code::bits_as_real)
            return;
        const bool parts = !together_ && count_ >= W / 8;
        const std::size_t words = (s.op == code::address ? 1 : s.n) * std::size_t{W};
        C* const out = cell(s.out);
        if (parts) {
            moved_.assign(out, out + words);
            together_ = true;
        }
        if (s.op < code::extended)
            operation(s);
        else if (s.op < code::own)
            extended(s);
        else
            memory(s);
        if (parts) {
            together_ = false;
            const C* const before = moved_.data();
            const std::uint32_t* const here = here_.data();
            for (std::size_t c = 0; c < words; c += W) {
                LOCKSTEP_VECTOR_LOOP
                for (std::size_t l = 0; l < W; ++l)
                    out[c + l].w = here[l] != 0 ? out[c + l].w : before[c + l].w;
            }
        }
    }
}

template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
