#include "crosscheck/text/examine.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/glsl_module.hpp"
#include "gpu/any_dialect.hpp"
#include "reference/half.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"
#include "reference/model/profile.hpp"
#include "reference/text/dispatch.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {
namespace {

/// Floats from 0 to 1 that look random, the same everywhere.
class MadeUp {
  public:
    explicit MadeUp(std::uint32_t seed) : state_(seed * 747796405U + 2891336453U) {}

    std::uint32_t word() {
        state_ = state_ * 747796405U + 2891336453U;
        const std::uint32_t mixed = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
        const float x = static_cast<float>(((mixed >> 22U) ^ mixed) >> 8U) * 0x1p-24F;
        return std::bit_cast<std::uint32_t>(x);
    }

  private:
    std::uint32_t state_;
};

std::shared_ptr<const ShaderSource> source_of(const Examination& of) {
    std::string name = of.file.filename().string();
    const std::optional<Stage> stage = stage_of(name);
    if (!stage)
        throw Error(
            fmt::format("{}: expected a stage NAME.comp, NAME.vert, NAME.geom or NAME.frag, or one of these with "
                        ".spv behind it",
                        plain_line(of.file.string())));
    name.resize(name.rfind(extension(*stage)));
    if (!std::filesystem::exists(of.file))
        throw Error(fmt::format("{}: no such file", plain_line(of.file.string())));
    const std::filesystem::path folder = of.file.has_parent_path() ? of.file.parent_path() : ".";
    return std::make_shared<ShaderSource>(load_any_dialect(shader_folders(folder), name, *stage, of.defines));
}

/// Throws Error for a name among those given that the shader does not have.
template <class Given>
void check_names(std::string_view option, const Given& given, const std::vector<std::string>& names) {
    for (const auto& [name, value] : given)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw Error(fmt::format("{} {}: the shader has no such name; it has {}{}", option, plain_line(name),
                                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                                    did_you_mean(name, names)));
}

/// How the numbers of a uniform, an input or a block's member are written; of integers the text has the sign.
template <class Variable> TableColumn numbers_of(const Variable& of) {
    TableColumn column{.name = {}, .scalar = of.is_real ? Scalar::float32 : Scalar::int32};
    if constexpr (requires { of.is_boolean; })
        column.is_bool = of.is_boolean;
    return column;
}

/// The words of `cells` numbers that are given for `name`.
std::vector<std::uint32_t> words_of(std::string_view option, std::string_view name, std::size_t cells,
                                    const TableColumn& column, const std::vector<std::string>& given) {
    if (given.size() != cells)
        throw Error(fmt::format("{} {}: expected {} numbers, got {}", option, name, cells, given.size()));
    std::vector<std::uint32_t> words;
    for (const std::string& number : given) {
        std::optional<std::uint32_t> word = number_bits(number, column);
        if (!word && column.scalar == Scalar::int32 && !column.is_bool)
            word = number_bits(number, {.name = {}, .scalar = Scalar::uint32});
        if (!word)
            throw Error(fmt::format("{} {}: '{}' is {}", option, name, plain_line(number), no_number(column)));
        words.push_back(*word);
    }
    return words;
}

/// The block in which GLSL for Vulkan has what are plain uniforms in GL.
constexpr std::string_view block_of_uniforms = "gl_DefaultUniformBlock";

std::vector<std::uint32_t> block_words(const Examination& of, const text::Block& block, std::size_t count,
                                       MadeUp& made_up) {
    std::vector<std::uint32_t> words(block.words(count));
    const auto fill = [&](std::size_t first, const std::vector<text::Leaf>& leaves) {
        for (const text::Leaf& leaf : leaves)
            if (leaf.is_real)
                words.at(first + leaf.word) = made_up.word();
    };
    if (block.name != block_of_uniforms)
        fill(0, block.leaves);
    for (std::size_t i = 0; block.array_stride > 0 && i < count; ++i)
        fill((block.array_offset + i * block.array_stride) / text::word_bytes, block.element);
    fill_block(of.fills, block, count, words);
    for (const text::Block::Member& member : block.members)
        if (const auto given = of.uniforms.find(member.name); given != of.uniforms.end()) {
            const std::vector<std::uint32_t> numbers = words_of("--uniform", member.name, member.leaves.size(),
                                                                numbers_of(member.leaves.front()), given->second);
            for (std::size_t i = 0; i < numbers.size(); ++i)
                words.at(member.leaves[i].word) = numbers[i];
        }
    return words;
}

/// A float from 0 to 1 as a texel's word has it.
std::uint32_t code_of(std::uint32_t word, text::TexelMemory::Code code) {
    const auto x = std::bit_cast<float>(word);
    return code == text::TexelMemory::Code::unorm8 ? static_cast<std::uint32_t>(x * 255.0F)
           : code == text::TexelMemory::Code::half ? std::bit_cast<std::uint32_t>(half_nearest(x))
                                                   : word;
}

/// Of a stage other than compute; fragments come in whole quads.
std::uint32_t invocations_of(const Examination& of, const text::Program& program) {
    return program.stage == spv::ExecutionModelFragment ? (of.invocations + 3) / 4 * 4 : of.invocations;
}

/// Invocations along each axis; of stages other than compute they lie in a square whose sides are even.
std::array<std::uint32_t, 3> extent_of(const Examination& of, const text::Program& program) {
    if (program.stage != spv::ExecutionModelGLCompute) {
        const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(invocations_of(of, program)) / 2.0));
        return {2 * side, 2 * side, 1};
    }
    std::array<std::uint32_t, 3> invocations{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        invocations[axis] = of.groups[axis] * program.group[axis];
    return invocations;
}

