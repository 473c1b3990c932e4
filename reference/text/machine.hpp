#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/text/cell.hpp"
#include "reference/text/coverage.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/memory.hpp"
#include "reference/text/program.hpp"
#include "reference/text/subgroup_words.hpp"
#include "reference/text/trace.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::text {

/// Runs W invocations of a program at once in a reading. Those at one step take it together, each operation a loop over
/// them; where branches part them, those at the earliest step go on first, so that they meet again where the text's
/// blocks do.
template <class R, int W> class Machine {
  public:
    using Real = typename R::Real;
    using C = Cell<R>;
    using Lane = std::uint32_t;

    Machine(R& reading, const Program& program, Memory& memory, const Bindings& bindings,
            std::array<std::uint32_t, 3> groups, std::uint32_t most_jumps)
        : r(reading), p_(program), memory_(memory), groups_(groups), most_jumps_(most_jumps),
          cells_(std::size_t{program.cells} * W), unset_(memory.races() != nullptr ? cells_.size() : 0) {
        for (const std::uint32_t one : program.undefined)
            mark_unset(one);
        for (const CellWord& one : program.constants)
            fill(one.cell, one.word, one.is_real);
        for (std::size_t u = 0; u < program.uniforms.size(); ++u)
            for (std::uint32_t c = 0; c < program.uniforms[u].cells && c < bindings.uniforms[u].size(); ++c)
                fill(program.uniforms[u].cell + c,
                     program.uniforms[u].is_boolean ? (bindings.uniforms[u][c] != 0 ? 1U : 0U)
                                                    : bindings.uniforms[u][c],
                     program.uniforms[u].is_real);
    }

    /// Of a reading that runs one invocation apart: where it puts what is written. `sites`: of sets, each step's.
    void keep(WrittenWords<R>& written, std::span<const Site* const> sites = {}) {
        written_ = &written;
        sites_ = sites;
    }
    /// Of a traced reading: where it puts what it notes, and the rows that get other bits than they were made with.
    void note_into(Trace& trace, std::span<const ForcedRow> forced) {
        noted_ = &trace;
        forced_ = forced;
        made_by_.assign(cells_.size(), 0);
        assigned_.assign(p_.output_cells, {});
    }
    /// Of a traced reading whose invocation is one of a group that shares: is called at each barrier, and has memory be
    /// what the others leave there. False: it ends there.
    void meet(std::function<bool()> others) { others_ = std::move(others); }
    /// Of sets in such a group: what lies where others have written; null: nobody has.
    void find(std::function<const GroupWord*(const WrittenPlace&)> of_others) { of_others_ = std::move(of_others); }
    /// At most W.
    void start(std::span<const Invocation> invocations);
    /// Until each has ended, or waits at a barrier.
    void run();

    [[nodiscard]] std::size_t size() const { return lanes_; }
    [[nodiscard]] std::size_t waiting() const {
        return static_cast<std::size_t>(std::count(state_.begin(), state_.begin() + lanes_, State::waiting));
    }
    /// The barrier at which lane l waits; null: it has ended.
    [[nodiscard]] const Step* barrier(std::size_t l) const {
        return state_[l] == State::waiting ? &p_.steps[pc_[l] - 1] : nullptr;
    }
    [[nodiscard]] const Invocation& invocation(std::size_t l) const { return invocations_[l]; }

    // Vertex, geometry and fragment stages: machine_stage.hpp.
    /// An input's words, after start().
    void give(const StageVariable& input, Lane l, std::span<const std::uint32_t> words);
    /// Lane l's outputs: Program::output_cells for each vertex that a geometry stage emitted, else once.
    [[nodiscard]] std::span<const C> made(std::size_t l) const { return made_[l]; }
    /// How many vertices lane l has emitted, and had at each EndPrimitive.
    [[nodiscard]] std::uint32_t vertices(std::size_t l) const { return vertices_[l]; }
    [[nodiscard]] std::span<const std::uint32_t> ends(std::size_t l) const { return ends_[l]; }
    [[nodiscard]] bool is_discarded(std::size_t l) const { return is_discarded_[l] != 0; }
    /// Each four invocations are a quad of neighbours: lower left, lower right, upper left, upper right.
    bool are_quads = false;
    /// Lanes in a row that are one subgroup, at most W; of a group's invocations in their order, from lane 0 on. 0: the
    /// run stands for a driver's, whose choices are not known.
    std::uint32_t subgroup_size = 0;
    Coverage* coverage = nullptr; ///< of the program, or null: nobody asks

  private:
    static constexpr std::uint32_t first_look = 4096; ///< branches, after which loops are looked at
    /// Branches, after which values and operands are looked at no more, so that a loop without an end ends soon.
    static constexpr std::uint32_t most_followed = 1'000'000;
    enum class State : std::uint8_t { running, waiting, ended };

    C* cell(std::uint32_t number) { return cells_.data() + std::size_t{number} * W; }
    void fill(std::uint32_t number, std::uint32_t word, bool is_real) {
        for (int l = 0; l < W; ++l)
            set_word(cell(number)[l], word, is_real);
    }
    static void set_word(C& to, std::uint32_t word, bool is_real) {
        to.set(word);
        if constexpr (has_sets<R>)
            if (is_real)
                to.set(Real(std::bit_cast<float>(word)));
    }
    /// Loops of this run on vectors, which they do not where a whole cell is assigned.
    static void assign(C& to, const C& from) {
        if constexpr (runs_apart<R>)
            to = from;
        else
            to.w = from.w;
    }
    /// The float that a number is; of a set, one of its own run for each.
    float number(const Real& x) {
        if constexpr (has_sets<R>)
            return r.one_of(x);
        else
            return x;
    }

    /// Calls f(l) for each lane at this step. Where no other lane will need its cells again, for all: a loop of a
    /// known length, on vectors.
    template <class F> void each(const F& f) {
        if (together_) {
#pragma GCC ivdep
            for (int l = 0; l < W; ++l)
                f(static_cast<Lane>(l));
        } else {
            apart(f);
        }
    }
    template <class F> [[gnu::noinline]] void apart(const F& f) { active(f); }
    /// Calls f(l) for each lane at this step, in their order, and for no other.
    template <class F> void active(const F& f) {
        for (std::uint32_t i = 0; i < count_; ++i)
            f(active_[i]);
    }
    /// Calls f(l, whether it is at this step) for all lanes: a loop on vectors.
    template <class F> void all(const F& f) {
#pragma GCC ivdep
        for (int l = 0; l < W; ++l)
            f(static_cast<Lane>(l), here_[l] != 0);
    }
    /// Whether some lane at this step is so.
    template <class F> bool any(const F& is) {
        std::uint32_t found = 0;
        for (int l = 0; l < W; ++l)
            found |= here_[l] & static_cast<std::uint32_t>(is(static_cast<Lane>(l)));
        return found != 0;
    }
    /// Whether all lanes at this step have the same there.
    bool are_one(const C* words) {
        const std::uint32_t first = words[active_[0]].word();
        return !any([&](Lane l) { return words[l].word() != first; });
    }
    [[nodiscard]] Place place(const Step& s, Lane l) const {
        return {p_.lines[static_cast<std::size_t>(&s - p_.steps.data())], invocations_[l].number};
    }

    // What a watched run looks for: machine_checks.hpp.
    /// Why a cell has no value: a variable that was never set, or an operation that GLSL gives no result for.
    struct Unset {
        std::uint32_t cell = 0, line = 0; ///< where it comes from, from 1, and the first operation's that used it
        std::uint32_t result = 0;         ///< of results_without_value_, from 1; 0: it is a variable's
    };
    /// An operation of a line that had operands without a result; a finding where something depends on the result.
    struct ResultWithoutValue {
        std::string_view rule;
        std::uint32_t line = 0;
        std::array<std::string, W> what{}; ///< of the last time, in each lane
    };
    [[nodiscard]] bool is_watched() const { return !unset_.empty(); }
    Unset* unset(std::uint32_t number) { return unset_.data() + std::size_t{number} * W; }
    void mark_unset(std::uint32_t number) {
        if (is_watched())
            std::fill_n(unset(number), W, Unset{number + 1, 0});
    }
    void need(const Step& s, std::uint32_t first, std::uint32_t n);
    void need_shared(const Step& s, std::uint32_t word, Lane l);
    void depend(const Unset& from, Place at, Lane l);
    template <class What> Unset without_value(std::string_view rule, Place at, Lane l, const What& what);
    void follow(const Step& s);
    void check(const Step& s);

    // Control: machine_flow.hpp.
    void take(const Step& s);
    /// Has all that it calls compiled into it, but for what is kept out, as rare or as no work of vectors.
    void run_on_vectors();
    void flow(const Step& s);
    void gather();
    void go_to(std::uint32_t step);
    [[gnu::noinline]] void look(std::uint32_t step);
    [[nodiscard]] bool can_end_from(std::uint32_t step) const;
    [[noreturn, gnu::noinline]] void end_loop(std::string_view rule, Place at, std::string why) const;
    template <class To> void go_each(const To& to);
    void take_from_blocks(const Step& s);
    [[nodiscard]] std::uint32_t case_of(const Step& s, std::uint32_t chosen) const;
    void note_came() {
        if (coverage != nullptr)
            coverage->ways[at_] |= Coverage::came;
    }
    void note_ways(const Step& s);

    // Stages: machine_stage.hpp.
    [[gnu::noinline]] void stage(const Step& s);
    void make(const Step& s, Lane l);
    void need_outputs(const Step& s, Lane l);
    void differ(const Step& s);

    // Memory: machine_memory.hpp; of an invocation that is run apart: machine_apart.hpp.
    void memory(const Step& s);
    bool memory_apart(const Step& s);
    bool sample_open(const Step& s) requires has_sets<R>;
    WrittenPlace atomic_place(const Step& s); ///< that an atomic operation changes
    // What becomes of what, of a traced reading: machine_trace.hpp.
    void note_operands(const Step& s);
    void note_results();
    [[gnu::noinline]] void atomic(const Step& s);
    // Subgroups: machine_subgroup.hpp.
    [[gnu::noinline]] void subgroup(const Step& s);
    void follow_subgroup(const Step& s);
    void subgroup_exchange(const Step& s, std::span<const Lane> peers, Lane l);
    std::optional<Lane> subgroup_source(const Step& s, std::span<const Lane> peers, Lane l);
    std::uint32_t subgroup_word(const Step& s, std::span<const Lane> peers, Lane l, std::uint32_t c);
    [[nodiscard]] std::uint32_t built_in(spv::BuiltIn builtin, Lane l, std::uint32_t c) const;
    std::uint32_t changed(const Step& s, std::uint32_t before, Lane l);
    [[gnu::noinline]] Memory::Texel sampled(const Step& s, Lane l);
    std::array<std::int32_t, 3> texel_place(std::uint32_t first, std::uint32_t count, Lane l);

    // Values: machine_operations.hpp and glsl_functions.hpp.
    void operation(const Step& s);
    void integer_operation(const Step& s);
    bool open_operation(const Step& s) requires has_sets<R>;
    void vector_operation(const Step& s);
    void multiply_matrix(const Step& s);
    void extended(const Step& s);
    void integer_function(const Step& s);
    [[gnu::noinline]] void geometric_function(const Step& s);
    void packing_function(const Step& s);
    void matrix_function(const Step& s);
    enum class Rounds : std::uint8_t { to_nearest, to_either, to_zero, up, to_sign };
    Real rounded(const Real& v, Rounds how); ///< to an integer
    /// out = f(operands), component by component.
    template <class F> void real1(const Step& s, const F& f);
    template <class F> void real2(const Step& s, const F& f);
    void sum(const Step& s, bool subtracts);
    void negate(const Step& s);
    template <class F> void real3(const Step& s, const F& f);
    template <class F> void word1(const Step& s, const F& f);
    template <class F> void word2(const Step& s, const F& f);
    template <class F> void compare(const Step& s, const F& f);
    /// The sum of n products, in the order that the driver was measured to take for dot, length or normalize.
    Real sum_of_products(const Step& s, DotOrder order, std::uint32_t a, std::uint32_t b, std::uint32_t n, Lane l);
    typename R::Vec3 vec3(std::uint32_t first, Lane l) {
        return {cell(first)[l].real(), cell(first + 1)[l].real(), cell(first + 2)[l].real()};
    }
    [[noreturn, gnu::noinline]] void refuse(const Step& s, std::string_view what) const {
        throw Error(fmt::format("shader {}: {}", p_.line_name(place(s, 0).line), what));
    }

    R& r;
    const Program& p_;
    Memory& memory_;
    std::array<std::uint32_t, 3> groups_;
    std::uint32_t most_jumps_;
    std::vector<C> cells_;
    std::vector<Unset> unset_; ///< as cells_; empty: nobody looks
    std::uint32_t lanes_ = 0, count_ = 0, at_ = 0, jumps_ = 0, looks_from_ = 0;
    std::uint32_t others_at_ = 0; ///< the earliest step of those that run elsewhere; 0: is to be found
    bool together_ = true;        ///< the lanes at this step are all that run or wait
    std::array<Lane, W> active_{};
    std::array<std::uint32_t, W> here_{}; ///< of each lane, 1 where it is one of these
    std::array<State, W> state_{};
    std::array<std::uint32_t, W> pc_{}, from_{}, depth_{};
    std::array<Invocation, W> invocations_{};
    std::vector<std::uint32_t> returns_; ///< of each depth, W
    std::vector<C> moved_;
    std::vector<Unset> moved_unset_;
    std::vector<ResultWithoutValue> results_without_value_;
    std::array<std::vector<C>, W> made_;
    std::array<std::vector<std::uint32_t>, W> ends_;
    std::array<std::uint32_t, W> vertices_{};
    std::array<std::uint8_t, W> is_discarded_{};
    WrittenWords<R>* written_ = nullptr;
    std::function<bool()> others_; ///< empty: it shares nothing
    std::function<const GroupWord*(const WrittenPlace&)> of_others_;
    Trace* noted_ = nullptr;
    std::span<const ForcedRow> forced_;
    struct PendingRow {
        TraceRow row;
        std::uint32_t cell = 0;
        bool is_result = true;
    };
    std::vector<PendingRow> pending_;
    std::uint32_t calls_ = 0;                                    ///< TraceRow::calls of what is noted
    std::uint32_t noted_step_ = 0;                               ///< that is noted
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moves_; ///< cells and who made what is moved there
    std::vector<std::uint32_t> made_by_, moved_made_by_; ///< of a traced reading, the row of each cell and 1; 0: none
    /// Of a traced reading, where each cell of an output was set last.
    struct Assigned {
        std::uint32_t step = 0, calls = 0;
        bool is_set = false;
    };
    std::vector<Assigned> assigned_;
    std::span<const Site* const> sites_;
    /// All that decides how a watched run goes on, at one of its jumps.
    struct Seen {
        std::uint32_t step = 0;
        std::uint64_t changes = 0, reads = 0;
        std::vector<Lane> active;
        std::array<State, W> state{};
        std::array<std::uint32_t, W> pc{}, from{}, depth{};
        std::vector<std::uint32_t> returns;
        std::vector<C> cells;
    };
    Seen seen_;
    std::uint32_t seen_at_ = 0; ///< jumps_ then
};

