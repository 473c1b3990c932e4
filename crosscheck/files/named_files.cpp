#include "crosscheck/files/named_files.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "crosscheck/files/base64.hpp"
#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t largest_named_file = std::uint64_t{64} << 20U;

std::string bytes_of(const std::filesystem::path& file, std::string_view kind) {
    const OpenedFile opened(file, kind);
    if (opened.size() > largest_named_file)
        throw Error(fmt::format("{}: {} bytes; right is a {} of at most {}", file.string(), opened.size(), kind,
                                largest_named_file));
    return opened.text();
}

} // namespace

NamedFiles::File NamedFiles::read(const JsonValue& named, std::string_view kind) {
    const std::string name = named.text();
    if (name.empty() || name.find('\0') != std::string::npos)
        named.fail("names no file");
    const std::filesystem::path beside = std::filesystem::path(named.file()).parent_path() / name;
    auto known = contents_.find(name);
    if (known == contents_.end() && is_carried_)
        named.fail(
            fmt::format("names {}, which this file does not carry along; right is to make it anew from the scene",
                        plain_line(name)));
    if (known == contents_.end()) {
        known = contents_.emplace(name, bytes_of(beside, kind)).first;
        places_.push_back(beside.lexically_normal());
    }
    return {is_carried_ ? fmt::format("{}: {}", named.file(), name) : beside.string(), known->second};
}

nlohmann::json carried_json(const NamedFiles::Contents& contents) {
    nlohmann::json all = nlohmann::json::object();
    for (const auto& [name, bytes] : contents)
        all[name] = base64(bytes);
    return all;
}

NamedFiles::Contents read_carried(const JsonValue& json) {
    NamedFiles::Contents all;
    for (const std::string& name : json.keys()) {
        const JsonValue carried = json.at(name);
        const std::optional<std::string> bytes = bytes_of_base64(carried.text());
        if (!bytes)
            carried.fail("is no base64");
        all[name] = *bytes;
    }
    return all;
}

} // namespace lockstep
