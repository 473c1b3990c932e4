#include "crosscheck/report/page/template.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/files/read_files.hpp"
#include "gpu/data_folder.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> places() {
    if (const char* data = std::getenv("LOCKSTEP_DATA"); data != nullptr && *data != '\0')
        return {fs::path(data) / "report.html"};
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<fs::path> all{program.parent_path().parent_path() / "share" / "lockstep" / "report.html"};
    if (!package_data_folder().empty())
        all.push_back(package_data_folder() / "report.html");
    all.emplace_back(LOCKSTEP_REPORT_PAGE);
    return all;
}

} // namespace

std::string report_page_template() {
    for (const fs::path& path : places()) {
        std::ifstream stream(path, std::ios::binary);
        std::ostringstream text;
        if (!stream || !(text << stream.rdbuf()))
            continue;
        if (text.str().find(page_data_marker) == std::string::npos)
            throw Error(
                fmt::format("report: {} has no place for data; run scripts/build_report_page.sh again", path.string()));
        note_opened(path);
        return text.str();
    }
    throw Error(fmt::format("report: the page is not built, there is no {}; run scripts/build_report_page.sh",
                            places().back().string()));
}

} // namespace lockstep
