#include "gpu/shader_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "gpu/any_dialect.hpp"
#include "gpu/data_folder.hpp"
#include "gpu/old_glsl.hpp"
#include "gpu/shader_bounds.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/shaders_read_once.hpp"
#include "gpu/spirv_module.hpp"
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

constexpr std::size_t longest_text = std::size_t{4} << 20U; // bytes, with everything that is included
constexpr std::string_view module_extension = ".spv";
constexpr std::size_t most_files = 1000; // included ones, each as often as it is
constexpr int oldest_version = 140;      // that compiles in a core profile

std::string too_long() { return fmt::format("more than {} MiB of shader text", longest_text >> 20U); }

/// As messages name a file or folder: a shipped one by its place among the shaders, which is the same on every machine.
std::string shown(const fs::path& path) {
    const fs::path inside = path.lexically_relative(built_in_shaders());
    if (inside.empty() || *inside.begin() == "..")
        return path.string();
    return (fs::path("shaders") / (inside == "." ? fs::path() : inside)).string();
}

} // namespace

std::string read_shader_file(const fs::path& path) {
    const auto fail = [&](const std::string& what) { throw Error(fmt::format("shader {}: {}", shown(path), what)); };
    std::error_code status;
    if (fs::exists(path, status) && !fs::is_regular_file(path, status))
        fail(fs::is_directory(path, status) ? "is a folder; right is a file"
                                            : "is a pipe or a device; right is a file");
    std::ifstream stream(path, std::ios::binary);
    std::string text(longest_text + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!stream.is_open() || stream.bad())
        fail("cannot be read");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > longest_text)
        fail(too_long());
    if (path.extension() == module_extension)
        return text;
    if (is_spirv(text))
        fail(fmt::format("holds a SPIR-V module; right is the name {}{}", path.filename().string(), module_extension));
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        fail("is UTF-16; a shader is UTF-8");
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
        fail(fmt::format("holds a zero byte, at {}; a compiler would read no further", zero));
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

namespace {

/// `argument`: of a #version line.
void check_version(std::string_view argument, const std::string& where) {
    int version = 0;
    const auto [end, status] = std::from_chars(argument.data(), argument.data() + argument.size(), version);
    if (status != std::errc{})
        return; // the compiler's to tell
    if (ShaderWords profile({end, static_cast<std::size_t>(argument.data() + argument.size() - end)});
        (profile.next() && profile.token() == "es") || version == 100)
        throw Error(fmt::format("{}GLSL ES {}; GLSL 330 or later is needed, that of desktop GL", where, version));
    if (version < oldest_version)
        throw Error(fmt::format("{}GLSL {}.{:02}, which a core profile does not have; GLSL 330 or later is needed",
                                where, version / 100, version % 100));
}

/// What ShadersReadOnce has seen.
struct Seen {
    std::set<fs::path> folders;
    std::map<fs::path, std::optional<std::string>> files; ///< no text: no file
};
std::unique_ptr<Seen> seen;

/// Of give_bindings.
std::map<fs::path, std::string>& given_bindings() {
    static std::map<fs::path, std::string> all;
    return all;
}

/// A folder however it is written.
fs::path folder_key(const fs::path& folder) { return fs::absolute(folder / "").lexically_normal(); }

/// Nothing if there is no such file.
std::optional<std::string> text_of(const fs::path& path) {
    if (seen)
        if (const auto known = seen->files.find(path); known != seen->files.end())
            return known->second;
    std::error_code error;
    std::optional<std::string> text;
    if (fs::exists(path, error))
        text = read_shader_file(path);
    if (seen)
        seen->files.emplace(path, text);
    return text;
}

bool is_folder(const fs::path& path) {
    std::error_code error;
    if (seen && seen->folders.contains(path))
        return true;
    const bool folder = fs::is_directory(path, error);
    if (seen && folder)
        seen->folders.insert(path);
    return folder;
}

struct File {
    fs::path path;
    std::string text;
};

/// An error where the preprocessor comes to the line, and none where it does not.
struct NotIncluded : Error {
    NotIncluded(const std::string& where, const std::string& what) : Error(where + what), why(what) {}
    std::string why;
};

/// `file` may be a SPIR-V module, with an ending more.
File find(const ShaderFolders& folders, const ShaderTexts& texts, const std::string& file, const std::string& where) {
    if (const auto made = texts.find(file); made != texts.end())
        return {file, made->second};
    std::string tried;
    for (const fs::path& folder : folders) {
        const fs::path module = folder / fmt::format("{}{}", file, module_extension);
        auto text = text_of(folder / file), words = text_of(module);
        if (text && words)
            throw Error(fmt::format("shader {}: {} lies beside it; right is one of them", shown(module), file));
        if (words)
            return {module, std::move(*words)};
        if (text)
            return {folder / file, std::move(*text)};
        tried += fmt::format("{}{}", tried.empty() ? "" : " or ", shown(folder));
    }
    throw NotIncluded(where, fmt::format("no shader file {} in {}", file, tried));
}

/// Of "NAME.vert.spv"; nothing for another file.
std::optional<Stage> module_stage(const fs::path& file) {
    if (file.extension() == module_extension)
        for (const Stage stage : {Stage::vertex, Stage::geometry, Stage::fragment, Stage::compute})
            if (file.stem().extension() == extension(stage))
                return stage;
    return std::nullopt;
}

FolderNames names_in(const fs::path& folder) {
    static constexpr std::array<std::string_view, 5> endings{".vert", ".geom", ".frag", ".comp", ".glsl"};
    std::set<std::string, std::less<>> found, blocks;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (const std::optional<Stage> stage = module_stage(entry.path())) {
            const SpirvModule module = read_spirv(shown(entry.path()), text_of(entry.path()).value_or(""), *stage);
            std::ranges::move(module.names(), std::inserter(found, found.end()));
            for (const InterfaceBlock& block : module.storage_blocks)
                blocks.insert(block.name);
            continue;
        }
        if (std::find(endings.begin(), endings.end(), entry.path().extension().string()) == endings.end())
            continue;
        const std::optional<std::string> text = text_of(entry.path());
        if (!text)
            continue;
        std::string_view last;
        bool is_buffer = false; // since the last declaration
        for (ShaderWords words(*text); words.next(); last = words.token()) {
            found.emplace(words.token());
            if (words.token() == "{" && is_buffer)
                blocks.emplace(last);
            if (words.token() == "{" || words.token() == "}" || words.token() == ";")
                is_buffer = false;
            else if (words.token() == "buffer")
                is_buffer = true;
        }
    }
    return {{found.begin(), found.end()}, {blocks.begin(), blocks.end()}};
}

