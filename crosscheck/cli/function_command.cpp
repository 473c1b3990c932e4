#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/function_findings.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/package/function_signature.hpp"
#include "crosscheck/report/colour.hpp"
#include "gpu/shader_source.hpp"
#include "lockstep/function_table.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

struct FunctionRequest {
    std::filesystem::path file, table, like, json;
    std::string name, like_name;
    std::vector<std::string> uniforms, defines;
    std::string gl = "auto";
    bool quiet = false;
};

/// "NAME=VALUE", taken apart.
std::pair<std::string, std::string> parts_of(const std::string& text) {
    const std::size_t sign = text.find('=');
    return {text.substr(0, sign), sign == std::string::npos ? std::string() : text.substr(sign + 1)};
}

bool is_macro_name(std::string_view name) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

std::vector<float> numbers_in(const std::string& text) {
    std::vector<float> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        float number = 0.0F;
        const auto [rest, status] = std::from_chars(at, end, number);
        if (status != std::errc{} || (rest != end && *rest != ','))
            return {};
        numbers.push_back(number);
        if (rest == end)
            return numbers;
        at = rest + 1;
    }
}

/// A uniform's value of the type that the shader declares; nothing where the numbers are not as many, or no integers.
std::optional<UniformValue> value_of(const std::string& type, const std::vector<float>& n) {
    const bool integers = std::all_of(n.begin(), n.end(), [](float x) {
        return x >= -16777216.0F && x <= 16777216.0F && x == static_cast<float>(static_cast<int>(x));
    });
    const auto whole = [&](std::size_t i) { return static_cast<int>(n[i]); };
    if (type == "float" && n.size() == 1)
        return n[0];
    if (type == "int" && n.size() == 1 && integers)
        return whole(0);
    if (type == "uint" && n.size() == 1 && integers && n[0] >= 0.0F)
        return static_cast<unsigned>(whole(0));
    if (type == "vec2" && n.size() == 2)
        return glm::vec2(n[0], n[1]);
    if (type == "vec3" && n.size() == 3)
        return glm::vec3(n[0], n[1], n[2]);
    if (type == "vec4" && n.size() == 4)
        return glm::vec4(n[0], n[1], n[2], n[3]);
    if (type == "ivec2" && n.size() == 2 && integers)
        return glm::ivec2(whole(0), whole(1));
    if (type == "ivec3" && n.size() == 3 && integers)
        return glm::ivec3(whole(0), whole(1), whole(2));
    if (type == "mat4" && n.size() == 16) {
        glm::mat4 matrix;
        for (std::size_t i = 0; i < n.size(); ++i)
            matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = n[i];
        return matrix;
    }
    return {};
}

/// Those of `given` that `file` declares. `any`: whether it is fine to declare none of a name.
Uniforms uniforms_of(const std::string& file, const std::vector<std::string>& given, bool any) {
    const std::string text = read_shader_file(file);
    Uniforms uniforms;
    for (const std::string& one : given) {
        const auto [name, value] = parts_of(one);
        const std::string type = function_twin::uniform_type(text, name);
        if (type.empty() && any)
            continue;
        if (type.empty())
            throw Error(fmt::format("--uniform {}: {} declares no uniform {}{}", plain_line(one), plain_line(file),
                                    plain_line(name), did_you_mean(name, function_twin::uniform_names(text))));
        const auto read = value_of(type, numbers_in(value));
        if (!read)
            throw Error(fmt::format("--uniform {}: '{}' is no {}; right is NAME=NUMBER, of a vector NAME=1,2,3",
                                    plain_line(one), plain_line(value), type));
        uniforms[name] = *read;
    }
    return uniforms;
}

GlslFunction function_of(const FunctionRequest& options, const std::filesystem::path& file, const std::string& name,
                         bool any_uniform) {
    ShaderDefines defines;
    for (const std::string& define : options.defines) {
        defines.push_back(parts_of(define));
        if (!is_macro_name(defines.back().first))
            throw Error(fmt::format("--define {}: '{}' is no name of a macro; right is NAME=TEXT", plain_line(define),
                                    plain_line(defines.back().first)));
    }
    return {file.string(), name, uniforms_of(file.string(), options.uniforms, any_uniform), std::move(defines)};
}

