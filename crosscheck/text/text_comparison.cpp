#include "crosscheck/text/text_comparison.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/group_witness.hpp"
#include "crosscheck/text/matched_names.hpp"
#include "crosscheck/text/word_comparison.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using Space = text::WrittenPlace::Space;

/// Vertices that each invocation of a geometry stage emitted, strip by strip.
std::vector<std::pair<std::uint32_t, std::uint32_t>> emitted(const text::StageResult& made) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (const text::StageResult::Strip& strip : made.strips)
        all.emplace_back(strip.invocation, strip.count);
    return all;
}

/// Both runs of the texts, and what goes with what.
class BothRuns {
  public:
    BothRuns(const StageText& text, const StageText& reference, const WatchedRun& run, const WatchedRun& expected,
             MatchedNames names)
        : text_(text), reference_(reference), run_(run), expected_(expected), names_(std::move(names)) {
        for (const text::StageResult::Strip& strip : expected.outputs.strips)
            emitted_by_.insert(emitted_by_.end(), strip.count, strip.invocation);
    }

    /// Storage blocks, images and outputs, by the reference's numbers.
    [[nodiscard]] std::vector<ComparedWords> compared() const {
        std::vector<std::span<const std::uint32_t>> words;
        for (const std::optional<std::size_t>& block : names_.blocks)
            words.push_back(block ? std::span<const std::uint32_t>(run_.world.words[run_.world.words_of_block(*block)])
                                  : std::span<const std::uint32_t>());
        for (const std::optional<std::size_t>& image : names_.images)
            words.push_back(image ? std::span<const std::uint32_t>(run_.world.words[run_.world.words_of_image(*image)])
                                  : std::span<const std::uint32_t>());
        std::vector<ComparedWords> all = compared_words(reference_.program, expected_.world, expected_.writers, words);
        const auto output_words = [](const WatchedRun& run, const text::StageVariable& output) {
            return std::span<const std::uint32_t>(run.outputs.outputs.at(text::name_of(output)));
        };
        for (std::size_t o = 0; o < names_.outputs.size(); ++o) {
            if (!names_.outputs[o])
                continue;
            const text::StageVariable& output = reference_.program.stage_outputs[o];
            all.push_back({{Space::output, 0, output.cell},
                           output_words(expected_, output),
                           output_words(run_, text_.program.stage_outputs[*names_.outputs[o]]),
                           {},
                           output.cells,
                           emitted_by_});
        }
        return all;
    }
    /// Where the text has a place of the reference's.
    [[nodiscard]] text::WrittenPlace own_place(const text::WrittenPlace& place) const {
        return names_.place(text_, reference_, place).value_or(place);
    }
    /// The invocation of the text that wrote a word last, by the reference's place.
    [[nodiscard]] std::optional<std::uint32_t> own_writer(const ComparedWord& word) const {
        const text::WrittenPlace place = own_place(word.place);
        if (place.space == Space::output)
            return word.invocation;
        const std::span<const std::uint32_t> by =
            writers(place.space == Space::block ? run_.writers.blocks : run_.writers.images, place.number);
        return place.word >= by.size() || by[place.word] == 0 ? std::nullopt : std::optional(by[place.word] - 1);
    }
    /// The same words seen from the text: what it has is expected, and what the reference has was got.
    [[nodiscard]] std::vector<ComparedWords> turned(std::span<const ComparedWords> all) const {
        std::vector<ComparedWords> from_text;
        for (const ComparedWords& one : all) {
            ComparedWords other = one;
            other.place = own_place(one.place);
            std::swap(other.expected, other.got);
            if (one.place.space != Space::output)
                other.writers = writers(one.place.space == Space::block ? run_.writers.blocks : run_.writers.images,
                                        other.place.number);
            from_text.push_back(other);
        }
        return from_text;
    }
    [[nodiscard]] const MatchedNames& names() const { return names_; }

  private:
    static std::span<const std::uint32_t> writers(const std::vector<std::vector<std::uint32_t>>& all,
                                                  std::size_t number) {
        return number < all.size() ? std::span<const std::uint32_t>(all[number]) : std::span<const std::uint32_t>();
    }

    const StageText& text_;
    const StageText& reference_;
    const WatchedRun& run_;
    const WatchedRun& expected_;
    MatchedNames names_;
    std::vector<std::uint32_t> emitted_by_; ///< of each vertex of a geometry stage
};