/// Blocks to which the text gives one binding are one buffer (GL 4.6, 7.8): the longest's words.
void share_buffers(const std::vector<text::Block>& blocks, std::vector<std::span<std::uint32_t>>& words) {
    const std::vector<std::span<std::uint32_t>> own = words;
    for (std::size_t a = 0; a < blocks.size(); ++a) {
        if (!blocks[a].binding)
            continue;
        std::span<std::uint32_t> longest;
        for (std::size_t b = 0; b < blocks.size(); ++b)
            if (blocks[a].binding == blocks[b].binding && blocks[a].is_storage == blocks[b].is_storage &&
                own[b].size() > longest.size())
                longest = own[b];
        words[a] = longest;
    }
}

/// Images to which the text gives one unit are one image (GL 4.6, 8.26). Throws Error where their kinds, sizes or
/// formats differ, since GL then defines nothing; one that is only stored to need not have a format.
void share_images(const std::vector<text::ImageUniform>& images, std::vector<text::TexelMemory>& memory) {
    const auto kind = [&](std::size_t i) {
        const text::ImageShape& shape = images[i].shape;
        return std::tuple(shape.dimensions, shape.is_arrayed, shape.has_samples, images[i].is_real, images[i].is_signed,
                          memory[i].size);
    };
    const auto has_format = [&](std::size_t i) { return images[i].shape.format != spv::ImageFormatUnknown; };
    const auto take = [&](std::size_t to, std::size_t from) {
        memory[to].words = memory[from].words;
        memory[to].components = memory[from].components;
        memory[to].code = memory[from].code;
    };
    for (std::size_t a = 0; a < images.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (!images[a].is_storage || !images[b].is_storage || !images[a].binding ||
                images[a].binding != images[b].binding)
                continue;
            if (kind(a) != kind(b) ||
                (has_format(a) && has_format(b) && images[a].shape.format != images[b].shape.format))
                throw Error(
                    fmt::format("images {} and {} are on one unit, {}; expected one type, one size and one format",
                                images[b].name, images[a].name, images[a].binding->number));
            if (has_format(b))
                take(a, b);
            else
                take(b, a);
        }
}

/// Some seconds.
constexpr std::uint32_t most_branches = 10'000'000;

std::uint32_t made_up_size(const text::ImageShape& shape, std::uint32_t axis,
                           const std::array<std::uint32_t, 3>& invocations) {
    constexpr std::uint32_t samples = 4, faces = 6;
    if (shape.dimensions == spv::DimCube)
        return axis == 2 ? faces : invocations[0];
    return shape.has_samples && axis + 1 == shape.axes() ? samples : invocations[axis];
}

constexpr std::size_t most = std::size_t{1} << 26U; ///< words that are made up, and invocations that run

/// The product of `numbers`. Throws Error where it is more than `most`; `what`: what it counts.
std::size_t counted(std::string_view option, std::string_view what, std::initializer_list<std::size_t> numbers) {
    std::size_t product = 1;
    for (const std::size_t number : numbers) {
        if (number > 0 && product > most / number)
            throw Error(fmt::format("{}: {} {}; expected at most {}", option, fmt::join(numbers, " * "), what, most));
        product *= number;
    }
    return product;
}

void check_invocations(const Examination& of, const text::Program& program) {
    const std::array<std::uint32_t, 3>& groups = of.groups;
    if (program.stage == spv::ExecutionModelGLCompute)
        counted(fmt::format("--groups {}", fmt::join(groups, ",")), "invocations",
                {groups[0], groups[1], groups[2], program.invocations()});
    else
        counted(fmt::format("--invocations {}", of.invocations), "vertices",
                {invocations_of(of, program), std::max(program.most_vertices, 1U)});
}

