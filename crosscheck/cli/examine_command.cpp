#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/examine.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "lockstep/lockstep.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct ExamineRequest {
    std::filesystem::path file, reference, json;
    std::optional<std::string> groups;
    std::string gl;
    std::optional<std::size_t> invocations;
    std::vector<std::string> uniforms, inputs, sizes, fills, defines;
    std::size_t seed = 1, integers = 0, subgroup_size = text::lanes_at_once;
    bool quiet = false;
};

/// "NAME=VALUE", taken apart.
std::pair<std::string, std::string> parts_of(std::string_view option, const std::string& text) {
    auto parts = setting_parts(text);
    if (parts.first.empty() || text.find('=') == std::string::npos)
        throw Error(fmt::format("{} {}: expected NAME=VALUE", option, plain_line(text)));
    return parts;
}

/// What lies between commas.
std::vector<std::string> listed(std::string_view text) {
    std::vector<std::string> all;
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
        comma = text.find(',');
        all.emplace_back(text.substr(0, comma));
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    return all;
}

/// "1,2,3"; nothing of what is no list of numbers from 0.
std::vector<std::uint32_t> numbers_in(std::string_view text) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& one : listed(text))
        if (const auto number = number_bits(one, {.name = {}, .scalar = Scalar::uint32}))
            numbers.push_back(*number);
        else
            return {};
    return numbers;
}

std::array<std::uint32_t, 3> groups_of(const std::string& text) {
    constexpr std::uint32_t most = 65535; // that every GL has
    const std::vector<std::uint32_t> numbers = numbers_in(text);
    std::array<std::uint32_t, 3> groups{1, 1, 1};
    const auto fits = [](std::uint32_t n) { return n > 0 && n <= most; };
    if (numbers.empty() || numbers.size() > groups.size() || !std::all_of(numbers.begin(), numbers.end(), fits))
        throw Error(fmt::format("--groups {}: expected one to three numbers from 1 to {}", plain_line(text), most));
    std::copy(numbers.begin(), numbers.end(), groups.begin());
    return groups;
}

int run_examine(const ExamineRequest& options) {
    Examination of{.file = options.file, .reference = options.reference};
    if (const std::optional<Stage> stage = stage_of(options.file); stage == Stage::compute) {
        if (options.invocations || !options.inputs.empty())
            throw Error("--invocations and --input are of vertex, geometry and fragment stages; use --groups");
        if (options.groups)
            of.groups = groups_of(*options.groups);
    } else if (stage && options.groups) {
        throw Error("--groups is of compute stages; use --invocations");
    } else if (options.invocations) {
        of.invocations = static_cast<std::uint32_t>(*options.invocations);
    }
    const auto given = [](std::string_view option, const std::string& one) {
        auto [name, value] = parts_of(option, one);
        return std::pair(std::move(name), listed(value));
    };
    for (const std::string& one : options.inputs)
        of.inputs.insert(given("--input", one));
    for (const std::string& one : options.uniforms)
        of.uniforms.insert(given("--uniform", one));
    for (const std::string& one : options.sizes) {
        const auto [name, value] = parts_of("--size", one);
        if ((of.sizes[name] = numbers_in(value)).empty())
            throw Error(fmt::format("--size {}: expected NAME=NUMBER, or NAME=64,64", plain_line(one)));
    }
    for (const std::string& one : options.fills)
        of.fills.insert(parts_of("--fill", one));
    for (const std::string& one : options.defines)
        of.defines.push_back(macro_of("--define", one));
    of.seed = static_cast<std::uint32_t>(options.seed);
    of.integers = static_cast<std::uint32_t>(options.integers);
    if (!std::has_single_bit(options.subgroup_size))
        throw Error(fmt::format("--subgroup-size {}: expected a power of 2", options.subgroup_size));
    of.subgroup_size = static_cast<std::uint32_t>(options.subgroup_size);
    OutputFiles files;
    files.protect(options.file);
    if (!options.reference.empty())
        files.protect(options.reference);
    if (!options.json.empty())
        files.expect(options.json);
    std::optional<Gl> gl;
    std::optional<MeasuredGl> measured;
    if (!options.gl.empty()) {
        if (stage_of(options.file) != Stage::compute)
            throw Error("--gl is of compute stages");
        gl.emplace(options.gl);
        if (!*gl)
            throw Error(gl->missing());
        measured.emplace(MeasuredGl{gl->name(), gl->profile()});
    }
    const ExaminationResult result = examine(of, measured ? &*measured : nullptr);
    if (!options.json.empty())
        files.write(options.json, json_text(result.json(of)));
    files.commit();
    if (!options.quiet)
        fmt::print("{}", plain_text(result.text(of)));
    if (result.is_right() && result.gpu && !result.gpu->not_run.empty())
        throw Error(fmt::format("--gl {}: not run: {}", options.gl, result.gpu->not_run));
    return result.is_right() ? status_agree : status_differ;
}

} // namespace

