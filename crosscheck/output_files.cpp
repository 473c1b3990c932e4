#include "crosscheck/output_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

/// The folders that make_directories would make, outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code error;
    for (fs::path path = folder; !path.empty() && !fs::exists(fs::symlink_status(path, error));
         path = path.parent_path())
        missing.insert(missing.begin(), path);
    return missing;
}

} // namespace

OutputFiles::~OutputFiles() {
    files_.clear();
    std::error_code ignored;
    for (auto folder = new_folders_.rbegin(); folder != new_folders_.rend(); ++folder)
        fs::remove(*folder, ignored);
}

void OutputFiles::expect(const fs::path& file) {
    if (std::find(expected_.begin(), expected_.end(), file.lexically_normal()) != expected_.end())
        throw Error(fmt::format("{}: cannot be written: two outputs have this name", file.string()));
    const AtomicFile proof(file);
    expected_.push_back(file.lexically_normal());
}

void OutputFiles::expect_folder(const fs::path& folder) {
    for (const fs::path& path : missing_folders(folder)) {
        std::error_code failed;
        if (fs::create_directory(path, failed); failed)
            throw Error(fmt::format("{}: cannot be made: {}", path.string(), failed.message()));
        new_folders_.push_back(path);
    }
    if (!fs::is_directory(folder))
        throw Error(fmt::format("{}: cannot be made a folder: a file of that name is in the way", folder.string()));
    const AtomicFile proof(folder / "lockstep");
}

void OutputFiles::write(const fs::path& file, std::string content) {
    files_.emplace_back(file);
    files_.back().write(std::move(content));
}

void OutputFiles::commit() {
    for (std::size_t i = 0; i < files_.size(); ++i)
        try {
            files_[i].commit();
        } catch (...) {
            std::error_code ignored;
            for (std::size_t done = 0; done < i; ++done)
                fs::remove(files_[done].path(), ignored);
            throw;
        }
    files_.clear();
    new_folders_.clear();
}

} // namespace lockstep
