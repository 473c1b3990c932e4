#include "gpu/data_folder.hpp"

#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

/// Where lockstep's own files may lie.
struct DataFolder {
    fs::path shaders;
    fs::path scenes;
};

DataFolder installed(const fs::path& share) { return {share / "shaders", share / "scenes"}; }
DataFolder source_tree(const fs::path& root) { return {root / "shaders", root / "data" / "scenes"}; }

fs::path& package_data() {
    static fs::path folder;
    return folder;
}

/// Without $LOCKSTEP_DATA, in the order they are looked into.
std::vector<DataFolder> data_folders() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<DataFolder> folders;
    if (!error)
        folders.push_back(installed(program.parent_path().parent_path() / "share" / "lockstep"));
    if (!package_data().empty())
        folders.push_back(installed(package_data()));
    folders.push_back(source_tree(LOCKSTEP_SOURCE_TREE));
    return folders;
}

/// Empty if it is not set.
fs::path asked_for() {
    const char* folder = std::getenv("LOCKSTEP_DATA");
    return folder != nullptr ? folder : "";
}

std::string listed(const std::vector<fs::path>& paths) {
    std::string text;
    for (const fs::path& path : paths)
        text += fmt::format("{}{}", text.empty() ? "" : " or ", path.string());
    return text;
}

} // namespace

fs::path built_in_shaders() {
    std::error_code error;
    if (const fs::path data = asked_for(); !data.empty()) {
        fs::path folder = data / "shaders";
        if (!fs::is_directory(folder, error))
            throw Error(fmt::format("LOCKSTEP_DATA is {}, but there is no folder {}", data.string(), folder.string()));
        return folder;
    }
    std::vector<fs::path> tried;
    for (const DataFolder& folder : data_folders()) {
        if (fs::is_directory(folder.shaders, error))
            return folder.shaders;
        tried.push_back(folder.shaders);
    }
    throw Error(
        fmt::format("no built-in shaders in {}; set LOCKSTEP_DATA to the folder that holds shaders/", listed(tried)));
}

fs::path shipped_scene(std::string_view name) {
    std::vector<DataFolder> folders = data_folders();
    if (const fs::path data = asked_for(); !data.empty())
        folders = {installed(data), source_tree(data)};
    std::error_code error;
    std::vector<fs::path> tried;
    for (const DataFolder& folder : folders) {
        fs::path file = folder.scenes / fmt::format("{}.json", name);
        if (fs::is_regular_file(file, error))
            return file;
        tried.push_back(folder.scenes);
    }
    throw Error(fmt::format("no scene {} in {}", name, listed(tried)));
}

bool use_package_data(const fs::path& folder) {
    package_data() = folder;
    return true;
}

const fs::path& package_data_folder() { return package_data(); }

} // namespace lockstep
