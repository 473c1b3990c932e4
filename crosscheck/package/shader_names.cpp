#include "lockstep/shader_names.hpp"

#include <nlohmann/json.hpp>

#include "gpu/shader_source.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

json names_json(const ShaderNames::Names& names) {
    json all = json::object();
    for (const auto& [theirs, ours] : names)
        all[theirs] = std::visit([](const auto& value) { return json(value); }, ours.value());
    return all;
}

} // namespace

std::string ShaderNames::json() const {
    nlohmann::json document{{"uniforms", names_json(uniforms)},
                            {"uniform_blocks", nlohmann::json::object()},
                            {"storage_blocks", nlohmann::json::object()},
                            {"attributes", attributes},
                            {"outputs", outputs}};
    for (const auto& [block, members] : uniform_blocks)
        document["uniform_blocks"][block] = names_json(members);
    for (const auto& [block, given] : storage_blocks)
        document["storage_blocks"][block] = std::holds_alternative<Names>(given)
                                                ? names_json(std::get<Names>(given))
                                                : nlohmann::json(std::get<std::string>(given));
    return document.dump(2);
}

NamedShaders::NamedShaders(const std::filesystem::path& folder, const ShaderNames& names) : folder_(folder) {
    give_bindings(folder_, names.json());
}

NamedShaders::~NamedShaders() { take_bindings(folder_); }

} // namespace lockstep