MadeUpWorld world_of(const Examination& of, const text::Program& program) {
    MadeUp made_up(of.seed);
    MadeUpWorld world;
    world.words.reserve(program.blocks.size() + program.images.size());
    const std::array<std::uint32_t, 3> invocations = extent_of(of, program);
    const auto size_of = [&](const std::string& name) {
        const auto found = of.sizes.find(name);
        return found == of.sizes.end() ? std::vector<std::uint32_t>{} : found->second;
    };
    std::size_t taken = 0;
    const auto take = [&](const std::string& name, std::initializer_list<std::size_t> numbers) {
        const std::size_t words = counted(fmt::format("--size {}", name), "words", numbers);
        taken += words;
        counted(fmt::format("--size {}", name), "words of blocks and images together", {taken});
        return words;
    };
    for (const text::Block& block : program.blocks) {
        const std::vector<std::uint32_t> size = size_of(block.name);
        if (!size.empty() && (block.array_stride == 0 || size.size() != 1))
            throw Error(fmt::format("--size {}: expected one number, of a block that ends with an array without a "
                                    "length",
                                    block.name));
        const std::size_t count = !size.empty() ? size[0]
                                  : program.stage == spv::ExecutionModelGLCompute
                                      ? std::size_t{invocations[0]} * invocations[1] * invocations[2]
                                      : invocations_of(of, program);
        take(block.name, {block.words(count)});
        world.words.push_back(block_words(of, block, count, made_up));
        world.bindings.blocks.emplace_back(world.words.back());
    }
    share_buffers(program.blocks, world.bindings.blocks);
    for (const text::ImageUniform& image : program.images) {
        const TexelFormat format = format_of(image);
        text::TexelMemory texels{.name = image.name, .components = format.components, .code = format.code};
        const std::uint32_t axes = image.shape.axes();
        const std::vector<std::uint32_t> size = size_of(image.name);
        if (!size.empty() && size.size() != axes)
            throw Error(fmt::format("--size {}: expected {} numbers, texels along each axis", image.name, axes));
        if (std::ranges::find(size, 0U) != size.end() ||
            (!size.empty() && image.shape.dimensions == spv::DimCube && (size[0] != size[1] || size[2] % 6 != 0)))
            throw Error(fmt::format("--size {}: expected texels along each axis from 1, of a cube N,N,6", image.name));
        for (std::uint32_t axis = 0; axis < axes; ++axis)
            texels.size[axis] = size.empty() ? made_up_size(image.shape, axis, invocations) : size[axis];
        std::vector<std::uint32_t>& all = world.words.emplace_back(
            take(image.name, {texels.size[0], texels.size[1], texels.size[2], texels.components}));
        for (std::uint32_t& word : all)
            word = image.is_real ? code_of(made_up.word(), format.code) : 0U;
        texels.words = all;
        fill_image(of.fills, image, texels);
        world.bindings.images.push_back(texels);
    }
    share_images(program.images, world.bindings.images);
    for (const text::PlainUniform& uniform : program.uniforms) {
        const auto given = of.uniforms.find(uniform.name);
        world.bindings.uniforms.push_back(
            given == of.uniforms.end()
                ? std::vector<std::uint32_t>{}
                : words_of("--uniform", uniform.name, uniform.cells, numbers_of(uniform), given->second));
    }
    return world;
}

/// Inputs that are given, and made-up ones for the rest: floats from 0 to 1, integers 0. Fragments lie in quads.
text::StageRun stage_run_of(const Examination& of, const text::Program& program) {
    text::StageRun run{.invocations = invocations_of(of, program),
                       .is_watched = true,
                       .most_branches = most_branches,
                       .subgroup_size = of.subgroup_size,
                       .keeps_outputs = false};
    run.are_quads = program.stage == spv::ExecutionModelFragment;
    const std::uint32_t side = extent_of(of, program)[0];
    MadeUp made_up(of.seed + 1);
    for (const text::StageVariable& input : program.stage_inputs) {
        const std::string name = text::name_of(input);
        if (const auto given = of.inputs.find(name); given != of.inputs.end()) {
            run.inputs[name] = words_of("--input", name, input.words(), numbers_of(input), given->second);
        } else if (text::needs_words(input)) {
            std::vector<std::uint32_t>& words = run.inputs[name];
            const std::size_t count = counted(fmt::format("--invocations {}: input {}", of.invocations, name), "words",
                                              {run.invocations, input.words()});
            for (std::size_t w = 0; w < count; ++w)
                words.push_back(input.is_real ? made_up.word() : 0U);
            for (std::uint32_t i = 0; input.builtin == spv::BuiltInFragCoord && i < run.invocations; ++i) {
                const std::uint32_t quad = i / 4, across = side / 2; // pixel centres, quad after quad
                const std::array<std::uint32_t, 2> pixel{quad % across * 2 + i % 2, quad / across * 2 + i / 2 % 2};
                for (std::size_t c = 0; c < pixel.size(); ++c)
                    words[4 * i + c] = std::bit_cast<std::uint32_t>(static_cast<float>(pixel[c]) + 0.5F);
                words[4 * i + 3] = std::bit_cast<std::uint32_t>(1.0F);
            }
        }
    }
    return run;
}

