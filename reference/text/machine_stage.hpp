#pragma once
#include <string_view>

#include "reference/text/machine_checks.hpp"

/// Inputs and outputs of Machine's vertex, geometry and fragment stages, and their own instructions.
namespace lockstep::text {

inline constexpr std::string_view unwritten_rule = "output that is not written (GLSL 4.60, 4.3.6)";

template <class R, int W>
void Machine<R, W>::give(const StageVariable& input, Lane l, std::span<const std::uint32_t> words) {
    for (std::uint32_t vertex = 0; vertex < input.vertices; ++vertex)
        for (std::uint32_t c = 0; c < input.cells; ++c) {
            const std::uint32_t word = words[vertex * input.cells + c];
            C& to = cell(input.cell + vertex * input.stride + c)[l];
            set_word(to, input.is_boolean ? static_cast<std::uint32_t>(word != 0) : word, input.is_real);
            if constexpr (has_sets<R>)
                if (input.is_real)
                    to.set(r.read(in_text, std::bit_cast<float>(word)));
        }
}

/// Keeps lane l's outputs as they are.
template <class R, int W> void Machine<R, W>::make(const Step& s, Lane l) {
    if (is_watched())
        need_outputs(s, l);
    if constexpr (runs_apart<R>)
        for (const StageVariable& output : p_.stage_outputs)
            for (std::uint32_t c = output.cell; c < output.cell + output.cells; ++c) {
                if constexpr (is_traced<R>)
                    if (!assigned_[c].is_set)
                        continue;
                C& to = (*written_)[{WrittenPlace::Space::output, 0, c}];
                to = cell(c)[l];
                if constexpr (has_sets<R>)
                    to.is_real = output.is_real || to.is_bits_of_x();
            }
    for (std::uint32_t c = 0; c < p_.output_cells; ++c)
        made_[l].push_back(cell(c)[l]);
}

/// Findings for outputs that the text writes somewhere, and did not write here. A fragment's are all needed.
template <class R, int W> void Machine<R, W>::need_outputs(const Step& s, Lane l) {
    for (const StageVariable& output : p_.stage_outputs)
        for (std::uint32_t c = output.cell; c < output.cell + output.cells; ++c) {
            const Unset from = unset(c)[l];
            const bool is_needed =
                p_.is_written[c] != 0 || (p_.stage == spv::ExecutionModelFragment && !output.builtin);
            if (from.cell == 0 || !is_needed)
                continue;
            const Place at = place(s, l);
            if (from.cell - 1 == c && from.result == 0)
                memory_.findings().add(unwritten_rule, at, [&] { return output.name; });
            else
                depend(from, at, l);
            break;
        }
}

/// Differences in a quad: of the two in its row, and of the two in its column (GLSL 4.60, 8.14.1, the finer ones).
template <class R, int W> void Machine<R, W>::differ(const Step& s) {
    if (!are_quads)
        refuse(s, "a derivative needs neighbours, which are not given; expected invocations in quads");
    std::array<bool, W> is_here{};
    active([&](Lane l) { is_here[l] = true; });
    for (std::uint32_t c = 0; c < s.n; ++c) {
        const C* const a = cell(s.a + c);
        C* const out = cell(s.out + c);
        active([&](Lane l) {
            const auto along = [&](Lane bit) -> Real {
                const Lane low = l & ~bit, high = l | bit;
                if (high < W && is_here[low] && is_here[high])
                    return a[high].real() - a[low].real();
                memory_.findings().add(
                    "derivative that not all of a quad come to (GLSL 4.60, 8.14.1)", place(s, l),
                    [&] { return fmt::format("invocation {}'s neighbour", invocations_[l].number); });
                return Real(0.0F);
            };
            if (s.op == code::differ_both)
                out[l].set(Real(r.abs(along(1)) + r.abs(along(2))));
            else
                out[l].set(along(s.op == code::differ_x ? 1 : 2));
        });
    }
}

template <class R, int W> void Machine<R, W>::stage(const Step& s) {
    switch (s.op) {
    case code::discard:
        active([&](Lane l) {
            state_[l] = State::ended;
            is_discarded_[l] = 1;
        });
        gather();
        break;
    case code::emit_vertex:
        active([&](Lane l) {
            if (vertices_[l] >= p_.most_vertices) {
                memory_.findings().add("more vertices than max_vertices (GLSL 4.60, 4.4.2.2)", place(s, l), [&] {
                    return fmt::format("vertex {} of {}", p_.most_vertices + 1, p_.most_vertices);
                });
                return;
            }
            make(s, l);
            ++vertices_[l];
            for (std::uint32_t c = 0; is_watched() && c < p_.output_cells; ++c) // undefined from here (8.15)
                unset(c)[l] = {c + 1, 0};
        });
        break;
    case code::end_primitive:
        active([&](Lane l) { ends_[l].push_back(vertices_[l]); });
        break;
    default:
        differ(s);
    }
}

} // namespace lockstep::text