/// Null where there are none.
std::shared_ptr<const Bindings> bindings_beside(const fs::path& file) {
    if (file.parent_path().empty())
        return nullptr; // a text of the host's
    const fs::path bindings = file.parent_path() / bindings_file;
    if (const auto given = given_bindings().find(folder_key(file.parent_path())); given != given_bindings().end())
        return parse_bindings("names of " + shown(file.parent_path()), given->second, names_in(file.parent_path()));
    const std::optional<std::string> text = text_of(bindings);
    return text ? parse_bindings(shown(bindings), *text, names_in(file.parent_path())) : nullptr;
}

/// Puts one stage together.
class Assembly {
  public:
    Assembly(const ShaderFolders& folders, const ShaderDefines& defines, const ShaderTexts& texts,
             bool takes_any_dialect = false)
        : folders_(folders), defines_(defines), texts_(texts), takes_any_dialect_(takes_any_dialect) {}

    ShaderSource assemble(const fs::path& path, const std::string& text, Stage stage) {
        source_.stage = stage;
        source_.bindings = bindings_beside(path);
        if (path.extension() == module_extension) {
            source_.files.push_back(shown(path));
            source_.module = std::make_shared<const SpirvModule>(read_spirv(shown(path), text, stage));
            return std::move(source_);
        }
        append(path, text);
        if (!has_version_ && !takes_any_dialect_ && !says_old_glsl(source_.text))
            throw Error(fmt::format("shader {}:1: no #version line; GLSL 330 or later is needed", shown(path)));
        for (auto one = defines_.rbegin(); !has_version_ && one != defines_.rend(); ++one) {
            source_.text.insert(0, fmt::format("#define {} {}\n", one->first, one->second));
            source_.origins.insert(source_.origins.begin(), {0, 1});
        }
        check_bounds(source_);
        return std::move(source_);
    }