PassStage pass_stage(spv::ExecutionModel stage) {
    return stage == spv::ExecutionModelGLCompute ? PassStage::compute
           : stage == spv::ExecutionModelVertex  ? PassStage::vertex
                                                 : PassStage::fragment;
}

/// What GLSL alone says of what computes the text.
JudgedBy judged_by(const text::Program& reference, std::size_t most) {
    const Profile& profile = examined_profile();
    const KnownOperations glsl{.converts = profile.converts};
    const PassStage stage = pass_stage(reference.stage);
    return {.stage = stage,
            .known = stage == PassStage::compute    ? in_compute_stage(glsl, profile)
                     : stage == PassStage::fragment ? in_fragment_stage(glsl)
                                                    : glsl,
            .most = most,
            .why_not =
                reference.stage == spv::ExecutionModelGeometry ? "a geometry stage is not followed by sets" : ""};
}

/// "today.comp:12, invocation 3: Out.x[7]: expected ..., got ..."
std::string line_of(const StageText& text, const BoundStage& stage, const BothRuns& both, const ComparedWord& one) {
    const text::WrittenPlace place = both.own_place(one.place);
    const std::optional<std::uint32_t> by = both.own_writer(one);
    std::string where;
    if (by) {
        const std::optional<std::string> line = stage.line_of(*by, place);
        where = fmt::format("{}invocation {}: ", line ? *line + ", " : "", *by);
    }
    const NamedWord word = named_word(text, stage.bindings, place);
    return fmt::format("{}{}: {}{}", where, word.name, both_values(one, word.is_real, "got"),
                       by && !one.invocation ? "; the reference writes nothing there"
                       : !by && one.invocation
                           ? fmt::format("; invocation {} of the reference writes there", *one.invocation)
                           : "");
}

/// Invocations that wrote words which differ, and such as wrote the same; a few of each, from all over.
struct SomeWriters {
    std::vector<ItemWriters> wrong, right;
};

template <class T> std::vector<T> some_of(const std::vector<T>& all) {
    constexpr std::size_t most = 10;
    std::vector<T> some;
    for (std::size_t k = 0; k < std::min(most, all.size()); ++k)
        some.push_back(all[k * all.size() / std::min(most, all.size())]);
    return some;
}

SomeWriters some_writers(const BothRuns& both, std::span<const ComparedWords> all, const WordComparison& compared) {
    using Pair = std::pair<std::optional<std::uint32_t>, std::optional<std::uint32_t>>; // writers in both texts
    std::set<Pair> wrong, differing, right;
    for (const ComparedWord& word : compared.wrong.empty() ? compared.unjudged : compared.wrong)
        wrong.emplace(both.own_writer(word), word.invocation);
    for (const ComparedWords& one : all)
        for (std::size_t w = 0; w < one.expected.size(); ++w) {
            const ComparedWord word = one.word(w);
            (word.expected == word.got ? right : differing).emplace(both.own_writer(word), word.invocation);
        }
    const auto listed = [](const std::set<Pair>& from, const std::set<Pair>& without) {
        std::vector<ItemWriters> some;
        for (const Pair& by : from)
            if ((by.first || by.second) && !without.contains(by))
                some.push_back({by.first, by.second});
        return some_of(some);
    };
    return {listed(wrong, {}), listed(right, differing)};
}

/// How many words either text wrote; what atomic operations write shows by its change.
std::size_t written_words(const BothRuns& both, std::span<const ComparedWords> all, const MadeUpWorld& before) {
    std::size_t written = 0;
    for (const ComparedWords& one : all) {
        if (one.place.space == Space::output) {
            written += one.expected.size();
            continue;
        }
        const std::vector<std::uint32_t>& start =
            before.words[(one.place.space == Space::block ? 0 : before.bindings.blocks.size()) + one.place.number];
        for (std::size_t w = 0; w < one.expected.size(); ++w) {
            const ComparedWord word = one.word(w);
            if (word.invocation || both.own_writer(word) || word.expected != start[w] || word.got != start[w])
                ++written;
        }
    }
    return written;
}

/// Whether arrays or images hold integers, which are 0 unless --integers is given.
bool holds_integers(const text::Program& program) {
    return std::ranges::any_of(program.blocks,
                               [](const text::Block& block) {
                                   return std::ranges::any_of(block.element,
                                                              [](const text::Leaf& leaf) { return !leaf.is_real; });
                               }) ||
           std::ranges::any_of(program.images, [](const text::ImageUniform& image) { return !image.is_real; });
}

