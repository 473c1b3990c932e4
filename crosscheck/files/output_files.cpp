#include "crosscheck/files/output_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/files/signals.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

bool any = false;

/// The folders that make_directories would make, outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code error;
    for (fs::path path = folder.has_filename() ? folder : folder.parent_path();
         !path.empty() && !fs::exists(fs::symlink_status(path, error)); path = path.parent_path())
        missing.insert(missing.begin(), path);
    return missing;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
    throw Error(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

using Identities = std::map<FileIdentity, fs::path>;

/// Throws Error where an output is one of `inputs`, or a file that the program has read so far.
void expect_no_inputs(Identities inputs, const Identities& outputs) {
    std::error_code error;
    for (const fs::path& input : files_read())
        if (fs::is_regular_file(input, error))
            inputs.emplace(identity_of(input), input);
    for (const auto& [identity, file] : outputs)
        if (const auto input = inputs.find(identity); input != inputs.end())
            refuse(file, input->second == file ? "the run reads it"
                                               : fmt::format("it is {}, which the run reads", input->second.string()));
}

/// Options in the wrong order: a shader's name where the report's was meant. New shaders are written by `new system`.
void expect_no_shader(const fs::path& file) {
    static constexpr std::array shaders{".vert", ".tesc", ".tese", ".geom", ".frag", ".comp", ".glsl", ".spv"};
    if (fs::exists(file) && std::ranges::find(shaders, file.extension().string()) != shaders.end())
        throw Error(
            fmt::format("{}: cannot be written: it is a shader by its name; expected another for what the run makes",
                        plain_line(file.string())));
}

} // namespace

OutputFiles::OutputFiles() = default;

OutputFiles::~OutputFiles() {
    files_.clear();
    while (!new_folders_.empty())
        new_folders_.pop_back();
}

bool OutputFiles::any_expected() { return any; }

void OutputFiles::protect(const fs::path& input) {
    std::error_code error;
    if (fs::is_directory(input, error)) {
        for (const auto& entry : fs::directory_iterator(input, error))
            if (entry.is_regular_file(error))
                inputs_.emplace(identity_of(entry.path()), entry.path());
    } else if (fs::is_regular_file(input, error)) {
        inputs_.emplace(identity_of(input), input);
    }
}

AtomicFile& OutputFiles::add(const fs::path& file) {
    AtomicFile proof(file);
    const FileIdentity identity = proof.identity();
    const auto [other, is_new] = outputs_.emplace(identity, file);
    if (!is_new && !proof.in_place())
        refuse(file, other->second.lexically_normal() == file.lexically_normal()
                         ? "two outputs have this name"
                         : fmt::format("it is {}, another output", other->second.string()));
    expect_no_inputs(inputs_, outputs_);
    return files_.emplace(file, std::move(proof)).first->second;
}

void OutputFiles::expect(const fs::path& file) {
    any = true;
    add(file);
}

std::string OutputFiles::written_text() const {
    std::string text;
    for (const fs::path& file : named_)
        text += fmt::format("{}{}", text.empty() ? "written   " : ", ", plain_line(file.string()));
    return text.empty() ? text : text + "\n";
}

void OutputFiles::make_folder(const fs::path& folder) {
    for (const fs::path& path : missing_folders(folder)) {
        Temporary made(path);
        std::error_code failed;
        if (!fs::create_directory(path, failed))
            made.keep(); // another run was faster, or it cannot be
        if (failed)
            throw Error(fmt::format("{}: cannot be made: {}", path.string(), failed.message()));
        if (!made.empty())
            new_folders_.push_back(std::move(made));
    }
}

void OutputFiles::expect_folder(const fs::path& folder, std::span<const std::string_view> names) {
    any = true;
    make_folder(folder);
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw Error(fmt::format("{}: cannot be made a folder: a file of that name is in the way", folder.string()));
    if (names.empty())
        const AtomicFile proof(temporary_name(folder / "proof"));
    for (const std::string_view name : names)
        add(folder / name);
    folders_.push_back(folder);
}

void OutputFiles::write(const fs::path& file, std::string content) {
    // A run that failed may have taken the folder away that it had made.
    if (std::find(folders_.begin(), folders_.end(), file.parent_path()) != folders_.end())
        make_folder(file.parent_path());
    const auto expected = files_.find(file);
    (expected == files_.end() ? add(file) : expected->second).write(std::move(content));
    written_.push_back(file);
}

void OutputFiles::commit() {
    expect_no_inputs(inputs_, outputs_); // what was read since they were named
    for (const fs::path& file : written_)
        expect_no_shader(file);
    // What cannot be undone comes first; a pipe may have to be waited for.
    const auto whole = std::stable_partition(written_.begin(), written_.end(),
                                             [&](const fs::path& file) { return files_.at(file).in_place(); });
    for (auto path = written_.begin(); path != whole; ++path)
        files_.at(*path).commit();
    const SignalsWait wait;
    for (auto path = whole; path != written_.end(); ++path)
        try {
            files_.at(*path).commit();
        } catch (...) {
            while (path != whole)
                files_.at(*--path).undo();
            throw;
        }
    named_.insert(named_.end(), whole, written_.end());
    files_.clear();
    written_.clear();
    for (Temporary& folder : new_folders_)
        folder.keep();
    new_folders_.clear();
}

} // namespace lockstep