  private:
    void append(const fs::path& path, const std::string& text) {
        const std::size_t file = source_.files.size();
        source_.files.push_back(shown(path));
        if (file > most_files)
            throw Error(fmt::format("shader {}: includes more than {} files", source_.files.front(), most_files));
        open_.push_back(path);
        std::istringstream lines(text);
        std::string line;
        std::optional<ShaderSource::Origin> origin; // of all lines that follow
        for (int number = 1; std::getline(lines, line); ++number) {
            if (const auto included = directive(line, "include")) {
                try {
                    include(*included, fmt::format("shader {}:{}: ", shown(path), number));
                } catch (const NotIncluded& error) {
                    if (conditions_ == 0)
                        throw;
                    append_line(fmt::format("#error {}", error.why), {file, number}); // the branch may not be taken
                }
                continue;
            }
            note_condition(line);
            if (const auto renumbered = directive(line, "line")) {
                if (open_.size() == 1 && texts_.contains(path.string()))
                    stand_for(*renumbered, origin);
                else
                    append_line(without_renumbering(line, *renumbered), {file, number});
                continue;
            }
            append_line(line, origin.value_or(ShaderSource::Origin{file, number}));
            if (const auto version = directive(line, "version"); version && !has_version_) {
                if (!takes_any_dialect_ && file > 0)
                    check_version(*version, fmt::format("shader {}:{}: ", shown(path), number));
                has_version_ = true;
                for (const auto& [name, value] : defines_)
                    append_line(fmt::format("#define {} {}", name, value), {file, number});
            }
        }
        open_.pop_back();
    }

    /// `#line 7 "wall.glsl"` in a stage that the host writes: what follows stands for that line, as messages name it.
    void stand_for(std::string_view argument, std::optional<ShaderSource::Origin>& origin) {
        origin = ShaderSource::Origin{};
        std::from_chars(argument.data(), argument.data() + argument.size(), origin->line);
        const std::size_t name = argument.find('"') + 1;
        source_.files.front() = argument.substr(name, argument.rfind('"') - name);
    }

    /// A `#line` is left out, since errors are reported by the lines of the files. One with a file's name, without a
    /// number, or with a word that is no macro is refused as GL does, where the preprocessor comes to it.
    [[nodiscard]] std::string without_renumbering(const std::string& line, std::string_view argument) const {
        if (argument.find('"') != std::string_view::npos)
            return "#error in GLSL #line takes numbers alone, no file name";
        constexpr const char* broken = "#error in GLSL #line takes the number of a line";
        bool has_word = false;
        for (ShaderWords words(argument); words.next(); has_word = true) {
            const std::string_view word = words.token();
            std::int32_t number = 0;
            const bool is_number = std::isdigit(static_cast<unsigned char>(word.front())) != 0;
            const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
            if (is_number ? status != std::errc{}
                          : is_name(word) && !word.starts_with("__") && !says_define(source_.text, word))
                return broken;
        }
        return has_word ? "//" + line : broken;
    }

    static bool is_name(std::string_view word) {
        return std::isalpha(static_cast<unsigned char>(word.front())) != 0 || word.front() == '_';
    }

    /// Whether a text defines a macro of that name.
    static bool says_define(const std::string& text, std::string_view name) {
        std::string_view last;
        for (ShaderWords words(text); words.next(); last = words.token())
            if (last == "define" && words.token() == name)
                return true;
        return false;
    }

    void note_condition(std::string_view line) {
        for (const std::string_view begin : {"if", "ifdef", "ifndef"})
            conditions_ += directive(line, begin) ? 1 : 0;
        conditions_ -= directive(line, "endif") && conditions_ > 0 ? 1 : 0;
    }

    void append_line(const std::string& line, ShaderSource::Origin origin) {
        source_.text += line;
        source_.text += '\n';
        source_.origins.push_back(origin);
        if (source_.text.size() > longest_text)
            throw Error(fmt::format("shader {}: {}", source_.files.front(), too_long()));
    }

    void include(std::string_view argument, const std::string& where) {
        const std::size_t end = argument.find('"', 1);
        if (!argument.starts_with('"') || end == std::string_view::npos || end == 1)
            throw NotIncluded(where, "#include needs a file name in double quotes");
        const auto [path, text] = found(std::string(argument.substr(1, end - 1)), where);
        if (std::find(open_.begin(), open_.end(), path) != open_.end())
            throw NotIncluded(where, fmt::format("{} includes itself", shown(path)));
        if (source_.bindings == nullptr) // a shipped stage with a file of the user's in it
            source_.bindings = bindings_beside(path);
        append(path, text);
    }

    /// In the folders; else beside the file that includes it, as libraries' files do each other.
    File found(const std::string& name, const std::string& where) const try {
        return find(folders_, texts_, name, where);
    } catch (const NotIncluded&) {
        const fs::path beside = (open_.back().parent_path() / name).lexically_normal();
        if (const std::optional<std::string> text = open_.size() > 1 ? text_of(beside) : std::nullopt)
            return {beside, *text};
        throw;
    }

    const ShaderFolders& folders_;
    const ShaderDefines& defines_;
    const ShaderTexts& texts_;
    ShaderSource source_;
    std::vector<fs::path> open_; ///< files being read, outermost first
    bool takes_any_dialect_ = false, has_version_ = false;
    int conditions_ = 0; ///< that the line lies in
};

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