template <class All> std::vector<std::string> names_of(const All& all) {
    std::vector<std::string> names;
    for (const auto& one : all)
        names.push_back(one.name);
    return names;
}

/// Plain uniforms and members of blocks.
std::vector<std::string> uniform_names(const text::Program& program) {
    std::vector<std::string> names = names_of(program.uniforms);
    for (const text::Block& block : program.blocks)
        for (const std::string& name : names_of(block.members))
            names.push_back(name);
    return names;
}

/// Uniforms that are 0, since they are not given.
std::vector<std::string> not_given(const Examination& of, const text::Program& program) {
    std::vector<std::string> names = names_of(program.uniforms);
    for (const text::Block& block : program.blocks)
        if (block.name == block_of_uniforms)
            names = names_of(block.members);
    std::erase_if(names, [&](const std::string& name) { return of.uniforms.contains(name); });
    return names;
}

/// "64 vertices".
std::string what_ran(const Examination& of, const text::Program& program) {
    switch (program.stage) {
    case spv::ExecutionModelVertex:
        return fmt::format("{} vertices", of.invocations);
    case spv::ExecutionModelGeometry:
        return fmt::format("{} primitives", of.invocations);
    case spv::ExecutionModelFragment:
        return fmt::format("{} fragments", invocations_of(of, program));
    default:
        return fmt::format("{} groups of {} invocations", of.groups[0] * of.groups[1] * of.groups[2],
                           program.invocations());
    }
}

/// Names of inputs that may be given.
std::vector<std::string> input_names(const text::Program& program) {
    std::vector<std::string> names;
    for (const text::StageVariable& input : program.stage_inputs)
        if (input.is_read)
            names.push_back(text::name_of(input));
    return names;
}

} // namespace

std::optional<Stage> stage_of(const std::filesystem::path& file) {
    const std::filesystem::path glsl = file.extension() == ".spv" ? file.stem() : file.filename();
    for (const Stage stage : {Stage::compute, Stage::vertex, Stage::geometry, Stage::fragment})
        if (glsl.extension() == extension(stage))
            return stage;
    return std::nullopt;
}

namespace {

text::Program program_of(const std::shared_ptr<const ShaderSource>& source, ConstantExpressions constants) {
    return text::decoded(text::read_module(spirv_of(*source, constants),
                                           [source](std::uint32_t line) { return line_name(*source, line); }));
}

/// Runs a text on what is made up, watched. Returns whether groups hand on to others what they wrote.
bool run_watched(const Examination& of, const text::Program& program, const MadeUpWorld& world,
                 text::Findings& findings, bool is_reversed = false) {
    const Profile profile = named_profile("strict");
    if (program.stage == spv::ExecutionModelGLCompute)
        return text::run_dispatch(program,
                                  {.groups = of.groups,
                                   .is_watched = true,
                                   .most_branches = most_branches,
                                   .subgroup_size = of.subgroup_size,
                                   .is_reversed = is_reversed},
                                  world.bindings, profile, findings);
    text::run_stage(program, stage_run_of(of, program), world.bindings, profile, findings);
    return false;
}

/// Groups that wait for earlier ones find what they wait for, since these run first: run the other way round, they do
/// not.
void find_waiting(const Examination& of, const text::Program& program, text::Findings& findings) {
    text::Findings reversed;
    run_watched(of, program, world_of(of, program), reversed, true);
    for (const text::Finding& one : reversed.all())
        if (one.rule == text::waiting_rule)
            findings.add(one.rule, one.place, [&] { return one.what; });
}

/// Names by which a race would not be: integers that are 0, since they are not given, are often indexes.
std::map<std::string, std::vector<const text::Finding*>>
made_up_races(const Examination& of, const text::Program& program, const text::Findings& findings) {
    constexpr std::size_t most_tried = 4, most_invocations = 65'536;
    std::map<std::string, std::vector<const text::Finding*>> all;
    std::vector<std::string> names = index_names(program);
    std::erase_if(names, [&](const std::string& name) {
        return of.fills.contains(name) || of.fills.contains(name.substr(0, name.find('.'))) ||
               of.uniforms.contains(name);
    });
    const std::array<std::uint32_t, 3> extent = extent_of(of, program);
    if (std::ranges::none_of(findings.all(), text::is_race) || std::ranges::any_of(findings.all(), text::is_endless) ||
        names.size() > most_tried || std::size_t{extent[0]} * extent[1] * extent[2] > most_invocations)
        return all;
    for (const std::string& name : names) {
        Examination other = of;
        other.fills[name] = "iota";
        text::Findings found;
        run_watched(other, program, world_of(other, program), found);
        for (const text::Finding& one : findings.all())
            if (text::is_race(one) && std::ranges::none_of(found.all(), [&](const text::Finding& again) {
                    return again.rule == one.rule && again.place.line == one.place.line;
                }))
                all[name].push_back(&one);
    }
    return all;
}

} // namespace

