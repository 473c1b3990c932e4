#include "reference/text/fewer_copies.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "reference/text/machine_checks.hpp"

namespace lockstep::text {
namespace {

/// Cells that a step reads or writes.
struct CellRange {
    std::uint32_t first = 0, count = 0;
    std::uint32_t* field = nullptr; ///< of an operand that may lie elsewhere: where the step says `first`

    [[nodiscard]] std::uint32_t end() const { return first + count; }
    [[nodiscard]] bool overlaps(const CellRange& other) const { return first < other.end() && other.first < end(); }
    [[nodiscard]] bool holds(const CellRange& other) const { return first <= other.first && other.end() <= end(); }
};

/// The cells that an index may lead to from a variable's first.
CellRange indexed(const Program& p, std::uint32_t first) {
    for (const PlainUniform& uniform : p.uniforms)
        if (first >= uniform.cell && first < uniform.cell + uniform.cells)
            return {first, 1}; // no step writes them
    const auto behind = std::ranges::upper_bound(p.names, first, {}, &NamedCells::first);
    if (behind != p.names.begin() && first < (behind - 1)->first + (behind - 1)->count)
        return {first, (behind - 1)->first + (behind - 1)->count - first};
    return {first, p.cells - first};
}

/// Calls f(range) for each operand.
template <class F> void each_operand(Program& p, Step& s, const F& f) {
    const auto take = [&](std::uint32_t& first, std::uint32_t count) { f(CellRange{first, count, &first}); };
    const auto stay = [&](std::uint32_t first, std::uint32_t count) { f(CellRange{first, count}); };
    switch (s.op) {
    case code::copy:
    case code::real_bits:
    case code::bits_as_real:
        return take(s.a, s.n);
    case code::address:
        for (std::uint32_t k = 0; k < s.n; ++k)
            take(p.operands[s.d + 3 * k], 1);
        return;
    case code::load_variable:
        take(s.b, 1);
        return f(indexed(p, s.a));
    case code::store_variable:
    case code::store_shared:
    case code::store_block:
        take(s.b, 1);
        return take(s.c, s.n);
    case code::load_shared:
    case code::load_block:
        return take(s.b, 1);
    case code::atomic_texel:
        stay(s.a, 1);
        stay(s.b, 3);
        [[fallthrough]];
    case code::atomic_shared:
    case code::atomic_block:
        for (const std::uint32_t one : {s.b, s.c, s.d})
            stay(one, 1);
        return;
    case code::image_size:
    case code::branch:
    case code::choose:
        return take(s.a, 1);
    case code::load_texel:
    case code::fetch_texel:
    case code::sample_texel:
        stay(s.a, 1);
        take(s.b, s.c);
        if (s.op != code::load_texel && s.d != no_cell)
            stay(s.d, 3);
        return;
    case code::store_texel:
        stay(s.a, 1);
        take(s.b, s.d);
        return take(s.c, s.n);
    case code::from_block: // of its block's beginning
        for (std::uint32_t k = 0; k < s.a; ++k)
            stay(p.operands[s.d + 2 * k + 1], s.n);
        return;
    case spv::OpSelect:
        take(s.a, s.d != 0 ? s.n : 1);
        take(s.b, s.n);
        return take(s.c, s.n);
    case spv::OpVectorExtractDynamic:
    case spv::OpVectorInsertDynamic:
        take(s.a, s.d);
        take(s.b, 1);
        if (s.op == spv::OpVectorInsertDynamic)
            take(s.c, 1);
        return;
    default:
        break;
    }
    if (s.op >= code::own)
        return;
    const StepOperands operands = operands_of(s);
    const std::array<std::uint32_t*, 4> fields{&s.a, &s.b, &s.c, &s.d};
    for (std::size_t k = 0; k < operands.count; ++k)
        take(*fields[k], operands.ranges[k].second);
}

/// What the step writes, all of it, or of an indexed variable some.
CellRange written(const Program& p, const Step& s) {
    switch (s.op) {
    case code::address:
        return {s.out, 1};
    case code::store_variable:
        return indexed(p, s.a);
    case code::atomic_shared:
    case code::atomic_block:
    case code::atomic_texel:
        return s.out == no_cell ? CellRange{} : CellRange{s.out, 1};
    case code::store_shared:
    case code::store_block:
    case code::store_texel:
        return {};
    default:
        return s.op < code::jump || s.op == code::from_block ? CellRange{s.out, s.n} : CellRange{};
    }
}

/// Whether component c of what it makes needs no other component of its operands.
bool is_by_component(const Step& s) {
    return s.op < code::own ? operands_of(s).by_component
                            : s.op == code::copy || s.op == code::real_bits || s.op == code::bits_as_real;
}

/// Whether it makes a value and does nothing else, findings included.
bool only_makes(const Program& p, const Step& s) {
    if (s.op == code::address) {
        for (std::uint32_t k = 0; k < s.n; ++k)
            if (p.operands[s.d + 3 * k + 2] != 0)
                return false;
        return true;
    }
    return s.op < code::own ? s.op != spv::OpVectorExtractDynamic && s.op != spv::OpVectorInsertDynamic
                            : s.op == code::copy || s.op == code::real_bits || s.op == code::bits_as_real;
}

bool ends_block(const Step& s) {
    return s.op == code::jump || s.op == code::branch || s.op == code::choose || s.op == code::call ||
           s.op == code::finish;
}

/// Calls f(field) for each step that a step names.
template <class F> void each_target(Program& p, Step& s, const F& f) {
    if (s.op == code::jump || s.op == code::call)
        f(s.a);
    if (s.op == code::branch || s.op == code::choose)
        f(s.b);
    if (s.op == code::branch)
        f(s.c);
    for (std::uint32_t k = 0; s.op == code::choose && k < s.n; ++k)
        f(p.operands[s.d + 2 * k + 1]);
}

/// Steps that follow each other, whoever comes to the first.
struct StepBlock {
    std::uint32_t begin = 0, end = 0;
    std::vector<std::uint32_t> next = {}; ///< blocks
    std::uint32_t ways_here = 0;
};

std::vector<StepBlock> blocks_of(Program& p) {
    const auto count = static_cast<std::uint32_t>(p.steps.size());
    std::vector<std::uint32_t> begins(count + 1), returns;
    begins[p.entry] = 1;
    for (std::uint32_t k = 0; k < count; ++k) {
        each_target(p, p.steps[k], [&](std::uint32_t to) { begins[to] = 1; });
        if (ends_block(p.steps[k]))
            begins[k + 1] = 1;
        if (p.steps[k].op == code::call)
            returns.push_back(k + 1);
    }
    std::vector<StepBlock> blocks;
    for (std::uint32_t k = 0; k < count; ++k) {
        if (begins[k] != 0 || k == 0)
            blocks.push_back({.begin = k});
        blocks.back().end = k + 1;
        begins[k] = static_cast<std::uint32_t>(blocks.size()) - 1; // from here on the block's number
    }
    ++blocks[begins[p.entry]].ways_here;
    for (StepBlock& block : blocks) {
        Step& last = p.steps[block.end - 1];
        each_target(p, last, [&](std::uint32_t to) { block.next.push_back(begins[to]); });
        for (std::size_t k = 0; last.op == code::finish && k < returns.size(); ++k)
            block.next.push_back(begins[returns[k]]);
        if (!ends_block(last) && block.end < count)
            block.next.push_back(begins[block.end]);
        for (const std::uint32_t to : block.next)
            ++blocks[to].ways_here;
    }
    return blocks;
}

/// What cells are copies of, at some step.
class Copies {
  public:
    explicit Copies(std::uint32_t cells) : of_(cells), copies_(cells) { forget(); }
    using Known = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

