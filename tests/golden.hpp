#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "crosscheck/scene/scene_file.hpp"
#include "tests/skip.hpp"

namespace lockstep::test {

/// One of the hashes kept in data/golden: the state after some frames of a shipped scene.
struct Golden {
    std::string scene; ///< its name
    std::string preset;
    std::string profile;
    std::string hash;
    int frames = 0;
    std::size_t particles = 0;
    std::string no_mesh; ///< why the scene has not the mesh that the hash is of; empty: it has

    [[nodiscard]] std::optional<Scene> load() const {
        if (!no_mesh.empty())
            return std::nullopt;
        return load_scene("data/scenes/" + scene + ".json", {particles, preset, {}});
    }
};

inline std::set<std::string> json_files(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.insert(entry.path().stem());
    return names;
}

inline nlohmann::json read_json_file(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return nlohmann::json::parse(stream);
}

/// The CRC-32 of a scene's mesh, eight hexadecimal digits; empty where it has not been fetched. Releases of the library
/// that reduces it make different meshes of the same faces.
inline std::string mesh_crc(const std::string& scene) {
    const nlohmann::json file = read_json_file("data/scenes/" + scene + ".json");
    for (const nlohmann::json& obstacle : file.at("obstacles"))
        if (obstacle.contains("file")) {
            std::ifstream stream("data/scenes/" + obstacle.at("file").get<std::string>(), std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
            return text.empty() ? "" : fmt::format("{:08x}", crc32(0, bytes, static_cast<uInt>(text.size())));
        }
    return {};
}

/// All of them, of the meshes that are there. scripts/golden_hashes.py writes them anew.
inline std::vector<Golden> golden_hashes() {
    std::vector<Golden> all;
    for (const std::string& scene : json_files("data/golden")) {
        const nlohmann::json file = read_json_file("data/golden/" + scene + ".json");
        nlohmann::json of_mesh = file.value("hashes", nlohmann::json());
        std::string no_mesh;
        if (file.contains("meshes")) {
            const std::string mesh = mesh_crc(scene);
            if (mesh.empty())
                no_mesh = "no mesh; scripts/fetch_meshes.sh fetches it";
            else if (!file["meshes"].contains(mesh))
                no_mesh = fmt::format("its mesh, CRC-32 {}, is not one of data/golden/{}.json", mesh, scene);
            of_mesh = no_mesh.empty() ? file["meshes"][mesh] : file["meshes"].front();
        }
        for (const auto& [preset, hashes] : of_mesh.items())
            for (const auto& [profile, hash] : hashes.items())
                all.push_back({scene, preset, profile, hash, file.at("frames"), file.at("particles"), no_mesh});
    }
    return all;
}

/// Reports the scenes whose hashes cannot be held here: one without its mesh has proved nothing.
inline void skip_missing_meshes() {
    std::map<std::string, std::set<std::string>> scenes;
    for (const Golden& golden : golden_hashes())
        if (!golden.no_mesh.empty())
            scenes[golden.no_mesh].insert(golden.scene);
    for (const auto& [why, missing] : scenes)
        skip(fmt::format("golden hashes of {}: {}", fmt::join(missing, ", "), why),
             mesh_crc(*missing.begin()).empty() ? "LOCKSTEP_REQUIRE_MESHES" : "");
}

} // namespace lockstep::test
