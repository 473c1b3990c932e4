#include "gpu/shader_log.hpp"

#include <array>
#include <cstdlib>
#include <regex>
#include <sstream>

#include <fmt/format.h>

namespace lockstep {
namespace {

/// Calls `visit` with each line until it returns true.
template <class Visit> void find_line(const std::string& log, const Visit& visit) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\0'))
            line.pop_back();
        if (!line.empty() && visit(line))
            return;
    }
}

} // namespace

std::string first_link_error(const std::string& log) {
    static const std::regex error("error", std::regex::icase);
    std::string first;
    std::string found;
    find_line(log, [&](const std::string& line) {
        if (first.empty())
            first = line;
        if (std::regex_search(line, error))
            found = line;
        return !found.empty();
    });
    if (first.empty())
        return "the driver gives no reason";
    return found.empty() ? first : found;
}

std::string first_compile_error(const std::string& log, const ShaderSource& source) {
    static const std::array forms{
        std::regex(R"(^\d+:(\d+)\(\d+\): (?:preprocessor )?error: (.*)$)"), // Mesa
        std::regex(R"(^\d+\((\d+)\) : error (.*)$)"),                       // NVIDIA
        std::regex(R"(^ERROR: \d+:(\d+): (.*)$)"),                          // others
    };
    std::string result;
    find_line(log, [&](const std::string& line) {
        for (const std::regex& form : forms) {
            std::smatch match;
            if (!std::regex_match(line, match, form))
                continue;
            const std::size_t number = std::strtoul(match[1].str().c_str(), nullptr, 10);
            if (number < 1 || number > source.origins.size())
                continue;
            const ShaderSource::Origin& origin = source.origins[number - 1];
            result = fmt::format("{}:{}: {}", source.files[origin.file], origin.line, match[2].str());
        }
        return !result.empty();
    });
    return result.empty() ? fmt::format("{}: {}", source.files.front(), first_link_error(log)) : result;
}

} // namespace lockstep
