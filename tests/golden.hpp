#pragma once
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"

namespace lockstep::test {

/// One of the hashes kept in data/golden: the state after some frames of a shipped scene.
struct Golden {
    std::string scene; ///< its name
    std::string preset;
    std::string profile;
    std::string hash;
    int frames = 0;
    std::size_t particles = 0;

    /// Nothing where the scene's mesh has not been fetched.
    [[nodiscard]] std::optional<Scene> load() const {
        try {
            return load_scene("data/scenes/" + scene + ".json", {particles, preset, {}});
        } catch (const Error& error) {
            if (std::string(error.what()).find("no such mesh") == std::string::npos)
                throw;
            return std::nullopt;
        }
    }
};

inline std::set<std::string> json_files(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.insert(entry.path().stem());
    return names;
}

/// All of them. scripts/golden_hashes.sh writes them anew.
inline std::vector<Golden> golden_hashes() {
    std::vector<Golden> all;
    for (const std::string& scene : json_files("data/golden")) {
        std::ifstream stream("data/golden/" + scene + ".json");
        const nlohmann::json file = nlohmann::json::parse(stream);
        for (const auto& [preset, hashes] : file.at("hashes").items())
            for (const auto& [profile, hash] : hashes.items())
                all.push_back({scene, preset, profile, hash, file.at("frames"), file.at("particles")});
    }
    return all;
}

/// Empty where every mesh has been fetched; else what is not held here, and how it would be.
inline std::string scenes_without_mesh() {
    std::set<std::string> missing;
    for (const Golden& golden : golden_hashes())
        if (golden.preset == "exact" && golden.profile == "strict" && !golden.load())
            missing.insert(golden.scene);
    std::string text;
    for (const std::string& scene : missing)
        text += (text.empty() ? "golden hashes of " : ", ") + scene;
    return text.empty() ? text : text + ": no mesh; scripts/fetch_meshes.sh fetches it";
}

} // namespace lockstep::test
