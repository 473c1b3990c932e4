#include "crosscheck/scene/scene_frames.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/scene/scene_constants.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
namespace {

constexpr std::array clip_depths{ClipDepth{-1.0F, 1.0F}, ClipDepth{0.0F, 1.0F}, ClipDepth{1.0F, 0.0F},
                                 ClipDepth{1.0F, -1.0F}};

ClipDepth read_depth(const JsonValue& json) {
    constexpr const char* right =
        "z / w at the near and at the far plane: [-1, 1], [0, 1], or reversed [1, 0], [1, -1]";
    const std::vector<JsonValue> planes = elements(json, 2, right);
    const ClipDepth depth{planes[0].number(), planes[1].number()};
    if (std::find(clip_depths.begin(), clip_depths.end(), depth) == clip_depths.end())
        json.fail(fmt::format("[{}, {}]; right is {}", depth.near_plane, depth.far_plane, right));
    return depth;
}

glm::mat4 read_matrix(const JsonValue& json) {
    const std::vector<JsonValue> numbers = elements(json, 16, "16 numbers, column after column");
    glm::mat4 matrix;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        glm::value_ptr(matrix)[i] = numbers[i].number();
    return matrix;
}

nlohmann::json matrix_json(const glm::mat4& matrix) {
    return std::vector<float>(glm::value_ptr(matrix), glm::value_ptr(matrix) + 16);
}

FrameSettings read_frame(const JsonValue& json, const Scene& scene, int next) {
    json.check_keys({"frame", "proj_view", "second_proj_view", "constants", "speed_factor"});
    FrameSettings settings{.frame = next, .constants = scene.constants, .speed_factor = scene.switches.speed_factor};
    read_field(json, "frame", settings.frame);
    if (settings.frame < next)
        json.fail(fmt::format("frame {} does not come after frame {}; frames are sorted", settings.frame, next - 1));
    read_field(json, "proj_view", settings.proj_view, read_matrix);
    read_field(json, "second_proj_view", settings.second_proj_view, read_matrix);
    if (const auto constants = json.find("constants"))
        read_constants(*constants, settings.constants);
    read_field(json, "speed_factor", settings.speed_factor);
    return settings;
}

/// Those that are not the scene's.
nlohmann::json own_constants(const Constants& constants, const Constants& usual) {
    nlohmann::json json = constants_json(constants);
    const nlohmann::json of_scene = constants_json(usual);
    for (const auto& [name, value] : of_scene.items())
        if (json[name] == value)
            json.erase(name);
    return json;
}

} // namespace

ClipSpace read_clip_space(const JsonValue& json, const Switches& switches) {
    json.check_keys({"first_row", "depth"});
    ClipSpace space;
    if (const auto first_row = json.find("first_row")) {
        space.first_row = first_row->number();
        if (space.first_row != -1.0F && space.first_row != 1.0F)
            first_row->fail(fmt::format("{}; right is y / w at the image's first row in memory: -1 (GL, Vulkan) or 1 "
                                        "(D3D, Metal, WebGPU)",
                                        space.first_row));
    }
    read_field(json, "depth", space.depth, read_depth);
    if (space.depth != ClipDepth{} && (has_remedies(switches) || switches.search == Search::depth))
        json.fail("depth: search = depth, cdt_layers, cdt_cameras, search_window and response need [-1, 1]");
    return space;
}

std::vector<FrameSettings> read_frames(const JsonValue& json, const Scene& scene) {
    std::vector<FrameSettings> frames;
    for (const JsonValue& item : json.items())
        frames.push_back(read_frame(item, scene, frames.empty() ? 0 : frames.back().frame + 1));
    return frames;
}

std::vector<FrameSettings> settings_near(std::vector<FrameSettings> frames, int frame) {
    const auto from = [&](int first) {
        return std::find_if(frames.begin(), frames.end(), [&](const FrameSettings& s) { return s.frame >= first; });
    };
    frames.erase(from(frame + 1), frames.end());
    auto first = from(frame - 1);
    if (first != frames.begin() && (first == frames.end() || first->frame > frame - 1))
        --first;
    frames.erase(frames.begin(), first);
    return frames;
}

nlohmann::json clip_space_json(const ClipSpace& space) {
    return {{"first_row", space.first_row}, {"depth", {space.depth.near_plane, space.depth.far_plane}}};
}

nlohmann::json frames_json(const Scene& scene) {
    nlohmann::json frames = nlohmann::json::array();
    for (const FrameSettings& settings : scene.frames) {
        nlohmann::json json{{"frame", settings.frame}};
        if (settings.proj_view)
            json["proj_view"] = matrix_json(*settings.proj_view);
        if (settings.second_proj_view)
            json["second_proj_view"] = matrix_json(*settings.second_proj_view);
        if (const nlohmann::json constants = own_constants(settings.constants, scene.constants); !constants.empty())
            json["constants"] = constants;
        if (settings.speed_factor != scene.switches.speed_factor)
            json["speed_factor"] = settings.speed_factor;
        frames.push_back(std::move(json));
    }
    return frames;
}

} // namespace lockstep
