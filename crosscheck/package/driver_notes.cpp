#include "crosscheck/package/driver_notes.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/report/value_text.hpp"
#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/faulty_operation.hpp"
#include "crosscheck/text/text_pass.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// An item that the GPU made otherwise than its text says.
struct Departure {
    std::size_t item = 0;
    std::size_t component = 0;
    std::uint32_t by_text = 0, by_gpu = 0;
};

/// Of a divergent item: what the GPU has lies in none of its text's outcomes, or the text makes what the reference
/// does.
std::optional<Departure> departure(const JudgedPass& judged, const TextDispatch& dispatch, std::size_t item) {
    const std::uint8_t r = judged.pass.resource();
    const View before = judged.before[r];
    const std::vector<std::uint32_t> gpu = item_words(judged.gpu, item), text = dispatch.words(before, r, item);
    const auto differs = std::ranges::mismatch(gpu, text);
    if (differs.in1 == gpu.end() || !dispatch.writer(r, item)) // of several that write it any may be the last
        return {};
    // A twin has said what is legal; a text that is the reference has no sites, and may say nothing.
    const bool has_twin = !judged.pass.sites(judged.input(), item, judged.profile).empty();
    if (!has_twin || text != item_words(judged.reference, item)) {
        // Where sets are not followed, other bits than the text's may be as legal.
        const std::vector<ItemOutcome> outcomes = dispatch.outcomes(before, r, item, judged.known);
        if (outcomes.empty() || std::ranges::any_of(outcomes, [&](const ItemOutcome& outcome) {
                return outcome.contains(gpu, judged.gpu.about());
            }))
            return {};
    }
    return Departure{item, static_cast<std::size_t>(differs.in1 - gpu.begin()), *differs.in2, *differs.in1};
}

/// "velocity.y is -0.25 by the text, -0.5 on the GPU".
std::string words_of(const JudgedPass& judged, const Departure& one) {
    const Resource& about = judged.gpu.about();
    const Component part = components(about)[one.component];
    const Field& field = about.fields[part.field];
    return fmt::format("{} {} is {} by the text, {} on the GPU", item_name(about, judged.gpu.extent, one.item),
                       component_name(field, part.component), decimal_text({field.scalar, one.by_text}),
                       decimal_text({field.scalar, one.by_gpu}));
}

/// Under a note's words.
std::string indented(const std::string& text) {
    constexpr std::string_view margin = "            ";
    std::string all(margin);
    for (const char c : text.substr(0, text.find_last_not_of('\n') + 1))
        all += c == '\n' ? fmt::format("\n{}", margin) : std::string(1, c);
    return all;
}

} // namespace

std::vector<std::string> driver_notes(const ShadedSystem& of, const OwnTexts& own, const std::filesystem::path& shaders,
                                      const std::vector<ShortFinding>& findings, DivergentPass& divergence) try {
    if (!divergence.pass())
        return {};
    const std::size_t p = *divergence.pass();
    if (std::ranges::find(findings, p, &ShortFinding::pass) != findings.end())
        return {};
    const bool is_read = p < own.size() && own[p] != nullptr;
    const std::shared_ptr<const PassText> text = is_read ? own[p] : text_of_pass(of, p, shaders);
    if (text == nullptr)
        return {};
    const JudgedPass judged = divergence.judged();
    const TextDispatch dispatch(*text, judged.input(), judged.profile);
    std::vector<Departure> departed;
    const std::vector<std::size_t>& items = divergence.items().wrong;
    for (const std::size_t item : items)
        if (const std::optional<Departure> one = departure(judged, dispatch, item))
            departed.push_back(*one);
    if (2 * departed.size() <= items.size())
        return {};
    std::vector<std::string> notes{
        fmt::format("driver: {} of {} items looked at are not what {} says, run by lockstep: {}", departed.size(),
                    items.size(), plain_line(text->source().files.front()), words_of(judged, departed.front()))};
    const BoundStage stage{text->program(), dispatch.input().bindings, judged.profile, dispatch.input().groups,
                           text->is_per_item() ? &dispatch.input().stage : nullptr};
    std::vector<text::Trace> traces;
    for (const Departure& one : departed)
        if (const auto by = dispatch.writer(judged.pass.resource(), one.item)) {
            traces.emplace_back();
            trace_alone(stage, *by, traces.back());
        }
    if (const auto fault =
            faulty_operation({divergence.side().describe().name, judged.profile}, text->program(), traces))
        notes.push_back(fmt::format("driver: {}: {}; this stage shows it alone:\n{}", plain_line(fault->where),
                                    fault->words, indented(fault->repro)));
    else
        notes.push_back("driver: alone, it makes each operation of these items as expected: look at what it reads and "
                        "writes, at barriers and formats");
    return notes;
} catch (const Error&) {
    return {}; // the notes of the text say what is not run
}

} // namespace lockstep
