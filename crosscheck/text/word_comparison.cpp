#include "crosscheck/text/word_comparison.hpp"

#include <algorithm>
#include <bit>
#include <map>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/text/outcomes.hpp"
#include "reference/text/trace.hpp"

namespace lockstep {
namespace {

using Space = text::WrittenPlace::Space;
using ByInvocation = std::map<std::optional<std::uint32_t>, std::vector<ComparedWord>>;

/// Words that differ, by the one invocation that wrote each last in the text.
ByInvocation differing_words(std::span<const ComparedWords> all, WordComparison& counts) {
    ByInvocation differing;
    for (const ComparedWords& one : all) {
        counts.words += one.expected.size();
        for (std::size_t w = 0; w < one.expected.size(); ++w) {
            const std::uint32_t a = one.expected[w], b = one.got[w];
            if (a == b)
                continue;
            ++counts.differing;
            const ComparedWord word = one.word(w);
            differing[word.invocation].push_back(word);
        }
    }
    return differing;
}

/// Whether one of an invocation's outcomes has all of its words. Throws Error for what is not followed by sets.
bool allows(const BoundStage& text, const text::DispatchOutcomes& outcomes, std::uint32_t invocation,
            std::span<const ComparedWord> words) {
    const std::vector<text::InvocationOutcome> all = outcomes.of(text.invocation(invocation), text.inputs(invocation));
    return std::ranges::any_of(all, [&](const text::InvocationOutcome& outcome) {
        return outcome.undefined != Undefined::none || std::ranges::all_of(words, [&](const ComparedWord& one) {
                   const auto word = std::ranges::find(outcome.written, one.place, &text::WrittenWord::place);
                   return word != outcome.written.end() && word->may_be(one.got);
               });
    });
}

std::string with_bits(std::uint32_t bits, bool is_real) {
    return fmt::format("{} ({:#010x})", text::value_text(bits, is_real), bits);
}

} // namespace

ComparedWord ComparedWords::word(std::size_t number) const {
    ComparedWord word{place, {}, expected[number], got[number]};
    word.place.word += cells > 0 ? number % cells : number;
    if (cells > 0)
        word.invocation = emitted_by.empty() ? static_cast<std::uint32_t>(number / cells) : emitted_by[number / cells];
    else if (number < writers.size() && writers[number] != 0)
        word.invocation = writers[number] - 1;
    return word;
}

std::vector<ComparedWords> compared_words(const text::Program& program, const MadeUpWorld& expected,
                                          const text::Writers& writers,
                                          std::span<const std::span<const std::uint32_t>> got) {
    std::vector<ComparedWords> all;
    const auto add = [&](Space space, std::uint32_t number, std::size_t words,
                         const std::vector<std::vector<std::uint32_t>>& by) {
        if (got[words].size() != expected.words[words].size()) // the text has it not
            return;
        all.push_back({{space, number, 0}, expected.words[words], got[words], {}, 0, {}});
        if (number < by.size())
            all.back().writers = by[number];
    };
    for (std::uint32_t b = 0; b < program.blocks.size(); ++b)
        if (program.blocks[b].is_storage && expected.words_of_block(b) == b)
            add(Space::block, b, b, writers.blocks);
    for (std::uint32_t i = 0; i < program.images.size(); ++i)
        if (program.images[i].is_storage && expected.words_of_image(i) == program.blocks.size() + i)
            add(Space::texel, i, program.blocks.size() + i, writers.images);
    return all;
}

WordComparison compare_words(const BoundStage& text, std::span<const ComparedWords> all, const JudgedBy& by) {
    WordComparison made;
    const ByInvocation differing = differing_words(all, made);
    if (!by.judges)
        return made;
    const text::Outcomes by_text(text.program);
    const text::DispatchOutcomes outcomes(by_text, text.bindings, {text.groups, by.stage, text.profile, by.known});
    std::size_t judged = 0;
    for (const auto& [invocation, words] : differing) {
        try {
            if (invocation && !by.why_not.empty())
                throw Error(by.why_not);
            if (invocation && judged++ == by.most)
                throw Error(fmt::format("they are of more than {} invocations", by.most));
            if (invocation && allows(text, outcomes, *invocation, words)) {
                made.legal += words.size();
                continue;
            }
            made.wrong.insert(made.wrong.end(), words.begin(), words.end());
        } catch (const Error& error) {
            made.unjudged.insert(made.unjudged.end(), words.begin(), words.end());
            if (made.unjudged_for.empty())
                made.unjudged_for = error.what();
            judged = by.most; // the rest is likely the same
        }
    }
    return made;
}

std::vector<ComparedWord> first_of_each(std::span<const ComparedWord> words, std::size_t most) {
    std::vector<ComparedWord> first;
    for (const ComparedWord& one : words)
        if (first.size() < most && (first.empty() || first.back().invocation != one.invocation))
            first.push_back(one);
    return first;
}

std::string both_values(const ComparedWord& word, bool is_real, std::string_view other) {
    return fmt::format("expected {}, {} {}", with_bits(word.expected, is_real), other, with_bits(word.got, is_real));
}

} // namespace lockstep
