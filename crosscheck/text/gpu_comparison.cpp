#include "crosscheck/text/gpu_comparison.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "gpu/lone_dispatch.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/error.hpp"
#include "reference/text/dispatch.hpp"
#include "reference/text/outcomes.hpp"
#include "reference/text/trace.hpp"

namespace lockstep {
namespace {

using Space = text::WrittenPlace::Space;

/// The schema of the images, of those formats that a state has. Throws Error for others.
Schema images_of(const text::Program& program, const text::Bindings& bindings) {
    Schema schema{"images", {}};
    for (std::size_t i = 0; i < program.images.size(); ++i) {
        const text::ImageUniform& image = program.images[i];
        if (image.shape.is_arrayed || image.shape.has_samples ||
            (image.shape.dimensions != spv::Dim2D && image.shape.dimensions != spv::Dim3D))
            throw Error(fmt::format("{}: only images of two and three dimensions are given to GL", image.name));
        const std::string format = format_of(image).name;
        if (format.empty())
            throw Error(fmt::format("{}: an image of its format is not given to GL", image.name));
        const text::TexelMemory& texels = bindings.images[i];
        for (std::size_t k = 0; k < i; ++k)
            if (bindings.images[k].words.data() == texels.words.data())
                throw Error(fmt::format("{} and {}: two images of one unit are not given to GL", program.images[k].name,
                                        image.name));
        const Scalar scalar = texels.code == text::TexelMemory::Code::unorm8 ? Scalar::uint32
                              : image.is_real                                ? Scalar::float32
                              : image.is_signed                              ? Scalar::int32
                                                                             : Scalar::uint32;
        schema.resources.push_back(
            {.name = image.name,
             .item = "texel",
             .title = image.name,
             .fields = {{fmt::format("texel{}", i), scalar, static_cast<int>(texels.components)}},
             .dimensions = image.shape.dimensions == spv::Dim3D ? 3 : 2,
             .format = format});
    }
    return schema;
}

/// What the driver leaves of a world, block after block and image after image.
MadeUpWorld on_gl(const ShaderSource& source, const text::Program& program, const std::array<std::uint32_t, 3>& groups,
                  const MadeUpWorld& world) {
    MadeUpWorld made = world.copy();
    LoneDispatch dispatch;
    dispatch.groups = groups;
    const std::size_t blocks = program.blocks.size();
    dispatch.buffers.assign(made.words.begin(), made.words.begin() + static_cast<std::ptrdiff_t>(blocks));
    for (std::size_t b = 0; b < blocks; ++b)
        dispatch.blocks.push_back({program.blocks[b].name, program.blocks[b].is_storage, world.words_of_block(b)});
    for (std::size_t u = 0; u < program.uniforms.size(); ++u)
        dispatch.uniforms.push_back({program.uniforms[u].name, world.bindings.uniforms[u]});
    const Schema schema = images_of(program, world.bindings);
    if (!schema.resources.empty()) {
        std::vector<Extent> extents;
        for (const text::TexelMemory& image : world.bindings.images)
            extents.push_back({image.size[0], image.size[1], image.size[2]});
        dispatch.texels = SystemState(schema, extents);
        for (std::size_t i = 0; i < program.images.size(); ++i) {
            dispatch.images.push_back({program.images[i].name, program.images[i].is_storage});
            const WritableView view = dispatch.texels[static_cast<std::uint8_t>(i)];
            std::memcpy(view.columns[0], made.words[blocks + i].data(),
                        made.words[blocks + i].size() * sizeof(std::uint32_t));
        }
    }
    run_alone(dispatch, source);
    for (std::size_t b = 0; b < blocks; ++b)
        std::ranges::copy(dispatch.buffers[b], made.words[b].begin());
    for (std::size_t i = 0; i < program.images.size(); ++i) {
        const View view = std::as_const(dispatch.texels)[static_cast<std::uint8_t>(i)];
        std::memcpy(made.words[blocks + i].data(), view.columns[0],
                    made.words[blocks + i].size() * sizeof(std::uint32_t));
    }
    return made;
}

/// A word of a world that differs.
struct Differing {
    text::WrittenPlace place;
    std::uint32_t expected = 0, got = 0;
};

std::string with_bits(std::uint32_t bits, bool is_real) {
    return fmt::format("{} ({:#010x})", text::value_text(bits, is_real), bits);
}

/// Judges the words that one invocation wrote otherwise than the text.
class Judge {
  public:
    Judge(const MeasuredGl& gl, const text::Program& program, const std::array<std::uint32_t, 3>& groups,
          const MadeUpWorld& world)
        : profile_(gl.profile), known_(in_compute_stage(measured_operations(gl.profile), gl.profile)),
          program_(program), groups_(groups), world_(world), outcomes_(program) {}

