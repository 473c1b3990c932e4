#include "reference/text/outcomes.hpp"

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "reference/system/item_twin.hpp"
#include "reference/text/sets_run.hpp"

namespace lockstep::text {
namespace {

/// The same text, for as long as the program runs: reports outlive the texts that they are of.
std::string_view kept(std::string label) {
    static std::mutex mutex;
    static std::set<std::string> labels;
    const std::scoped_lock lock(mutex);
    return *labels.insert(std::move(label)).first;
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
    SetsRun run(program_, groups, bindings, stage, profile, known, constants, site_of_step_);
    std::vector<InvocationOutcome> found;
    run.ways(
        invocation, inputs, [] {},
        [&](bool is_at_end, std::span<const Fork> forks, Undefined undefined) {
            if (!is_at_end)
                run.written.clear();
            add_outcome(outcome_of(run.written, bindings, forks, undefined), found);
        });
    return found;
}

} // namespace lockstep::text
