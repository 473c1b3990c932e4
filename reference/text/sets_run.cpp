#include "reference/text/sets_run.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "reference/stored_half.hpp"
#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_apart.hpp"
#include "reference/text/machine_flow.hpp"

namespace lockstep::text {

namespace {

constexpr std::uint32_t most_branches = 200'000; // each way comes by them again

FlushSubnormals flushing(PassStage stage, const Profile& profile, const KnownOperations& known) {
    const bool is_compute = stage == PassStage::compute;
    const bool operands = is_compute ? profile.compute_flush_subnormals : profile.flush_subnormals;
    return {known.subnormals && operands,
            known.subnormals && (is_compute ? profile.compute_flush_results.value_or(operands) : operands)};
}

std::vector<OpenSite> open_sites(std::span<const Fork> forks) {
    std::vector<OpenSite> open;
    for (const Fork& fork : forks)
        for (const OpenDecision& decision : fork.decisions)
            if (decision.site != nullptr)
                open.push_back({decision.site->label, decision.site->unit, decision.margin});
    return open;
}

bool is_equal(const InvocationOutcome& a, const InvocationOutcome& b) {
    const auto key = [](const WrittenWord& w) {
        return std::tuple(w.place, w.is_real || w.is_code ? 0U : w.word, w.more, w.set.low, w.set.high, w.set.any);
    };
    return a.undefined == b.undefined &&
           std::ranges::equal(a.written, b.written, [&](const auto& x, const auto& y) { return key(x) == key(y); });
}

/// What a run returns to Worlds.
struct Written {
    const WrittenWords<TextWorlds>* words;
    [[nodiscard]] std::size_t size() const { return words->size(); }
    template <class Visit> void for_each(const Visit& visit) const {
        for (const auto& [place, cell] : *words)
            if (cell.is_real)
                visit(cell.x);
    }
};

/// What is stored in the image: of a half or a code either neighbour of what is no such number (GL 4.6, 2.3.5).
WrittenWord stored(WrittenWord word, const TexelMemory& image) {
    Interval& set = word.set;
    if (image.code == TexelMemory::Code::half && word.is_real) {
        set = stored_half(set, HalfStore::open);
    } else if (image.code == TexelMemory::Code::unorm8) {
        const auto code = [](double x) { return 255.0 * std::clamp(x, 0.0, 1.0); };
        const bool is_open = set.any || std::isnan(set.low); // NaN becomes any code
        word.word = 0;
        set = is_open ? Interval{0.0, 255.0} : Interval{std::floor(code(set.low)), std::ceil(code(set.high))};
        word.is_real = false;
        word.is_code = true;
    }
    return word;
}

} // namespace

SetsRun::SetsRun(const Program& program, std::array<std::uint32_t, 3> groups, const Bindings& bindings, PassStage stage,
                 const Profile& profile, const KnownOperations& known, Constants constants,
                 std::span<const Site* const> sites)
    : flushes_(flushing(stage, profile, known)), worlds_(profile, known), memory_(program, bindings, ignored_, nullptr),
      machine(worlds_, program, memory_, bindings, groups, most_branches) {
    if (constants == Constants::as_written)
        worlds_.take_constants_as_written();
    if (profile.roots != nullptr)
        worlds_.take_roots_by_tables();
    if (!profile.follows(stage == PassStage::compute ? "compute: a/c, c constant" : "a/c, c constant, precise"))
        worlds_.open_constant_divisors();
    machine.keep(written, sites);
}

void SetsRun::ways(const Invocation& invocation, std::span<const GivenInput> inputs, const std::function<void()>& begin,
                   const std::function<void(bool, std::span<const Fork>, Undefined)>& ended, int most) {
    int runs = 0;
    worlds_.run(
        [&] {
            written.clear();
            begin();
            if (++runs > most)
                worlds_.end(Undefined::undecided);
            machine.start({&invocation, 1});
            for (const GivenInput& one : inputs)
                machine.give(*one.input, 0, one.words);
            machine.run();
            if (machine.is_discarded(0))
                written.clear();
            return Written{&written};
        },
        [&](const Written* at_end, std::span<const Fork> forks, Undefined undefined) {
            ended(at_end != nullptr, forks, undefined);
        });
}

WrittenWord written_word(const WrittenPlace& place, const Cell<TextWorlds>& cell) {
    const Interval set = cell.is_real ? cell.x.legal() : Interval();
    return {place, cell.is_real ? std::bit_cast<std::uint32_t>(set.as_float()) : cell.w, cell.is_real ? 0 : cell.more,
            set, cell.is_real};
}

InvocationOutcome outcome_of(const WrittenWords<TextWorlds>& written, const Bindings& bindings,
                             std::span<const Fork> forks, Undefined undefined) {
    InvocationOutcome one{.written = {}, .open = open_sites(forks), .undefined = undefined};
    for (const auto& [place, cell] : written) {
        if (place.is_of_group())
            continue;
        WrittenWord word = written_word(place, cell);
        one.written.push_back(place.space == WrittenPlace::Space::texel
                                  ? stored(std::move(word), bindings.images[place.number])
                                  : std::move(word));
    }
    return one;
}

void add_outcome(InvocationOutcome one, std::vector<InvocationOutcome>& found) {
    for (InvocationOutcome& other : found)
        if (is_equal(other, one)) {
            if (one.open.size() < other.open.size())
                other = std::move(one);
            return;
        }
    found.push_back(std::move(one));
}

} // namespace lockstep::text