    /// Whether one of the invocation's outcomes has all of them. Throws Error for what is not followed by sets.
    [[nodiscard]] bool allows(std::uint32_t invocation, std::span<const Differing> words) const {
        const std::vector<text::InvocationOutcome> all =
            outcomes_.of(text::invocation_of(program_, groups_, invocation), groups_, world_.bindings,
                         PassStage::compute, profile_, known_);
        return std::ranges::any_of(all, [&](const text::InvocationOutcome& outcome) {
            return outcome.undefined != Undefined::none || std::ranges::all_of(words, [&](const Differing& one) {
                       const auto word = std::ranges::find(outcome.written, one.place, &text::WrittenWord::place);
                       return word != outcome.written.end() &&
                              (word->is_real ? word->set.contains(std::bit_cast<float>(one.got))
                                             : word->word == one.got);
                   });
        });
    }
    /// "blur.comp:12, invocation 3: Out word 7: ..."
    [[nodiscard]] std::string line(std::optional<std::uint32_t> invocation, const Differing& one) const {
        bool is_real = true;
        std::string where;
        if (invocation) {
            where = fmt::format("invocation {}: ", *invocation);
            try {
                text::Trace trace;
                text::run_traced(program_, text::invocation_of(program_, groups_, *invocation), groups_,
                                 world_.bindings, profile_, {}, trace);
                for (const text::TraceRow& row : trace.rows)
                    if (row.kind == text::TraceRow::Kind::store && row.place == one.place) {
                        is_real = row.is_real;
                        where = fmt::format("{}, invocation {}: ", program_.line_name(row.line), *invocation);
                    }
            } catch (const Error&) { // run together with others: the line is not known
            }
        }
        const std::string& name = one.place.space == Space::block ? program_.blocks[one.place.number].name
                                                                  : program_.images[one.place.number].name;
        return fmt::format("{}{} word {}: expected {}, the driver made {}{}", where, name, one.place.word,
                           with_bits(one.expected, is_real), with_bits(one.got, is_real),
                           invocation ? "" : "; the text writes nothing there");
    }

