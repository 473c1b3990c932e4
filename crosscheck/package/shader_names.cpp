#include "lockstep/shader_names.hpp"

#include <nlohmann/json.hpp>

#include "gpu/shader_source.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::json;

Json names_json(const ShaderNames::Names& names) {
    Json all = Json::object();
    for (const auto& [theirs, ours] : names) {
        Json list = Json::array();
        for (const NameOrNumber& one : ours.values)
            list.push_back(std::visit([](const auto& value) { return Json(value); }, one.value));
        all[theirs] = ours.is_list ? list : list.front();
    }
    return all;
}

} // namespace

std::string ShaderNames::json() const {
    Json document{{"uniforms", names_json(uniforms)},
                  {"uniform_blocks", Json::object()},
                  {"storage_blocks", Json::object()},
                  {"attributes", attributes},
                  {"outputs", outputs}};
    for (const auto& [block, members] : uniform_blocks)
        document["uniform_blocks"][block] = names_json(members);
    for (const auto& [block, given] : storage_blocks)
        document["storage_blocks"][block] = std::holds_alternative<Names>(given) ? names_json(std::get<Names>(given))
                                                                                 : Json(std::get<std::string>(given));
    return document.dump(2);
}

NamedShaders::NamedShaders(const std::filesystem::path& folder, const ShaderNames& names) : folder_(folder) {
    give_bindings(folder_, names.json());
}

NamedShaders::~NamedShaders() { take_bindings(folder_); }

} // namespace lockstep