template <class R, int W> void Machine<R, W>::start(std::span<const Invocation> invocations) {
    if (p_.choice_line != 0 && subgroup_size == 0)
        throw Error(fmt::format("shader {}: {} is the driver's choice; such a text is interpreted by examine alone",
                                p_.line_name(p_.choice_line), p_.choice));
    lanes_ = static_cast<std::uint32_t>(invocations.size());
    std::copy(invocations.begin(), invocations.end(), invocations_.begin());
    std::fill(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(std::size_t{p_.variables} * W), C{});
    for (std::uint32_t number = 0; is_watched() && number < p_.variables; ++number)
        mark_unset(number);
    for (const CellWord& one : p_.initial) {
        fill(one.cell, one.word, one.is_real);
        if (is_watched())
            std::fill_n(unset(one.cell), W, Unset{});
    }
    if constexpr (has_sets<R>)
        if (r.has_wide_constants())
            for (const CellWord& one : p_.constants)
                if (one.is_real)
                    cell(one.cell)->set(r.before_rounding(std::bit_cast<float>(one.word)));
    for (const BuiltInInput& input : p_.inputs)
        for (std::uint32_t l = 0; l < lanes_; ++l)
            for (std::uint32_t c = 0; c < input.cells; ++c)
                cell(input.cell + c)[l].set(built_in(input.builtin, l, c));
    pc_.fill(p_.entry);
    depth_.fill(0);
    for (std::uint32_t l = 0; l < W; ++l)
        state_[l] = l < lanes_ ? State::running : State::ended;
    jumps_ = 0;
    looks_from_ = is_watched() ? std::min(first_look, most_jumps_) : most_jumps_;
    vertices_.fill(0);
    is_discarded_.fill(0);
    for (std::uint32_t l = 0; l < W; ++l) {
        made_[l].clear();
        ends_[l].clear();
    }
}