  private:
    Profile profile_;
    KnownOperations known_;
    const text::Program& program_;
    std::array<std::uint32_t, 3> groups_;
    const MadeUpWorld& world_;
    text::Outcomes outcomes_;
};

/// Words that differ, by the one invocation that wrote each in the text; nobody and several are nothing.
std::map<std::optional<std::uint32_t>, std::vector<Differing>>
differing_words(const text::Program& program, const MadeUpWorld& expected, const MadeUpWorld& got,
                const text::Writers& writers, GpuComparison& counts) {
    std::map<std::optional<std::uint32_t>, std::vector<Differing>> all;
    const auto compare = [&](Space space, std::size_t number, std::span<const std::uint32_t> a,
                             std::span<const std::uint32_t> b, std::span<const std::uint32_t> by) {
        counts.words += a.size();
        const bool has_codes =
            space == Space::texel && expected.bindings.images[number].code == text::TexelMemory::Code::unorm8;
        for (std::size_t w = 0; w < a.size(); ++w)
            if (has_codes && (a[w] == b[w] + 1 || b[w] == a[w] + 1)) { // either of the two nearest (GL 4.6, 2.3.5.2)
                ++counts.differing;
                ++counts.legal;
            } else if (a[w] != b[w])
                all[by[w] == 0 ? std::nullopt : std::optional(by[w] - 1)].push_back(
                    {{space, static_cast<std::uint32_t>(number), w}, a[w], b[w]});
    };
    for (std::size_t b = 0; b < program.blocks.size(); ++b)
        if (program.blocks[b].is_storage && expected.words_of_block(b) == b)
            compare(Space::block, b, expected.words[b], got.words[b], writers.blocks[b]);
    for (std::size_t i = 0; i < program.images.size(); ++i)
        if (program.images[i].is_storage)
            compare(Space::texel, i, expected.words[program.blocks.size() + i], got.words[program.blocks.size() + i],
                    writers.images[i]);
    for (const auto& [by, words] : all)
        counts.differing += words.size();
    return all;
}

} // namespace

GpuComparison compare_with_gpu(const MeasuredGl& gl, const ShaderSource& source, const text::Program& program,
                               const std::array<std::uint32_t, 3>& groups, const MadeUpWorld& world,
                               const text::Findings& found) {
    constexpr std::size_t most_judged = 2000, most_lines = 3;
    GpuComparison made{.gl = gl.name, .not_run = {}, .unjudged_for = {}, .wrong = {}};
    if (std::ranges::any_of(found.all(), text::is_endless)) {
        made.not_run = "it does not end";
        return made;
    }
    MadeUpWorld expected = world.copy();
    text::Writers writers;
    text::Findings ignored;
    MadeUpWorld got;
    try {
        text::run_dispatch(program, {.groups = groups, .writers = &writers}, expected.bindings, gl.profile, ignored);
        got = on_gl(source, program, groups, world);
    } catch (const Error& error) {
        made.not_run = error.what();
        return made;
    }
    const auto differing = differing_words(program, expected, got, writers, made);
    if (!found.all().empty()) {
        made.open = made.differing;
        return made;
    }
    const Judge judge(gl, program, groups, world);
    std::size_t judged = 0;
    for (const auto& [invocation, words] : differing) {
        try {
            if (invocation && judged++ == most_judged)
                throw Error(fmt::format("they are of more than {} invocations", most_judged));
            if (invocation && judge.allows(*invocation, words)) {
                made.legal += words.size();
                continue;
            }
        } catch (const Error& error) {
            made.unjudged += words.size();
            if (made.unjudged_for.empty())
                made.unjudged_for = error.what();
            judged = most_judged; // the rest is likely the same
            continue;
        }
        made.wrong_words += words.size();
        if (made.wrong.size() < most_lines)
            made.wrong.push_back(judge.line(invocation, words.front()));
    }
    return made;
}

std::string GpuComparison::text() const {
    if (!not_run.empty())
        return fmt::format("not run on {}: {}\n", gl, not_run);
    std::string all = fmt::format("on {}: ", gl);
    if (differing == 0)
        all += fmt::format("every one of {} words is as the text has it\n", words);
    else if (open > 0)
        all += fmt::format("{} of {} words are not as the text has them; what was found leaves them open\n", differing,
                           words);
    else
        all += fmt::format("{} of {} words differ: {} as GL allows, {} as it does not, {} not judged\n", differing,
                           words, legal, wrong_words, unjudged);
    for (const std::string& line : wrong)
        all += "driver: " + line + "\n";
    if (unjudged > 0)
        all += fmt::format("not judged: {}\n", unjudged_for);
    return all;
}

nlohmann::json GpuComparison::json() const {
    nlohmann::json all{{"name", gl}};
    if (!not_run.empty()) {
        all["not_run"] = not_run;
        return all;
    }
    all["words"] = words;
    all["differing"] = differing;
    all["legal"] = legal;
    all["left_open"] = open;
    all["not_judged"] = unjudged;
    all["not_legal"] = wrong_words;
    all["first"] = wrong;
    return all;
}

} // namespace lockstep
