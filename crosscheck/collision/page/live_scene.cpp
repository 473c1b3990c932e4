#include "crosscheck/collision/page/live_scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/scene/scene_settings.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/shader_source.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little);

constexpr std::array presets{"paper", "corrected", "exact"};

template <class Element> void add_words(Blob& blob, std::span<const Element> elements) {
    std::vector<std::uint32_t> words(elements.size_bytes() / sizeof(std::uint32_t));
    if (!words.empty())
        std::memcpy(words.data(), elements.data(), elements.size_bytes());
    blob.words(words);
}

template <class Element> void add_words(Blob& blob, const std::vector<Element>& elements) {
    add_words(blob, std::span<const Element>(elements));
}

void add_matrices(Blob& blob, const Scene& scene, int frames, glm::mat4 FrameParams::*member) {
    std::vector<glm::mat4> all;
    for (int frame = 0; frame < frames; ++frame)
        all.push_back(frame_params(scene, frame).*member);
    add_words(blob, all);
}

Blob arrays(const Scene& scene, int frames) {
    Blob blob;
    const View start = view(scene.start);
    for (std::size_t f = 0; f < start.columns.size(); ++f)
        add_words(blob, std::span(start.columns[f], start.count() * sizeof(std::uint32_t) *
                                                        static_cast<std::size_t>(start.fields()[f].components)));
    add_words(blob, scene.obstacles.positions);
    add_words(blob, scene.obstacles.indices);
    add_matrices(blob, scene, frames, &FrameParams::collision_proj_view);
    add_matrices(blob, scene, frames, &FrameParams::render_view);
    add_matrices(blob, scene, frames, &FrameParams::render_projection);
    return blob;
}

json vector(glm::vec3 v) { return {v.x, v.y, v.z}; }

/// Where each field stands in a particle's record of words, by what name shaders know it, and its number in the hash.
json record_json(const RecordLayout& layout) {
    json fields = json::array();
    std::size_t offset = 0;
    for (const RecordLayout::Member& member : layout.members) {
        const Field& field = layout.field(member);
        fields.push_back({{"name", field.name},
                          {"shader", member.name},
                          {"components", field.components},
                          {"offset", offset},
                          {"column", layout.schema->column({layout.resource, member.field})}});
        offset += static_cast<std::size_t>(field.components);
    }
    return {{"words", offset}, {"fields", fields}};
}

/// `own`, but for the switches that make up presets.
Switches with_preset(const Switches& own, std::string_view name) {
    Switches result = own;
    for (const SwitchInfo& info : switch_table())
        for (const std::string_view other : preset_names())
            if (const std::string wanted = switch_value(preset(name), info.name);
                wanted != switch_value(preset(other), info.name))
                set_switch(result, info.name, wanted);
    return result;
}

json reference(const Scene& scene, int frames, const Profile& profile) {
    json particles = json::array();
    json cdts = json::array();
    ReferenceSimulation simulation(scene, profile);
    for (int frame = 0; frame < frames; ++frame) {
        simulation.step(frame_params(scene, frame));
        particles.push_back(hash_text(state_hash(simulation.particles())));
        cdts.push_back(hash_text(state_hash(simulation.cdt())));
    }
    return {{"profile", profile.name}, {"particle_hashes", particles}, {"cdt_hashes", cdts}};
}

json run(const Scene& scene, const std::string& name, int frames, std::span<const Profile> profiles) {
    const bool exact = scene.switches.arithmetic == ArithmeticSwitch::exact;
    json definitions = json::array();
    for (const auto& [symbol, value] : switch_defines(scene.switches))
        definitions.push_back({symbol, value});
    json references = json::array();
    for (const Profile& profile : exact ? profiles.first(1) : profiles)
        references.push_back(reference(scene, frames, profile));
    return {{"name", name},
            {"exact", exact},
            {"settings", settings_json(scene)},
            {"definitions", definitions},
            {"cdt_format", switch_value(scene.switches, "cdt_format")},
            {"obstacles_in_cdt", switch_value(scene.switches, "obstacles_in_cdt")},
            {"speed_factor", scene.switches.speed_factor},
            {"references", references}};
}

std::string why_unavailable(const Scene& scene) {
    if (scene.switches.search == Search::octree)
        return "search = octree runs in a compute shader, which WebGL2 does not have";
    if (scene.switches.search == Search::depth)
        return "search = depth runs in a compute shader, which WebGL2 does not have";
    if (scene.switches.step == Step::compute)
        return "step = compute runs in compute shaders, which WebGL2 does not have";
    if (has_remedies(scene.switches))
        return "the layered collision pass (cdt_layers, cdt_cameras, search_window, response) is not in it";
    if (!scene.frames.empty() || scene.clip_space != ClipSpace{})
        return "clip_space and frames, which an engine recorded, are not in it";
    if (scene.start.size() > most_live_particles)
        return fmt::format("of {} particles the page would grow too large; it takes {}", scene.start.size(),
                           most_live_particles);
    return {};
}

} // namespace

LiveScene live_scene(const Scene& scene, int frames, const Profile& profile) {
    if (const std::string reason = why_unavailable(scene); !reason.empty())
        return {{{"unavailable", reason}}, {}};
    frames = std::min(frames, most_live_frames);
    const int checked = std::min(frames, most_checked_frames);
    std::vector<Profile> profiles{named_profile("strict")};
    if (!computes_alike(profile, profiles.front()))
        profiles.push_back(profile);
    const Constants& constants = scene.constants;
    json runs = json::array();
    Scene variant = scene;
    bool own_is_preset = false;
    for (const char* name : presets) {
        variant.switches = with_preset(scene.switches, name);
        own_is_preset = own_is_preset || variant.switches == scene.switches;
        runs.push_back(run(variant, name, checked, profiles));
    }
    if (!own_is_preset)
        runs.push_back(run(scene, "as checked", checked, profiles));
    json head{{"scene", scene.name},
              {"particles", scene.start.size()},
              {"record", record_json(particle_records())},
              {"corners", scene.obstacles.positions.size()},
              {"triangles", scene.obstacles.triangle_count()},
              {"frames", frames},
              {"checked_frames", checked},
              {"width", scene.width},
              {"height", scene.height},
              {"render_width", scene.render_width},
              {"render_height", scene.render_height},
              {"cdt_box", {{"min", vector(scene.cdt_box.min)}, {"max", vector(scene.cdt_box.max)}}},
              {"constants",
               {{"tick", constants.tick},
                {"gravity", vector(constants.gravity)},
                {"collision_range", constants.collision_range},
                {"collision_time", constants.collision_time},
                {"texel_collide_range", constants.texel_collide_range},
                {"billboard_radius", constants.billboard_radius}}},
              {"runs", std::move(runs)}};
    return {std::move(head), arrays(scene, frames)};
}

} // namespace lockstep
