#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/function_findings.hpp"
#include "crosscheck/cli/function_text.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/judge/legal.hpp"
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
    Legal legal = Legal::measured;
    bool quiet = false;
};

/// The bits of numbers between commas; nothing where they are not `count`, or one is none of the type.
std::optional<std::vector<std::uint32_t>> words_in(std::string_view text, Scalar scalar, std::size_t count) {
    const TableColumn column{.name = {}, .scalar = scalar};
    std::vector<std::uint32_t> words;
    for (bool more = true; more;) {
        const std::size_t comma = text.find(',');
        more = comma != std::string_view::npos;
        const std::optional<std::uint32_t> word = number_bits(text.substr(0, comma), column);
        if (!word)
            return {};
        words.push_back(*word);
        text.remove_prefix(more ? comma + 1 : text.size());
    }
    return words.size() == count ? std::optional(std::move(words)) : std::nullopt;
}

/// A value whose bits are these.
template <class Value> Value value_of(const std::vector<std::uint32_t>& words) {
    static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % sizeof(std::uint32_t) == 0);
    Value value{};
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof value);
    return value;
}

struct UniformType {
    std::string_view name;
    Scalar scalar;
    std::size_t components;
    UniformValue (*value)(const std::vector<std::uint32_t>& words);
};

template <class Value> constexpr UniformType uniform_type(std::string_view name, Scalar scalar) {
    return {name, scalar, sizeof(Value) / sizeof(std::uint32_t),
            [](const std::vector<std::uint32_t>& words) { return UniformValue(value_of<Value>(words)); }};
}

constexpr std::array uniform_table{
    uniform_type<float>("float", Scalar::float32),    uniform_type<int>("int", Scalar::int32),
    uniform_type<unsigned>("uint", Scalar::uint32),   uniform_type<glm::vec2>("vec2", Scalar::float32),
    uniform_type<glm::vec3>("vec3", Scalar::float32), uniform_type<glm::vec4>("vec4", Scalar::float32),
    uniform_type<glm::ivec2>("ivec2", Scalar::int32), uniform_type<glm::ivec3>("ivec3", Scalar::int32),
    uniform_type<glm::mat4>("mat4", Scalar::float32)};

/// A uniform's value of the type that the shader declares. `option`: what gives it, for messages.
UniformValue value_of(const std::string& option, const std::string& type, const std::string& value) {
    const auto known = std::find_if(uniform_table.begin(), uniform_table.end(),
                                    [&](const UniformType& one) { return one.name == type; });
    if (known == uniform_table.end()) {
        std::vector<std::string_view> names;
        for (const UniformType& one : uniform_table)
            names.push_back(one.name);
        throw Error(fmt::format("--uniform {}: it is a {}; types that get a value are {}", option, type,
                                fmt::join(names, ", ")));
    }
    const auto words = words_in(value, known->scalar, known->components);
    if (!words)
        throw Error(fmt::format("--uniform {}: '{}' is no {}; right is NAME=NUMBER, of a vector NAME=1,2,3", option,
                                plain_line(value), type));
    return known->value(*words);
}

/// What a value of an array's uniform is of each element: so many numbers as the type has.
std::vector<std::string> elements_in(const std::string& value, const std::string& type) {
    const auto known = std::ranges::find(uniform_table, type, &UniformType::name);
    const std::size_t size = known == uniform_table.end() ? 1 : known->components;
    std::vector<std::string> all;
    std::size_t numbers = 0;
    std::istringstream stream(value);
    for (std::string number; std::getline(stream, number, ','); ++numbers)
        if (numbers % size == 0)
            all.push_back(number);
        else
            all.back() += "," + number;
    return all;
}