std::vector<std::uint32_t> all_invocations(const BoundStage& of) {
    std::vector<std::uint32_t> all(std::size_t{of.program.invocations()} * of.groups[0] * of.groups[1] * of.groups[2]);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

/// Lines of the text that have no counterpart in the reference.
std::vector<WitnessLine> lines_of(const StageText& text, const StageText& reference, const BothRuns& both,
                                  const BoundStage& own, const BoundStage& right, std::span<const ComparedWords> all,
                                  const WordComparison& compared,
                                  const std::function<bool(std::string_view where)>& is_own) {
    SomeWriters some = some_writers(both, all, compared);
    if (some.wrong.empty() && own.run == nullptr) // what several change: some of all
        for (const std::uint32_t one : some_of(all_invocations(own)))
            some.wrong.push_back({one, one});
    const auto common = [&](const text::WrittenPlace& place) { return both.names().place(text, reference, place); };
    if (shares(text.program) || shares(reference.program))
        return group_witness_lines({own, *text.source}, {right, *reference.source}, some.wrong, some.right, common,
                                   is_own);
    const auto runs_of = [](const BoundStage& bound) {
        return [&bound](std::uint32_t invocation, std::span<const text::ForcedRow> forced) {
            return bound.traced(invocation, forced);
        };
    };
    return witness_lines({text.program, runs_of(own),
                          [](const text::WrittenPlace& place) { return std::optional(place); }, *text.source},
                         {reference.program, runs_of(right), common, *reference.source}, some.wrong, some.right,
                         is_own);
}

} // namespace

TextComparison compare_texts(const Examination& of, const StageText& text, const StageText& reference,
                             const MadeUpWorld& world, const text::StageRun& stage, const WatchedRun& run,
                             const HostedTexts* hosted) {
    constexpr std::size_t most_lines = 3;
    TextComparison made;
    made.reference = reference.file;
    MatchedNames names = matched_names(of, text, reference, hosted != nullptr);
    const MadeUpWorld before =
        world_of_reference(of, names, text, reference, world, hosted != nullptr ? hosted->reference : nullptr);
    const bool is_compute = reference.program.stage == spv::ExecutionModelGLCompute;
    const text::StageRun expected_stage = is_compute ? text::StageRun{} : run_of_reference(of, reference, stage);
    Examination of_reference = of;
    for (std::size_t axis = 0; axis < 3; ++axis) { // as many invocations, in groups of its size
        const std::uint32_t size = reference.program.group[axis];
        of_reference.groups[axis] = (of.groups[axis] * text.program.group[axis] + size - 1) / size;
    }
    const WatchedRun expected = run_watched(of_reference, reference.program, before.copy(), expected_stage);
    made.findings = named(expected.findings, reference.program);
    if (is_endless(run.findings) || is_endless(expected.findings)) {
        made.not_compared = "a loop does not end";
        return made;
    }
    const BothRuns both(text, reference, run, expected, std::move(names));
    if (emitted(run.outputs) != emitted(expected.outputs)) {
        made.differing = 1;
        made.first.push_back(fmt::format("{} vertices in {} strips are emitted; expected {} in {}",
                                         run.outputs.vertices, run.outputs.strips.size(), expected.outputs.vertices,
                                         expected.outputs.strips.size()));
        return made;
    }
    const std::vector<ComparedWords> all = both.compared();
    made.written = written_words(both, all, before);
    if (made.written == 0)
        throw Error(
            fmt::format("{}: neither it nor {} writes anything with these inputs; expected --uniform, --size or "
                        "--groups with which they do",
                        text.file, reference.file));
    const auto stage_of_run = [&](const StageText& one, const MadeUpWorld& from, const Examination& by,
                                  const text::StageRun& how) {
        return BoundStage{one.program, from.bindings, examined_profile(), by.groups, is_compute ? nullptr : &how};
    };
    const BoundStage own = stage_of_run(text, world, of, stage),
                     right = stage_of_run(reference, before, of_reference, expected_stage);
    constexpr std::size_t most_judged = 20'000, enough_for_lines = 2'000;
    WordComparison compared =
        compare_words(right, all, judged_by(reference.program, hosted != nullptr ? enough_for_lines : most_judged));
    if (hosted != nullptr) { // what the text itself leaves open is no mistake of its
        const auto key = [](const ComparedWord& word, const text::WrittenPlace& place) {
            return std::pair(place, place.space == Space::output ? word.invocation : std::nullopt);
        };
        const WordComparison by_text = compare_words(own, both.turned(all), judged_by(text.program, enough_for_lines));
        std::set<std::pair<text::WrittenPlace, std::optional<std::uint32_t>>> mistakes;
        for (const auto* const words : {&by_text.wrong, &by_text.unjudged})
            for (const ComparedWord& word : *words)
                mistakes.insert(key(word, word.place));
        compared.legal += std::erase_if(compared.wrong, [&](const ComparedWord& word) {
            return !mistakes.contains(key(word, both.own_place(word.place)));
        });
    }
    made.words = compared.words;
    made.differing = compared.differing;
    made.legal = compared.legal;
    made.by_bits = compared.unjudged.size();
    made.by_bits_for = compared.unjudged_for;
    for (const auto* const words : {&compared.wrong, &compared.unjudged})
        for (const ComparedWord& one : first_of_each(*words, most_lines - made.first.size()))
            made.first.push_back(line_of(text, own, both, one));
    if (made.differing > made.legal) {
        made.lines = lines_of(
            text, reference, both, own, right, all, compared,
            hosted != nullptr ? hosted->is_own : [](std::string_view) { return true; });
    } else if (of.integers == 0 && holds_integers(text.program)) {
        made.weak = "integers of arrays and images are 0; --integers 100 makes up others";
    }
    return made;
}

