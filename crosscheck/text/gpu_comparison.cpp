#include "crosscheck/text/gpu_comparison.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/text/watched_run.hpp"
#include "crosscheck/text/word_comparison.hpp"
#include "gpu/lone_dispatch.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/error.hpp"
#include "reference/text/dispatch.hpp"

namespace lockstep {
namespace {

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

/// "blur.comp:12, invocation 3: Out.x[7]: expected ..., the driver made ..."
std::string line_of(const StageText& stage, const BoundStage& text, const ComparedWord& one) {
    std::string where;
    if (one.invocation) {
        const std::optional<std::string> line = text.line_of(*one.invocation, one.place);
        where = fmt::format("{}invocation {}: ", line ? *line + ", " : "", *one.invocation);
    }
    const NamedWord word = named_word(stage, text.bindings, one.place);
    return fmt::format("{}{}: {}{}", where, word.name, both_values(one, word.is_real, "the driver made"),
                       one.invocation ? "" : "; the text writes nothing there");
}

} // namespace

GpuComparison compare_with_gpu(const MeasuredGl& gl, const StageText& stage, const std::array<std::uint32_t, 3>& groups,
                               const MadeUpWorld& world, const text::Findings& found) {
    constexpr std::size_t most_lines = 3;
    const text::Program& program = stage.program;
    GpuComparison made{.gl = gl.name, .not_run = {}, .unjudged_for = {}, .wrong = {}};
    if (is_endless(found)) {
        made.not_run = "it does not end";
        return made;
    }
    MadeUpWorld expected = world.copy();
    text::Writers writers;
    text::Findings ignored;
    MadeUpWorld got;
    try {
        text::run_dispatch(program, {.groups = groups, .writers = &writers}, expected.bindings, gl.profile, ignored);
        got = on_gl(*stage.source, program, groups, world);
    } catch (const Error& error) {
        made.not_run = error.what();
        return made;
    }
    const BoundStage text{program, world.bindings, gl.profile, groups};
    const std::vector<std::span<const std::uint32_t>> words(got.words.begin(), got.words.end());
    const WordComparison compared = compare_words(
        text, compared_words(program, expected, writers, words),
        {.known = in_compute_stage(measured_operations(gl.profile), gl.profile), .judges = found.all().empty()});
    made.words = compared.words;
    made.differing = compared.differing;
    made.legal = compared.legal;
    made.open = found.all().empty() ? 0 : compared.differing;
    made.unjudged = compared.unjudged.size();
    made.unjudged_for = compared.unjudged_for;
    made.wrong_words = compared.wrong.size();
    if (!compared.wrong.empty())
        made.first_wrong = compared.wrong.front();
    for (const ComparedWord& one : first_of_each(compared.wrong, most_lines))
        made.wrong.push_back(line_of(stage, text, one));
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
        all += fmt::format("not judged, which is no pass: {}\n", unjudged_for);
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