template <class R, int W> std::uint32_t Machine<R, W>::built_in(spv::BuiltIn builtin, Lane l, std::uint32_t c) const {
    const Invocation& of = invocations_[l];
    const std::uint32_t index = (of.local[2] * p_.group[1] + of.local[1]) * p_.group[0] + of.local[0];
    switch (builtin) {
    case spv::BuiltInGlobalInvocationId:
        return of.group[c] * p_.group[c] + of.local[c];
    case spv::BuiltInLocalInvocationId:
        return of.local[c];
    case spv::BuiltInWorkgroupId:
        return of.group[c];
    case spv::BuiltInNumWorkgroups:
        return groups_[c];
    case spv::BuiltInLocalInvocationIndex:
        return index;
    case spv::BuiltInDeviceIndex: // there is one
        return 0;
    default:
        return subgroup_input(builtin, subgroup_size, p_.stage == spv::ExecutionModelGLCompute ? index : l,
                              p_.invocations(), c);
    }
}

template <class R, int W> void Machine<R, W>::run() {
    for (State& state : state_)
        if (state == State::waiting)
            state = State::running;
    seen_.active.clear(); // at a barrier others go on
    gather();
    if constexpr (!runs_apart<R>)
        if (!is_watched())
            return run_on_vectors();
    while (count_ > 0) {
        const Step& s = p_.steps[at_++];
        if constexpr (has_sets<R>)
            r.set_place(*sites_[at_ - 1], p_.precise[at_ - 1] != 0);
        else if constexpr (is_traced<R>)
            note_operands(s);
        else if (is_watched() && jumps_ <= most_followed) {
            follow(s);
            check(s);
        }
        take(s);
        if constexpr (is_traced<R>)
            note_results();
    }
}

template <class R, int W> void Machine<R, W>::take(const Step& s) {
    if (s.op < code::extended)
        operation(s);
    else if (s.op < code::own)
        extended(s);
    else if (s.op < code::jump)
        memory(s);
    else if (s.op < code::stages)
        flow(s);
    else
        stage(s);
}

} // namespace lockstep::text
