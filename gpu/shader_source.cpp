#include "gpu/shader_source.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "gpu/data_folder.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view white_space = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(white_space);
    return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

/// What follows `#name` in a preprocessor line; nothing if the line is another.
std::optional<std::string_view> directive(std::string_view line, std::string_view name) {
    line = trimmed(line);
    if (!line.starts_with('#'))
        return {};
    line = trimmed(line.substr(1));
    if (!line.starts_with(name))
        return {};
    line.remove_prefix(name.size());
    if (!line.empty() && (std::isalnum(static_cast<unsigned char>(line.front())) != 0 || line.front() == '_'))
        return {};
    return trimmed(line);
}

std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream)
        throw Error(fmt::format("shader {}: cannot be read", path.string()));
    return text.str();
}

fs::path find(const ShaderFolders& folders, const std::string& file, const std::string& where) {
    std::string tried;
    for (const fs::path& folder : folders) {
        if (fs::is_regular_file(folder / file))
            return folder / file;
        tried += fmt::format("{}{}", tried.empty() ? "" : " or ", folder.string());
    }
    throw Error(fmt::format("{}no shader file {} in {}", where, file, tried));
}

/// Puts one stage together.
class Assembly {
  public:
    Assembly(const ShaderFolders& folders, const ShaderDefines& defines) : folders_(folders), defines_(defines) {}

    ShaderSource assemble(const fs::path& path, const std::string& text, Stage stage) {
        source_.stage = stage;
        append(path, text);
        if (!has_version_)
            throw Error(fmt::format("shader {}:1: no #version line; GLSL 330 or later is needed", path.string()));
        return std::move(source_);
    }

  private:
    void append(const fs::path& path, const std::string& text) {
        const std::size_t file = source_.files.size();
        source_.files.push_back(path.string());
        open_.push_back(path);
        std::istringstream lines(text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (const auto included = directive(line, "include")) {
                include(*included, fmt::format("shader {}:{}: ", path.string(), number));
                continue;
            }
            append_line(line, {file, number});
            if (directive(line, "version") && !has_version_) {
                has_version_ = true;
                for (const auto& [name, value] : defines_)
                    append_line(fmt::format("#define {} {}", name, value), {file, number});
            }
        }
        open_.pop_back();
    }

    void append_line(const std::string& line, ShaderSource::Origin origin) {
        source_.text += line;
        source_.text += '\n';
        source_.origins.push_back(origin);
    }

    void include(std::string_view argument, const std::string& where) {
        const std::size_t end = argument.find('"', 1);
        if (!argument.starts_with('"') || end == std::string_view::npos || end == 1)
            throw Error(fmt::format("{}#include needs a file name in double quotes", where));
        const fs::path path = find(folders_, std::string(argument.substr(1, end - 1)), where);
        if (std::find(open_.begin(), open_.end(), path) != open_.end())
            throw Error(fmt::format("{}{} includes itself", where, path.string()));
        append(path, read_file(path));
    }

    const ShaderFolders& folders_;
    const ShaderDefines& defines_;
    ShaderSource source_;
    std::vector<fs::path> open_; ///< files being read, outermost first
    bool has_version_ = false;
};

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

bool blank(const std::string& text) { return text.find_first_not_of(" \t\r\n") == std::string::npos; }

} // namespace

std::string_view extension(Stage stage) {
    switch (stage) {
    case Stage::vertex:
        return ".vert";
    case Stage::geometry:
        return ".geom";
    case Stage::fragment:
        return ".frag";
    case Stage::compute:
        break;
    }
    return ".comp";
}

ShaderFolders shader_folders(const fs::path& user) {
    ShaderFolders folders;
    if (!user.empty()) {
        std::error_code error;
        if (!fs::is_directory(user, error))
            throw Error(fmt::format("shader folder {} does not exist", user.string()));
        folders.push_back(user);
    }
    folders.push_back(built_in_shaders());
    return folders;
}

ShaderDefines switch_defines(const Switches& switches) {
    ShaderDefines defines;
    for (const SwitchInfo& info : switch_table()) {
        if (info.values.empty())
            continue;
        const std::string name = upper(info.name);
        for (std::size_t i = 0; i < info.values.size(); ++i)
            defines.emplace_back(fmt::format("{}_{}", name, upper(info.values[i])), std::to_string(i));
        defines.emplace_back(name, fmt::format("{}_{}", name, upper(switch_value(switches, info.name))));
    }
    return defines;
}

ShaderSource load_stage(const ShaderFolders& folders, std::string_view name, Stage stage,
                        const ShaderDefines& defines) {
    const fs::path path = find(folders, fmt::format("{}{}", name, extension(stage)), "");
    return Assembly(folders, defines).assemble(path, read_file(path), stage);
}

std::vector<ShaderSource> load_stages(const ShaderFolders& folders, std::string_view name,
                                      std::span<const Stage> stages, const ShaderDefines& defines) {
    std::vector<ShaderSource> sources;
    for (const Stage stage : stages) {
        const fs::path path = find(folders, fmt::format("{}{}", name, extension(stage)), "");
        const std::string text = read_file(path);
        if (!blank(text))
            sources.push_back(Assembly(folders, defines).assemble(path, text, stage));
    }
    return sources;
}

} // namespace lockstep