Verb examine_command() {
    auto options = std::make_shared<ExamineRequest>();
    Verb verb{"examine", "run a shader's text and report races, unset variables and undefined operands"};
    verb.add(required(path_option("file", "FILE", options->file,
                                  "the shader: NAME.comp, NAME.vert, NAME.geom or NAME.frag, or NAME.comp.spv")));
    verb.add(
        otherwise(text_option("--groups", "X,Y,Z", options->groups, "groups of a compute stage along each axis"), "4"));
    verb.add(otherwise(integer_option("--invocations", "N", IntegerRange{1, 1'000'000}, options->invocations,
                                      "vertices, primitives or fragments of another stage"),
                       "64"));
    verb.add(settings_option("--input", "NAME=VALUE", options->inputs,
                             "an input of such a stage, the same for all invocations: a_Position=0,1,0, "
                             "gl_FrontFacing=0; floats that look random without"));
    verb.add(settings_option("--uniform", "NAME=VALUE", options->uniforms,
                             "a uniform's value: u_Kept=0.5, u_Gravity=0,-9.81,0; 0 without; or a member's of a "
                             "block: Light.colour=1,1,1"));
    verb.add(settings_option("--size", "NAME=N", options->sizes,
                             "elements of the array at the end of a block, or texels along each axis of an image: "
                             "Particles=100, u_Source=64,64; as many as invocations without"));
    verb.add(settings_option("--fill", "NAME=iota|zero|VALUE", options->fills,
                             "the numbers of a block, of its member NAME.member or of an image: 0, 1, 2, ..., or one "
                             "for all: Indices=iota, Particles.p.mass=1; without, floats look random and integers are "
                             "0"));
    verb.add(settings_option("--define", "NAME=TEXT", options->defines, "a macro that the shader is compiled with"));
    verb.add(otherwise(integer_option("--seed", "N", IntegerRange{0, 1'000'000}, options->seed,
                                      "which random numbers blocks and images hold"),
                       "1"));
    verb.add(otherwise(integer_option("--subgroup-size", "N", IntegerRange{1, text::lanes_at_once},
                                      options->subgroup_size, "invocations of a subgroup, a power of 2"),
                       std::to_string(text::lanes_at_once)));
    verb.add(path_option("--reference", "OTHER", options->reference,
                         "compare with another text of the same stage, run from the same numbers: DIVERGENT words, the "
                         "invocation that wrote them and the line of FILE without a counterpart"));
    verb.add(otherwise(integer_option("--integers", "N", IntegerRange{0, 1'000'000}, options->integers,
                                      "integers of arrays and images look random, from 0 to N - 1; 0: all are 0"),
                       "0"));
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options->gl,
                         "run a compute stage on this GL, too, and compare every word with what its text allows"));
    verb.add(path_option("--json", "FILE", options->json, "write the findings as JSON"));
    verb.add(flag("--quiet", options->quiet, "print nothing"));
    verb.footer = "Exit status: 0 nothing was found and all words agree or are legal, 1 otherwise, 2 could not run.\n"
                  "Examples: lockstep examine blur.comp --groups 4,4 --uniform u_Radius=3\n"
                  "          lockstep examine shade.frag --input v_Normal=0,0,1\n"
                  "          lockstep examine blur.comp --reference yesterday/blur.comp";
    verb.run = [options](const Call&) { return run_examine(*options); };
    return verb;
}

} // namespace lockstep