/// A shipped fragment stage reads what a user's stage before it writes under names of its own.
void rename_inputs(const fs::path& fragment, const Bindings* before, ShaderDefines& defines) {
    if (before == nullptr || bindings_beside(fragment) != nullptr)
        return;
    for (const auto& [theirs, ours] : before->outputs)
        defines.emplace_back(ours, theirs);
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

bool says_precise(const ShaderSource& stage) {
    return stage.module != nullptr ? stage.module->says_precise : says(stage.text, "precise");
}

bool asks_length(const ShaderSource& stage) {
    return stage.module != nullptr || stage.text.find(".length()") != std::string::npos;
}

ShadersReadOnce::ShadersReadOnce() { seen = std::make_unique<Seen>(); }
ShadersReadOnce::~ShadersReadOnce() { seen.reset(); }

std::vector<std::pair<fs::path, std::optional<std::string>>> shaders_read() {
    if (!seen)
        return {};
    return {seen->files.begin(), seen->files.end()};
}

ShaderFolders shader_folders(const fs::path& user, std::string_view system) {
    ShaderFolders folders;
    if (!user.empty()) {
        if (!is_folder(user))
            throw Error(
                fmt::format("shader folder {} {}", user.string(),
                            fs::exists(user) ? "is a file; right is the folder that has it" : "does not exist"));
        folders.push_back(user);
    }
    const fs::path shared = built_in_shaders();
    if (!system.empty() && is_folder(shared / system))
        folders.push_back(shared / system);
    folders.push_back(shared);
    return folders;
}

ShaderDefines choice_defines(std::string_view name, std::span<const std::string_view> values, std::size_t chosen) {
    ShaderDefines defines;
    const std::string word = upper(name);
    for (std::size_t i = 0; i < values.size(); ++i)
        defines.emplace_back(fmt::format("{}_{}", word, upper(values[i])), std::to_string(i));
    defines.emplace_back(word, fmt::format("{}_{}", word, upper(values[chosen])));
    return defines;
}

ShaderDefines arithmetic_defines(ArithmeticSwitch arithmetic) {
    static constexpr std::array<std::string_view, 2> values{"plain", "exact"};
    return choice_defines("arithmetic", values, static_cast<std::size_t>(arithmetic));
}

ShaderSource load_stage(const ShaderFolders& folders, std::string_view name, Stage stage,
                        const ShaderDefines& defines) {
    const ShaderTexts none;
    const auto [path, text] = find(folders, none, fmt::format("{}{}", name, extension(stage)), "");
    return Assembly(folders, defines, none).assemble(path, text, stage);
}

ShaderSource load_any_dialect(const fs::path& file, Stage stage, const ShaderDefines& defines) {
    const std::optional<std::string> text = text_of(file);
    if (!text)
        throw Error(fmt::format("{}: no such file", shown(file)));
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    return Assembly(shader_folders(folder), defines, {}, true).assemble(file, *text, stage);
}

ShaderSource continued(ShaderSource stage, const ShaderSource& end) {
    const std::size_t files = stage.files.size();
    stage.text += end.text.substr(end.text.find('\n') + 1);
    stage.files.insert(stage.files.end(), end.files.begin(), end.files.end());
    for (std::size_t line = 1; line < end.origins.size(); ++line)
        stage.origins.push_back({files + end.origins[line].file, end.origins[line].line});
    return stage;
}

std::vector<ShaderSource> load_stages(const ShaderFolders& folders, std::string_view name,
                                      std::span<const Stage> stages, const ShaderDefines& defines,
                                      const ShaderTexts& texts) {
    std::vector<ShaderSource> sources;
    for (const Stage stage : stages) {
        const auto [path, text] = find(folders, texts, fmt::format("{}{}", name, extension(stage)), "");
        if (blank(text) && stage != Stage::geometry)
            throw Error(fmt::format("shader {}: is empty; only a geometry stage can be left out", shown(path)));
        if (blank(text))
            continue;
        ShaderDefines all = defines;
        if (stage == Stage::fragment && !sources.empty())
            rename_inputs(path, sources.back().bindings.get(), all);
        sources.push_back(Assembly(folders, all, texts).assemble(path, text, stage));
    }
    return sources;
}

void give_bindings(const fs::path& folder, std::string text) {
    if (!given_bindings().emplace(folder_key(folder), std::move(text)).second)
        throw Error(
            fmt::format("names of {}: they are given already; right is one NamedShaders at a time", shown(folder)));
}

void take_bindings(const fs::path& folder) noexcept { given_bindings().erase(folder_key(folder)); }

} // namespace lockstep
