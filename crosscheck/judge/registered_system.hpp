#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/gl_system.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/image.hpp"
#include "reference/model/overlay_line.hpp"

namespace lockstep {

/// How a frame's state is drawn: a pass of its own, the vertex stage, which makes a buffer of the system below from the
/// state and is judged as any other, and what becomes a picture of it.
struct SystemPicture {
    System system; ///< starts from the state
    std::vector<GlPass> passes;
    GlPicture how; ///< no indices: nothing is drawn
    /// The reference's picture of what its vertex stage put out.
    std::function<ColorImage(const SystemView& drawn)> image;
    glm::mat4 to_clip{1.0F};
    std::vector<OverlayLine> overlay;
};

/// Passes that no twin answers: nothing but what a pass of the system rests on, by itself, to hold its time against.
struct Floor {
    std::vector<GlPass> passes = {};
    std::string meaning = {}; ///< one line, for people
};

/// What a scene file of a registered system comes to, on both sides.
struct SystemScene {
    System system;              ///< the twins; its `settings` are what a report says of switches
    std::vector<GlPass> passes; ///< the shaders, in the twins' order
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    /// Of a frame's end. Empty: the system has no pictures.
    std::function<SystemPicture(const SystemState& state, int frame)> picture = {};
    /// The picture that the passes themselves made, where an image of the state is one. Empty: none is.
    std::function<ColorImage(const SystemState& state)> image = {};

    /// What its passes leave open that the driver does otherwise than the reference can follow, each in words of a
    /// report, with what promises bits instead. Empty: nothing rests on such.
    std::function<std::vector<std::string>(const Profile& profile)> left_open = {};

    /// Of what `lockstep bench --floor` times. Empty: there is none.
    std::function<Floor()> floor = {};

    [[nodiscard]] bool has_pictures() const { return picture || image; }
};

/// Folders that a scene names: of its shaders, and of those that are their reference.
struct SceneFolders {
    std::filesystem::path shaders, reference;
};

/// A system that scene files name: `"system": "dust"`. The verbs know no other thing of it.
struct RegisteredSystem {
    std::string_view name;    ///< its schema's, and its folders'
    std::string_view meaning; ///< one line, for people
    /// Reads a scene: all keys of the file but "system" and "description", `options` on top. `name`: the scene's.
    /// Throws Error as load_scene does.
    SystemScene (*load)(const JsonValue& scene, const std::string& name, const SceneOptions& options);
    /// Those that a scene names, or means; `file`: where it lies. Throws Error as load does. Null: scenes name none,
    /// their shaders are shipped and their reference is twins.
    SceneFolders (*folders)(const JsonValue& scene, const std::filesystem::path& file) = nullptr;
};

} // namespace lockstep
