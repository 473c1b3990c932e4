#include "lockstep/function.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/package/function_signature.hpp"
#include "gpu/gl_system.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep::function_twin {
namespace {

constexpr std::string_view system_name = "function";

/// The table's columns by the parameters' names, where these can be names of a state's.
std::vector<std::string> field_names(const Signature& signature) {
    std::vector<std::string> names;
    std::set<std::string> taken{"Result"};
    for (std::size_t p = 0; p < signature.parameters.size(); ++p) {
        const std::string& own = signature.parameters[p].name;
        const bool is_word = !own.empty() && std::all_of(own.begin(), own.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        });
        const bool fits = is_word && own.front() >= 'a' && own.find("__") == std::string::npos && own.back() != '_';
        std::string name = fits ? own : fmt::format("argument_{}", p + 1);
        if (!taken.insert(shader_name(name)).second) {
            name = fmt::format("argument_{}", p + 1);
            taken.insert(shader_name(name));
        }
        names.push_back(name);
    }
    return names;
}

/// A bool lies in a buffer as an int.
std::string stored_type(const Column& column) { return type_of({column.scalar, column.components}); }

std::string output_type(const Column& column) {
    return fmt::format("{}out {}", column.scalar == Scalar::float32 ? "" : "flat ", stored_type(column));
}

bool has_version(const std::string& text) {
    std::string_view last;
    for (ShaderWords words(text); words.next(); last = words.token())
        if (last == "#" && words.token() == "version")
            return true;
    return false;
}

/// Where files that it includes are looked for.
std::string folder_of(const GlslFunction& function) {
    const std::string folder = std::filesystem::path(function.file).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// A vertex stage of that name: the function's file, whose main goes by another name (defines_of), and `end` behind it.
/// What a compiler finds in `end` is the file's fault: a brace or a comment that it leaves open.
ShaderTexts stage_of(const GlslFunction& function, std::string_view name, const std::string& end) {
    const std::string text = text_of_file(function);
    const std::string file = std::filesystem::path(function.file).filename().string();
    const std::string version = has_version(text) ? "" : fmt::format("#version {} core\n", 400);
    const auto last = 1 + std::count(text.begin(), text.end(), '\n') - (text.ends_with('\n') ? 1 : 0);
    return {{fmt::format("{}.vert", name),
             fmt::format("#line 1 \"{0}\"\n{1}#include \"{0}\"\n#line {2} \"{0}\"\n#undef main\n{3}", file, version,
                         last, end)},
            {file, text}};
}

/// The function's, and one behind #version, which may be the file's own, that gives the file's main another name.
auto defines_of(const GlslFunction& function) {
    auto defines = function.defines;
    defines.emplace_back("main", std::string(main_of_the_file));
    return defines;
}

/// Throws Error for a value of a uniform that is not there.
void check_uniforms(const GlslFunction& function) {
    if (function.uniforms.empty())
        return;
    std::vector<std::string> declared;
    for (const DeclaredUniform& one : uniforms_of(function))
        declared.push_back(one.name);
    for (const auto& [name, value] : function.uniforms)
        if (std::find(declared.begin(), declared.end(), name.substr(0, name.find_first_of("[."))) == declared.end())
            throw Error(fmt::format("shader {}: declares no uniform {}{}{}", plain_line(function.file),
                                    plain_line(name),
                                    declared.empty() ? "" : fmt::format("; it has {}", fmt::join(declared, ", ")),
                                    did_you_mean(name, declared)));
}

} // namespace

ShaderSource whole_text(const GlslFunction& function) {
    constexpr std::string_view name = "file";
    return load_stages(shader_folders(folder_of(function), system_name), name, std::array{Stage::vertex},
                       defines_of(function), stage_of(function, name, ""))
        .front();
}

Called called(const GlslFunction& function, const std::vector<Column>& columns) {
    const Signature signature = signature_of(function);
    const std::optional<Column> result = column_of(signature.result);
    if (!result)
        fail(function, signature, fmt::format("its result must be {}", column_types));
    if (signature.parameters.size() != columns.size())
        fail(function, signature,
             fmt::format("the table has {} for {}", counted(columns.size(), "column"),
                         counted(signature.parameters.size(), "argument")));
    for (std::size_t p = 0; p < columns.size(); ++p)
        if (signature.parameters[p].type != type_of(columns[p]))
            fail(function, signature,
                 fmt::format("column {} of the table is {}, argument {} is {}", p + 1, type_of(columns[p]), p + 1,
                             signature.parameters[p].type));

    check_uniforms(function);
    const std::vector<std::string> names = field_names(signature);
    std::vector<Field> fields;
    std::string declared, copied;
    std::vector<std::string> arguments;
    for (std::size_t p = 0; p < columns.size(); ++p) {
        fields.push_back({names[p], columns[p].scalar, columns[p].components});
        const std::string type = stored_type(columns[p]), word = shader_name(names[p]);
        declared += fmt::format("in {} a_{};\n{} out_{};\n", type, word, output_type(columns[p]), word);
        copied += fmt::format("    out_{0} = a_{0};\n", word);
        arguments.push_back(columns[p].is_bool ? fmt::format("bool(a_{})", word) : "a_" + word);
    }
    fields.push_back({"result", result->scalar, result->components});
    const std::string end = fmt::format("{}{} out_Result;\nvoid main() {{\n{}    out_Result = {}({}({}));\n}}\n",
                                        declared, output_type(*result), copied, result->is_bool ? "int" : "",
                                        function.name, fmt::join(arguments, ", "));
    Called made{
        checked({std::string(system_name), {{.name = "rows", .item = "row", .title = "the table", .fields = fields}}}),
        {},
        folder_of(function),
        *result};
    GlPass pass;
    pass.name = pass_name;
    pass.stage = Stage::vertex;
    if (!function.uniforms.empty())
        pass.uniforms = [uniforms = function.uniforms](int) { return uniforms; };
    pass.defines = defines_of(function);
    pass.texts = stage_of(function, pass_name, end);
    made.passes.push_back(std::move(pass));
    return made;
}

MatchResult match_rows(const Gl& gl, const Called& called, const System& system, const FunctionMatchOptions& options) {
    return with_advice([&] {
        GlSystemSide gpu(gl, system, called.passes, called.folder);
        return match_system(gpu, system,
                            {.frames = 1,
                             .legal = options.legal,
                             .allow_undefined = options.allow_undefined,
                             .power_at_least = options.power_at_least,
                             .repeat = options.repeat});
    });
}

} // namespace lockstep::function_twin