/// Gives each function what its file declares of `given`, of an array all elements or one by its number. Throws Error
/// for what no file declares.
void give_uniforms(const std::vector<std::string>& given, std::span<GlslFunction> functions) {
    std::vector<std::vector<function_twin::DeclaredUniform>> uniforms_of_each;
    for (const GlslFunction& function : functions)
        uniforms_of_each.push_back(given.empty() ? std::vector<function_twin::DeclaredUniform>()
                                                 : function_twin::uniforms_of(function));
    for (const std::string& one : given) {
        const auto [name, value] = setting_parts(one);
        const std::string array = name.substr(0, name.find('['));
        std::vector<std::string> declared, files;
        bool found = false;
        for (std::size_t f = 0; f < functions.size(); ++f) {
            GlslFunction& function = functions[f];
            files.push_back(plain_line(function.file));
            for (const function_twin::DeclaredUniform& uniform : uniforms_of_each[f]) {
                declared.push_back(uniform.name);
                const bool is_element = uniform.is_array && name != array;
                if (uniform.name != (is_element ? array : name))
                    continue;
                found = true;
                if (is_element || !uniform.is_array) {
                    function.uniforms[name] = value_of(plain_line(one), uniform.type, value);
                    continue;
                }
                const std::vector<std::string> elements = elements_in(value, uniform.type);
                if (uniform.elements != 0 && elements.size() != uniform.elements)
                    throw Error(fmt::format("--uniform {}: expected {} elements of {}, each a {}", plain_line(one),
                                            uniform.elements, name, uniform.type));
                for (std::size_t k = 0; k < elements.size(); ++k)
                    function.uniforms[fmt::format("{}[{}]", name, k)] =
                        value_of(plain_line(one), uniform.type, elements[k]);
            }
        }
        if (!found)
            throw Error(fmt::format("--uniform {}: {} declares no uniform {}{}", plain_line(one),
                                    fmt::join(files, ", or "), plain_line(name), did_you_mean(name, declared)));
    }
}

GlslFunction function_of(const FunctionRequest& options, const std::filesystem::path& file, const std::string& name) {
    ShaderDefines defines;
    for (const std::string& define : options.defines)
        defines.push_back(macro_of("--define", define));
    GlslFunction made{file.string(), name, {}, std::move(defines), {}};
    if (const std::size_t open = name.find('('); open != std::string::npos && name.ends_with(')')) {
        made.name = name.substr(0, open);
        made.parameters = name.substr(open + 1, name.size() - open - 2);
    }
    return made;
}

std::string command_of(const FunctionRequest& options) {
    std::string line = fmt::format("lockstep function {} {} --table {}", shell_path(options.file),
                                   shell_word(options.name), shell_word(options.table.string()));
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
    return line + werror_option_text();
}

/// A function's own text, where it is interpreted.
struct ReadText {
    std::optional<FunctionText> text = {};
    std::string missing = {}; ///< why there is none
};

ReadText read_text(const Gl& gl, const GlslFunction& function, const FunctionRows& rows, Legal legal) {
    ReadText own;
    try {
        const Profile profile = gl.profile();
        own.text.emplace(function, rows.columns, profile, known_operations(legal, profile));
    } catch (const Error& error) {
        own.missing = error.what();
    }
    return own;
}

/// The rows that either leaves undefined; of one that both do, the first's words.
std::vector<UndefinedRow> undefined_rows(const FunctionRows& rows, const ReadText& own, const ReadText& other) {
    std::vector<UndefinedRow> all;
    for (const ReadText* one : {&own, &other})
        if (one->text)
            std::ranges::move(one->text->undefined_rows(rows), std::back_inserter(all));
    std::ranges::stable_sort(all, {}, &UndefinedRow::row);
    const auto repeated = std::ranges::unique(all, {}, &UndefinedRow::row);
    all.erase(repeated.begin(), repeated.end());
    return all;
}

/// Holds the rows against the table's results, `like`'s, or what the function's own text says.
MatchResult match(const Gl& gl, const GlslFunction& function, const ReadText& own, const GlslFunction* like,
                  const ReadText& other, const FunctionRows& rows, const FunctionMatchOptions& how) {
    const auto open = [&](const ReadText& of) {
        return of.text ? OpenResults([&text = *of.text, &rows](std::size_t row, const TextTaken& taken) {
            return text.results(rows, row, taken);
        })
                       : OpenResults();
    };
    ExpectedResults expected;
    if (like != nullptr)
        expected = {returned(gl, *like, rows), results_of(*like)};
    else if (rows.results)
        expected = {*rows.results, "results of the table"};
    else
        expected = {own.text->values(rows), "its own text, which says nothing about whether it is the right function"};
    expected.own = open(own);
    expected.expected = open(other);
    return match_function(gl, function, rows, std::move(expected), how);
}