    void forget() {
        for (std::uint32_t c = 0; c < of_.size(); ++c)
            of_[c] = c;
    }
    [[nodiscard]] Known known() const {
        Known all;
        for (std::uint32_t c = 0; c < of_.size(); ++c)
            if (of_[c] != c)
                all.emplace_back(c, of_[c]);
        return all;
    }
    void write(std::uint32_t cell) {
        of_[cell] = cell;
        for (const std::uint32_t copy : copies_[cell])
            if (of_[copy] == cell)
                of_[copy] = copy;
        copies_[cell].clear();
    }
    void copy(std::uint32_t to, std::uint32_t from) {
        of_[to] = from;
        copies_[from].push_back(to);
    }
    [[nodiscard]] std::uint32_t of(std::uint32_t cell) const { return of_[cell]; }
    /// Where all of a range lies, one after the other, or the range itself.
    [[nodiscard]] std::uint32_t of(const CellRange& range) const {
        for (std::uint32_t c = 1; c < range.count; ++c)
            if (of_[range.first + c] != of_[range.first] + c)
                return range.first;
        return range.count > 0 ? of_[range.first] : range.first;
    }

  private:
    std::vector<std::uint32_t> of_;
    std::vector<std::vector<std::uint32_t>> copies_;
};

/// Operands are taken from what they are copies of; known across blocks that one way alone leads to.
void take_from_sources(Program& p, const std::vector<StepBlock>& blocks) {
    std::vector<Copies::Known> known(blocks.size());
    Copies copies(p.cells);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        copies.forget();
        for (const auto& [to, from] : known[b])
            copies.copy(to, from);
        for (std::uint32_t k = blocks[b].begin; k < blocks[b].end; ++k) {
            Step& s = p.steps[k];
            const CellRange out = written(p, s);
            each_operand(p, s, [&](const CellRange& operand) {
                const CellRange source{copies.of(operand), operand.count};
                const bool is_same = source.first == out.first && source.count == out.count;
                if (operand.field != nullptr && (!source.overlaps(out) || (is_same && is_by_component(s))))
                    *operand.field = source.first;
            });
            const bool copied = s.op == code::copy && !out.overlaps({s.a, s.n});
            for (std::uint32_t c = 0; c < out.count; ++c) {
                const std::uint32_t from = copied ? copies.of(s.a + c) : out.first + c;
                copies.write(out.first + c);
                if (from != out.first + c && !(copied && from >= out.first && from < out.end()))
                    copies.copy(out.first + c, from);
            }
        }
        for (const std::uint32_t to : blocks[b].next)
            if (blocks[to].ways_here == 1 && to > b && p.steps[blocks[b].end - 1].op != code::finish &&
                p.steps[blocks[b].end - 1].op != code::call)
                known[to] = copies.known();
    }
}

/// Of each block, the cells that are taken from its beginning, or its end, on before they are written; and of each
/// step, whether it makes what some step takes, or does more.
struct Liveness {
    std::vector<std::vector<bool>> before, behind;
    std::vector<std::uint8_t> needed;
};

Liveness liveness_of(Program& p, const std::vector<StepBlock>& blocks) {
    const std::vector<bool> none(p.cells);
    Liveness made{{blocks.size(), none}, {blocks.size(), none}, std::vector<std::uint8_t>(p.steps.size())};
    for (bool changes = true; changes;) {
        changes = false;
        for (std::size_t b = blocks.size(); b-- > 0;) {
            std::vector<bool> now(p.cells);
            for (const std::uint32_t next : blocks[b].next)
                for (std::uint32_t c = 0; c < p.cells; ++c)
                    now[c] = now[c] || made.before[next][c];
            made.behind[b] = now;
            for (std::uint32_t k = blocks[b].end; k-- > blocks[b].begin;) {
                Step& s = p.steps[k];
                const CellRange out = written(p, s);
                const bool is_taken = std::any_of(now.begin() + out.first, now.begin() + out.end(), std::identity{});
                if ((only_makes(p, s) && !is_taken) || (s.op == code::copy && s.out == s.a))
                    continue;
                made.needed[k] = 1;
                if (s.op != code::store_variable && s.op != code::from_block) // all of a block are taken at once
                    std::fill_n(now.begin() + out.first, out.count, false);
                each_operand(p, s, [&](const CellRange& operand) {
                    std::fill_n(now.begin() + operand.first, std::min(operand.count, p.cells - operand.first), true);
                });
            }
            if (now != made.before[b])
                made.before[b] = std::move(now), changes = true;
        }
    }
    return made;
}

/// Has what copy j of a block takes made where it is copied to, if that is free until then and nothing else is in the
/// way.
void make_in_place(Program& p, const StepBlock& block, const std::vector<bool>& behind, std::uint32_t j) {
    constexpr std::uint32_t most_cells = 64, most_steps = 512;
    const Step copy = p.steps[j];
    const CellRange from{copy.a, copy.n}, to{copy.out, copy.n};
    if (copy.n > most_cells || from.overlaps(to))
        return;
    // Back to where the first of it is made.
    std::vector<bool> made(from.count);
    std::uint32_t first = j;
    while (std::find(made.begin(), made.end(), false) != made.end()) {
        if (first == block.begin || j - first == most_steps)
            return;
        const CellRange out = written(p, p.steps[--first]);
        if (out.overlaps(to) || (out.overlaps(from) && (!from.holds(out) || p.steps[first].op == code::store_variable)))
            return;
        if (out.overlaps(from))
            std::fill_n(made.begin() + (out.first - from.first), out.count, true);
    }
    // On to where the last of it is taken.
    made.assign(from.count, false);
    std::vector<std::uint32_t*> moved;
    bool is_gone = false, is_free = true; // `from` is written again; all that takes it can take `to`
    std::uint32_t k = first;
    for (bool is_written_over = false; k < block.end && !is_gone && is_free; ++k) {
        Step& s = p.steps[k];
        const CellRange out = written(p, s);
        const bool is_before = k < j;
        each_operand(p, s, [&](const CellRange& operand) {
            if (operand.overlaps(from)) {
                bool is_known = operand.field != nullptr && from.holds(operand) && !is_written_over;
                for (std::uint32_t c = operand.first; is_known && is_before && c < operand.end(); ++c)
                    is_known = made[c - from.first];
                const bool is_same = operand.first - from.first + to.first == out.first && operand.count == out.count;
                is_free = is_free && is_known && (k <= j || !out.overlaps(to) || (is_same && is_by_component(s)));
                moved.push_back(operand.field);
            }
            if (is_before && operand.overlaps(to))
                is_free = is_free && k == first && is_by_component(s) && operand.holds(to) && to.holds(operand) &&
                          out.holds(from);
        });
        if (k == j)
            continue;
        is_written_over = is_written_over || (!is_before && out.overlaps(to));
        if (!out.overlaps(from))
            continue;
        if (is_before) {
            std::fill_n(made.begin() + (out.first - from.first), out.count, true);
            moved.push_back(&s.out);
        } else {
            is_gone = out.holds(from) && s.op != code::store_variable;
            is_free = is_free && is_gone;
        }
    }
    for (std::uint32_t c = from.first; c < from.end(); ++c)
        is_free = is_free && (is_gone || !behind[c]);
    if (!is_free)
        return;
    for (std::uint32_t* const field : moved)
        *field += to.first - from.first;
}

Program of_steps(const Program& from, const std::vector<std::uint8_t>& kept) {
    Program p = from;
    p.steps.clear(), p.lines.clear(), p.precise.clear(), p.in_place_of.clear();
    std::vector<std::uint32_t> number;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        number.push_back(static_cast<std::uint32_t>(p.steps.size()));
        if (kept[k] == 0)
            continue;
        p.steps.push_back(from.steps[k]);
        p.lines.push_back(from.lines[k]);
        p.precise.push_back(from.precise[k]);
        p.in_place_of.push_back(from.in_place_of[k]);
    }
    for (Step& s : p.steps)
        each_target(p, s, [&](std::uint32_t& to) { to = number[to]; });
    p.entry = number[p.entry];
    return p;
}

} // namespace

