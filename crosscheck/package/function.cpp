#include "lockstep/function.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/package/function_signature.hpp"
#include "gpu/gl_system.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep::function_twin {
namespace {

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

/// The text without its line #version, and what that line asks for.
std::pair<std::string, std::string> without_version(const std::string& text) {
    std::string rest, version = " 400 core";
    std::size_t from = 0;
    while (from < text.size()) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        const std::string line = text.substr(from, end - from);
        const std::size_t word = line.find_first_not_of(" \t");
        if (word != std::string::npos && line[word] == '#' && line.find("version", word) != std::string::npos &&
            line.find_first_not_of(" \t", word + 1) == line.find("version", word))
            version = line.substr(line.find("version", word) + 7);
        else
            rest += line;
        rest += '\n';
        from = end + 1;
    }
    return {rest, version};
}

} // namespace

Called called(const GlslFunction& function, const std::vector<Column>& columns) {
    const std::string text = read_shader_file(function.file);
    const Signature signature = signature_of(function, text);
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

    const auto [body, version] = without_version(text);
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
    const std::string file = std::filesystem::path(function.file).filename().string();
    const std::string stage =
        fmt::format("#version{}\n#define main ls_main_of_the_file\n#include \"{}\"\n#undef main\n{}{} out_Result;\n"
                    "void main() {{\n{}    out_Result = {}({}({}));\n}}\n",
                    version, file, declared, output_type(*result), copied, result->is_bool ? "int" : "", function.name,
                    fmt::join(arguments, ", "));
    Called made{
        checked({"function", {{.name = "rows", .item = "row", .title = "the table", .fields = fields}}}), {}, {}};
    GlPass pass;
    pass.name = pass_name;
    pass.stage = Stage::vertex;
    if (!function.uniforms.empty())
        pass.uniforms = [uniforms = function.uniforms](int) { return uniforms; };
    pass.defines = function.defines;
    pass.texts = {{fmt::format("{}.vert", pass_name), stage}, {file, body}};
    made.passes.push_back(std::move(pass));
    made.folder = std::filesystem::path(function.file).parent_path().string();
    if (made.folder.empty())
        made.folder = ".";
    return made;
}

} // namespace lockstep::function_twin