std::string command_of(const FunctionRequest& options) {
    std::string line = fmt::format("lockstep function {} {} --table {}", shell_path(options.file), options.name,
                                   shell_word(options.table.string()));
    const auto add = [&](std::string_view option, const std::string& value) {
        if (!value.empty())
            line += fmt::format(" {} {}", option, shell_word(value));
    };
    add("--like", options.like.string());
    add("--like-name", options.like_name);
    for (const std::string& uniform : options.uniforms)
        add("--uniform", uniform);
    for (const std::string& define : options.defines)
        add("--define", define);
    add("--gl", options.gl == "auto" ? "" : options.gl);
    return line;
}

int run_function(const FunctionRequest& options) {
    const GlslFunction function = function_of(options, options.file, options.name, false);
    const FunctionRows rows = read_function_rows(function, options.table);
    if (options.like.empty() && !options.like_name.empty())
        throw Error("function: --like-name goes with --like");
    if (!options.like.empty() && rows.results)
        throw Error(fmt::format("function: {} has results, and --like gives others; right is one of them", rows.file));
    if (options.like.empty() && !rows.results)
        throw Error(fmt::format("function: {} has no column result; right is one, or --like FILE, whose function of "
                                "that name gives the results",
                                rows.file));
    OutputFiles files;
    for (const std::filesystem::path& input : {options.file, options.table, options.like})
        files.protect(input);
    if (!options.json.empty())
        files.expect(options.json);
    RunOptions run;
    run.gl = options.gl;
    const Gl gl = open_gl(run);
    MatchOptions how;
    how.repeat = command_of(options);
    const std::vector<UndefinedRow> undefined = undefined_rows(function, rows);
    const FunctionRows judged = undefined.empty() ? rows : without(rows, undefined);
    std::optional<MatchResult> result;
    if (judged.count() > 0)
        result = options.like.empty()
                     ? match_function(gl, function, judged, how)
                     : match_function(gl, function, judged,
                                      function_of(options, options.like,
                                                  options.like_name.empty() ? options.name : options.like_name, true),
                                      how);
    const bool agrees = !result || result->passed();
    const std::string open =
        undefined.empty() ? std::string() : undefined_text(rows, undefined, agrees ? judged.count() : 0);
    if (!options.quiet)
        fmt::print("{}{}", agrees && !undefined.empty() ? std::string() : colored(plain_text(result->text())),
                   colored(plain_text(open)));
    if (!options.json.empty()) {
        nlohmann::json document =
            result ? report_json(result->report(), result->run()) : nlohmann::json{{"verdict", "UNDEFINED"}};
        for (const UndefinedRow& one : undefined)
            document["undefined_rows"].push_back(
                {{"row", one.row}, {"where", one.where}, {"rule", one.rule}, {"what", one.what}});
        files.write(options.json, json_text(document));
    }
    files.commit();
    return agrees && undefined.empty() ? status_agree : status_differ;
}

} // namespace

Verb function_command() {
    auto options = std::make_shared<FunctionRequest>();
    Verb verb{"function", "run one GLSL function on a table of arguments, and hold what it returns against results"};
    verb.add(required(path_option("file", "FILE", options->file, "the shader that defines it")));
    verb.add(required(text_option("name", "NAME", options->name, "the function")));
    verb.add(
        required(path_option("--table", "FILE", options->table,
                             "its arguments, and the results: CSV with a column a component (velocity.x), or JSON, "
                             "an array of objects; the results are called result")));
    verb.add(path_option("--like", "FILE", options->like,
                         "a shader whose function of that name gives the results, instead of the table"));
    verb.add(text_option("--like-name", "NAME", options->like_name, "the name of that function, where it is another"));
    verb.add(settings_option("--uniform", "NAME=VALUE", options->uniforms,
                             "a uniform that it reads: u_Kept=0.5, u_Gravity=0,-9.81,0"));
    verb.add(settings_option("--define", "NAME=TEXT", options->defines, "a macro that the shader is compiled with"));
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options->gl, "which GL to open"));
    verb.add(path_option("--json", "FILE", options->json, "write the report as JSON"));
    verb.add(flag("--quiet", options->quiet, "print nothing"));
    verb.footer = "Exit status: 0 every bit agrees, 1 one does not, 2 could not run.\n"
                  "Example: lockstep function shaders/wall.glsl bounce --table walls.csv --uniform u_Kept=0.5";
    verb.run = [options](const Call&) { return run_function(*options); };
    return verb;
}

} // namespace lockstep