int run_function(const FunctionRequest& options) {
    std::vector<GlslFunction> functions{function_of(options, options.file, options.name)};
    if (!options.like.empty())
        functions.push_back(
            function_of(options, options.like, options.like_name.empty() ? options.name : options.like_name));
    give_uniforms(options.uniforms, functions);
    const GlslFunction& function = functions.front();
    const FunctionRows rows = read_function_rows(function, options.table);
    if (options.like.empty() && !options.like_name.empty())
        throw Error("function: --like-name goes with --like");
    if (!options.like.empty() && rows.results)
        throw Error(fmt::format("function: {} has results, and --like gives others; right is one of them", rows.file));
    OutputFiles files;
    for (const std::filesystem::path& input : {options.file, options.table, options.like})
        files.protect(input);
    if (!options.json.empty())
        files.expect(options.json);
    RunOptions run;
    run.gl = options.gl;
    const Gl gl = open_gl(run);
    const FunctionMatchOptions how{.legal = options.legal, .repeat = command_of(options)};
    const GlslFunction* const like = functions.size() > 1 ? &functions.back() : nullptr;
    if (like != nullptr)
        check_comparable(function, *like, rows);
    const ReadText own = read_text(gl, function, rows, options.legal);
    const ReadText other = like != nullptr ? read_text(gl, *like, rows, options.legal) : ReadText();
    if (!own.text && like == nullptr && !rows.results)
        throw Error(own.missing);
    const std::vector<UndefinedRow> undefined = undefined_rows(rows, own, other);
    const FunctionRows judged = undefined.empty() ? rows : without(rows, undefined);
    std::optional<MatchResult> result;
    if (judged.count() > 0)
        result = match(gl, function, own, like, other, judged, how);
    const bool agrees = !result || result->passed();
    const std::string open =
        undefined.empty() ? std::string() : undefined_text(rows, undefined, agrees ? judged.count() : 0);
    if (!options.json.empty()) {
        nlohmann::json document =
            result ? report_json(result->report(), result->run()) : nlohmann::json{{"verdict", "UNDEFINED"}};
        for (const UndefinedRow& one : undefined)
            document["undefined_rows"].push_back(
                {{"row", one.row}, {"where", one.where}, {"rule", one.rule}, {"what", one.what}});
        for (const ReadText* one : {&own, &other})
            if (!one->missing.empty())
                document["texts_not_read"].push_back(plain_line(one->missing));
        files.write(options.json, json_text(document));
    }
    files.commit();
    if (!options.quiet)
        fmt::print("{}{}{}", agrees && !undefined.empty() ? std::string() : colored(plain_text(result->text())),
                   colored(plain_text(open)), plain_text(unread_text({own.missing, other.missing})));
    return agrees && undefined.empty() ? status_agree : status_differ;
}

} // namespace

Verb function_command() {
    auto options = std::make_shared<FunctionRequest>();
    Verb verb{"function", "run one GLSL function on a table of arguments, and hold what it returns against results"};
    verb.add(required(path_option("file", "FILE", options->file, "the shader that defines it")));
    verb.add(required(text_option("name", "NAME", options->name,
                                  "the function; of several of one name with its arguments: 'mix3(vec3, float)'")));
    verb.add(
        required(path_option("--table", "FILE", options->table,
                             "its arguments, and the results: CSV with a column a component (velocity.x), or JSON, "
                             "an array of objects; the results are called result; without them its own text is what "
                             "the GPU is held against")));
    verb.add(path_option("--like", "FILE", options->like,
                         "a shader whose function of that name gives the results, instead of the table"));
    verb.add(text_option("--like-name", "NAME", options->like_name, "the name of that function, where it is another"));
    verb.add(settings_option("--uniform", "NAME=VALUE", options->uniforms,
                             "a uniform that it reads: u_Kept=0.5, u_Gravity=0,-9.81,0"));
    verb.add(settings_option("--define", "NAME=TEXT", options->defines, "a macro that the shader is compiled with"));
    add_legal_option(verb, options->legal);
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options->gl, "which GL to open"));
    verb.add(path_option("--json", "FILE", options->json, "write the report as JSON"));
    add_werror_option(verb);
    verb.add(flag("--quiet", options->quiet, "print nothing"));
    verb.footer = "Exit status: 0 every bit agrees or is legal, 1 one is not, 2 could not run.\n"
                  "Example: lockstep function shaders/wall.glsl bounce --table walls.csv --uniform u_Kept=0.5";
    verb.run = [options](const Call&) { return run_function(*options); };
    return verb;
}

} // namespace lockstep