std::string TextComparison::verdict() const {
    return differing == 0 ? "AGREE" : differing == legal ? "LEGAL" : "DIVERGENT";
}

std::string TextComparison::text(std::size_t found) const {
    std::string all;
    for (const NamedFinding& one : findings)
        all += "in the reference: " + one.text();
    if (!not_compared.empty())
        return all + fmt::format("not compared with {}: {}\n", reference, not_compared);
    const std::size_t mistakes = found + findings.size();
    const std::string but = mistakes == 0 || differing > legal
                                ? ""
                                : fmt::format(", but {} finding{} above: no pass", mistakes, mistakes == 1 ? "" : "s");
    if (differing == 0)
        all += fmt::format("verdict   AGREE{}: all {} words are those of {}; {} are written\n", but, words, reference,
                           written);
    else if (differing == legal)
        all += fmt::format("verdict   LEGAL{}: {} of {} words differ from {}, as its text allows\n", but, differing,
                           words, reference);
    else if (words == 0)
        all += fmt::format("verdict   DIVERGENT: other vertices than those of {}\n", reference);
    else
        all += fmt::format("verdict   DIVERGENT: {} of {} words differ from {}: {} as its text allows, {} as it does "
                           "not\n",
                           differing, words, reference, legal, differing - legal);
    for (const std::string& line : first)
        all += fmt::format("differs   {}\n", line);
    for (const WitnessLine& line : lines)
        all += fmt::format("note      without a counterpart in the reference: {}\n", plain_line(line_of(line)));
    if (by_bits > 0)
        all += fmt::format("note      {} words are held to the reference's bits: {}\n", by_bits, by_bits_for);
    if (!weak.empty())
        all += fmt::format("note      {}\n", weak);
    return all;
}

nlohmann::json TextComparison::json() const {
    nlohmann::json all{{"file", reference}, {"findings", nlohmann::json::array()}};
    for (const NamedFinding& one : findings)
        all["findings"].push_back(one.json());
    if (!not_compared.empty()) {
        all["not_compared"] = not_compared;
        return all;
    }
    all["verdict"] = verdict();
    all["words"] = words;
    all["written"] = written;
    all["differing"] = differing;
    all["legal"] = legal;
    all["by_bits"] = by_bits;
    if (!by_bits_for.empty())
        all["by_bits_for"] = by_bits_for;
    if (!weak.empty())
        all["weak"] = weak;
    all["first"] = first;
    all["without_counterpart"] = nlohmann::json::array();
    for (const WitnessLine& line : lines)
        all["without_counterpart"].push_back({{"where", line.where}, {"text", line.text}, {"what", line.what}});
    return all;
}

} // namespace lockstep
