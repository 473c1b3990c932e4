#include "crosscheck/gnuplot.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// A temporary file with what gnuplot is to do.
class ScriptFile {
  public:
    explicit ScriptFile(const std::string& script)
        : path_((std::filesystem::temp_directory_path() / "lockstep-chart-XXXXXX").string()) {
        const int file = mkstemp(path_.data());
        const bool written = file >= 0 && write(file, script.data(), script.size()) == std::ssize(script);
        if (file >= 0)
            close(file);
        if (!written)
            throw Error(fmt::format("chart: {} cannot be written", path_));
    }
    ~ScriptFile() { std::remove(path_.c_str()); }
    ScriptFile(const ScriptFile&) = delete;
    ScriptFile& operator=(const ScriptFile&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

} // namespace

std::optional<std::string> run_gnuplot(const std::string& script) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
        return {};
    const ScriptFile file(script);
    std::FILE* gnuplot = popen(fmt::format("gnuplot '{}'", file.path()).c_str(), "r");
    if (gnuplot == nullptr)
        throw Error("chart: gnuplot cannot be started");
    std::string output;
    std::array<char, 4096> part{};
    while (const std::size_t size = std::fread(part.data(), 1, part.size(), gnuplot))
        output.append(part.data(), size);
    if (pclose(gnuplot) != 0 || output.empty())
        throw Error("chart: gnuplot failed; its message stands above");
    return output;
}

std::string gnuplot_quoted(std::string_view text) {
    std::string out(1, '\'');
    for (const char c : text) {
        if (c == '\'')
            out += c;
        out += c;
    }
    out += '\'';
    return out;
}

} // namespace lockstep