std::shared_ptr<const Program> with_fewer_copies(const Program& program) {
    constexpr std::size_t most = std::size_t{1} << 22U; // cells, each counted in each block
    if (program.stage != spv::ExecutionModelGLCompute || program.choice_line != 0 || program.are_quads)
        return nullptr;
    Program p = program;
    const std::vector<StepBlock> blocks = blocks_of(p);
    if (blocks.size() * p.cells > most)
        return nullptr;
    take_from_sources(p, blocks);
    const Liveness live = liveness_of(p, blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (std::uint32_t k = blocks[b].begin; k < blocks[b].end; ++k)
            if (p.steps[k].op == code::copy && live.needed[k] != 0)
                make_in_place(p, blocks[b], live.behind[b], k);
    const Liveness left = liveness_of(p, blocks);
    // Of variables, those alone are zero at first that some step may take so.
    const auto entry = std::ranges::find(blocks, p.entry, &StepBlock::begin);
    const std::vector<bool>& taken = left.before[static_cast<std::size_t>(entry - blocks.begin())];
    for (std::uint32_t c = p.variables; c-- > 0;)
        if (taken[c])
            p.initial.insert(p.initial.begin(), {c, 0, false});
    p.variables = 0;
    return std::make_shared<const Program>(of_steps(p, left.needed));
}

} // namespace lockstep::text
