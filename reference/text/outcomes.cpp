#include "reference/text/outcomes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "reference/stored_half.hpp"
#include "reference/subnormals.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_apart.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/text_worlds.hpp"

namespace lockstep::text {
namespace {

using SetsMachine = Machine<TextWorlds, 1>;

/// What a run returns to Worlds.
struct Ended {
    const WrittenWords<TextWorlds>* written;
    [[nodiscard]] std::size_t size() const { return written->size(); }
    template <class Visit> void for_each(const Visit& visit) const {
        for (const auto& [place, cell] : *written)
            if (cell.is_real)
                visit(cell.x);
    }
};

std::vector<OpenSite> open_sites(std::span<const Fork> forks) {
    std::vector<OpenSite> open;
    for (const Fork& fork : forks)
        for (const OpenDecision& decision : fork.decisions)
            if (decision.site != nullptr)
                open.push_back({decision.site->label, decision.site->unit, decision.margin});
    return open;
}

/// The same text, for as long as the program runs: reports outlive the texts that they are of.
std::string_view kept(std::string label) {
    static std::mutex mutex;
    static std::set<std::string> labels;
    const std::scoped_lock lock(mutex);
    return *labels.insert(std::move(label)).first;
}

bool is_equal(const InvocationOutcome& a, const InvocationOutcome& b) {
    const auto key = [](const WrittenWord& w) {
        return std::tuple(w.place, w.is_real || w.is_code ? 0U : w.word, w.more, w.set.low, w.set.high, w.set.any);
    };
    return a.undefined == b.undefined &&
           std::ranges::equal(a.written, b.written, [&](const auto& x, const auto& y) { return key(x) == key(y); });
}

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

bool WrittenWord::may_be(std::uint32_t bits) const {
    if (is_code)
        return set.contains(static_cast<float>(bits));
    return is_real ? set.contains(std::bit_cast<float>(bits)) : WordRange{word, more}.contains(bits);
}

Interval WrittenWord::set_in(Scalar field) const {
    const std::optional<WordRange> words = is_real ? word_range::bits(set) : WordRange{word, more};
    if (field == Scalar::float32)
        return is_real ? set : word_range::floats(*words).value_or(Interval::anything());
    if (!words || !(field == Scalar::int32 ? words->is_signed() : words->is_unsigned()))
        return Interval::anything();
    return interval::hull(item_twin::set_of(words->first, field), item_twin::set_of(words->last(), field));
}

Outcomes::Outcomes(const Program& program) : program_(program) {
    std::map<std::uint32_t, std::size_t> numbers;
    for (const std::uint32_t line : program.lines)
        if (numbers.emplace(line, numbers.size()).second)
            sites_.push_back(Site::named(kept(program.line_name(line))));
    for (const std::uint32_t line : program.lines)
        site_of_step_.push_back(&sites_[numbers.at(line)]);
}

std::vector<InvocationOutcome> Outcomes::of(const Invocation& invocation, std::array<std::uint32_t, 3> groups,
                                            const Bindings& bindings, PassStage stage, const Profile& profile,
                                            const KnownOperations& known, Constants constants,
                                            std::span<const GivenInput> inputs) const {
    const bool is_compute = stage == PassStage::compute;
    const bool flushes_operands = is_compute ? profile.compute_flush_subnormals : profile.flush_subnormals;
    const FlushSubnormals guard{
        known.subnormals && flushes_operands,
        known.subnormals && (is_compute ? profile.compute_flush_results.value_or(flushes_operands) : flushes_operands)};
    TextWorlds worlds(profile, known);
    if (constants == Constants::as_written)
        worlds.take_constants_as_written();
    if (profile.roots != nullptr)
        worlds.take_roots_by_tables();
    if (!profile.follows(is_compute ? "compute: a/c, c constant" : "a/c, c constant, precise"))
        worlds.open_constant_divisors();
    Findings ignored;
    Memory memory(program_, bindings, ignored, nullptr);
    WrittenWords<TextWorlds> written;
    constexpr std::uint32_t most_branches = 200'000; // each way comes by them again
    SetsMachine run(worlds, program_, memory, bindings, groups, most_branches);
    run.keep(written, site_of_step_);
    std::vector<InvocationOutcome> found;
    worlds.run(
        [&] {
            written.clear();
            run.start({&invocation, 1});
            for (const GivenInput& one : inputs)
                run.give(*one.input, 0, one.words);
            run.run();
            if (run.is_discarded(0))
                written.clear();
            return Ended{&written};
        },
        [&](const Ended* ended, std::span<const Fork> forks, Undefined undefined) {
            InvocationOutcome one{.written = {}, .open = open_sites(forks), .undefined = undefined};
            if (ended != nullptr)
                for (const auto& [place, cell] : written) {
                    if (place.space == WrittenPlace::Space::shared)
                        continue;
                    const Interval set = cell.is_real ? cell.x.legal() : Interval();
                    WrittenWord word{place, cell.is_real ? std::bit_cast<std::uint32_t>(set.as_float()) : cell.w,
                                     cell.is_real ? 0 : cell.more, set, cell.is_real};
                    one.written.push_back(place.space == WrittenPlace::Space::texel
                                              ? stored(std::move(word), bindings.images[place.number])
                                              : std::move(word));
                }
            for (InvocationOutcome& other : found)
                if (is_equal(other, one)) {
                    if (one.open.size() < other.open.size())
                        other = std::move(one);
                    return;
                }
            found.push_back(std::move(one));
        });
    return found;
}

} // namespace lockstep::text