ExaminationResult examine(const Examination& of, const MeasuredGl* gl) {
    const std::shared_ptr<const ShaderSource> source = source_of(of);
    const text::Program program = program_of(source, ConstantExpressions::open);
    check_names("--uniform", of.uniforms, uniform_names(program));
    check_names("--input", of.inputs, input_names(program));
    std::vector<std::string> sized = names_of(program.blocks);
    for (const std::string& name : names_of(program.images))
        sized.push_back(name);
    check_names("--size", of.sizes, sized);
    check_names("--fill", of.fills, fill_names(program));
    check_invocations(of, program);
    const MadeUpWorld watched = world_of(of, program);
    std::optional<MadeUpWorld> before; // for the driver, which starts from the same
    if (gl != nullptr)
        before = watched.copy();
    text::Findings findings;
    if (run_watched(of, program, watched, findings) && std::ranges::none_of(findings.all(), text::is_endless))
        find_waiting(of, program, findings);
    ExaminationResult result;
    if (before)
        result.gpu = compare_with_gpu(*gl, *source, program_of(source, ConstantExpressions::folded), of.groups, *before,
                                      findings);
    result.ran = what_ran(of, program);
    if (program.stage == spv::ExecutionModelGLCompute)
        result.group_size = program.invocations();
    result.not_given = not_given(of, program);
    const auto made_up = made_up_races(of, program, findings);
    for (const text::Finding& found : findings.all()) {
        NamedFinding& one = result.findings.emplace_back(
            NamedFinding{found, program.line_name(found.place.line),
                         found.other ? program.line_name(found.other->line) : std::string()});
        for (const auto& [name, races] : made_up)
            if (std::ranges::find(races, &found) != races.end()) {
                one.found.what += fmt::format(" (not with --fill {}=iota)", name);
                break;
            }
    }
    return result;
}

std::string ExaminationResult::text(const Examination& of) const {
    std::string all =
        fmt::format("{}: {} finding{} in {}\n", of.file.filename().string(),
                    findings.empty() ? "no" : std::to_string(findings.size()), findings.size() == 1 ? "" : "s", ran);
    for (const NamedFinding& one : findings) {
        all += fmt::format("{}: {}: {}", one.where, one.found.rule, one.found.what);
        if (one.found.other && one.other != one.where)
            all += fmt::format("; the other at {}", one.other);
        else if (!one.found.other)
            all += fmt::format("; invocation {}", one.found.place.invocation);
        all += one.found.times > 1 ? fmt::format("; {} times\n", one.found.times) : "\n";
    }
    if (!not_given.empty())
        all += fmt::format("0 for want of --uniform: {}\n", fmt::join(not_given, ", "));
    if (gpu)
        all += gpu->text();
    return all;
}

nlohmann::json ExaminationResult::json(const Examination& of) const {
    nlohmann::json all{{"file", of.file.filename().string()},
                       {"ran", ran},
                       {"uniforms_not_given", not_given},
                       {"findings", nlohmann::json::array()}};
    if (group_size > 0) {
        all["groups"] = of.groups;
        all["group_size"] = group_size;
    }
    for (const NamedFinding& one : findings) {
        nlohmann::json row{{"rule", one.found.rule},
                           {"what", one.found.what},
                           {"where", one.where},
                           {"invocation", one.found.place.invocation},
                           {"times", one.found.times}};
        if (one.found.other)
            row["other"] = {{"where", one.other}, {"invocation", one.found.other->invocation}};
        all["findings"].push_back(std::move(row));
    }
    if (gpu)
        all["gl"] = gpu->json();
    return all;
}

} // namespace lockstep
