#include "gpu/declaration.hpp"

#include <regex>
#include <sstream>

#include <fmt/format.h>

namespace lockstep {

Declaration find_declaration(std::span<const ShaderSource> stages, std::string_view qualifier, std::string_view name) {
    const std::regex declares(
        fmt::format(R"(^(?:.*[\s;}}])?{}\s[^;]*\b{}\b\s*(?:\[[^\]]*\])?\s*(=)?)", qualifier, name));
    for (const ShaderSource& stage : stages) {
        std::istringstream lines(stage.text);
        std::string line;
        for (const ShaderSource::Origin& origin : stage.origins) {
            std::getline(lines, line);
            std::smatch match;
            const std::string code = line.substr(0, line.find("//"));
            if (std::regex_search(code, match, declares))
                return {fmt::format("{}:{}", stage.files[origin.file], origin.line), match[1].matched};
        }
    }
    return {stages.empty() ? std::string() : stages.front().files.front()};
}

} // namespace lockstep
