#include "crosscheck/files/run_inputs.hpp"

#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/read_files.hpp"
#include "crosscheck/files/sha256.hpp"
#include "gpu/data_folder.hpp"
#include "gpu/shaders_read_once.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace fs = std::filesystem;
namespace {

/// The folder that has shaders/ and data/; empty: there is none.
fs::path data_folder() {
    try {
        return built_in_shaders().parent_path();
    } catch (const Error&) {
        return {};
    }
}

std::string name_of(const fs::path& file, const fs::path& data) {
    const fs::path inside = data.empty() ? fs::path() : fs::absolute(file).lexically_normal().lexically_relative(data);
    return inside.empty() || *inside.begin() == ".." ? file.string() : inside.string();
}

std::string state(const InputDigests& digests, const std::string& name) {
    const auto found = digests.find(name);
    if (found == digests.end())
        return "was not looked for";
    return found->second.empty() ? "is absent" : fmt::format("is {}...", found->second.substr(0, 12));
}

} // namespace

InputDigests input_digests() {
    const fs::path data = data_folder();
    InputDigests all;
    for (const auto& [file, text] : shaders_read())
        all.emplace(name_of(file, data), text ? sha256_of(std::as_bytes(std::span(*text))) : std::string());
    for (const auto& [file, digest] : noted_files())
        if (!digest.empty())
            all.emplace(name_of(file, data), digest);
    return all;
}

std::string input_difference(const InputDigests& one, const InputDigests& other) {
    InputDigests both = one;
    both.insert(other.begin(), other.end());
    for (const auto& [name, any] : both)
        if (const std::string here = state(one, name), there = state(other, name); here != there)
            return fmt::format("{} {}, there it {}", plain_line(name), here, there);
    return {};
}

nlohmann::json inputs_json(const InputDigests& inputs) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, digest] : inputs)
        if (!digest.empty())
            json[name] = digest;
    return json;
}

std::string inputs_text(const InputDigests& inputs) {
    std::string list;
    std::size_t count = 0;
    for (const auto& [name, digest] : inputs)
        if (!digest.empty()) {
            list += fmt::format("{}  {}\n", digest, name);
            ++count;
        }
    return fmt::format("{} files, SHA-256 of their list {}", count, sha256_of(std::as_bytes(std::span(list))));
}

std::vector<fs::path> files_read() {
    std::vector<fs::path> all;
    for (const auto& [file, text] : shaders_read())
        if (text)
            all.push_back(file);
    for (const auto& [file, digest] : noted_files())
        all.push_back(file);
    return all;
}

} // namespace lockstep
