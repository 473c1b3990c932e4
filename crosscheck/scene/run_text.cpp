#include "crosscheck/scene/run_text.hpp"

#include <fmt/format.h>

#include "crosscheck/files/shell_words.hpp"
#include "reference/model/collision/octree.hpp"
#include "reference/model/collision/switches.hpp"

namespace lockstep {

std::string scene_arguments(const std::filesystem::path& file, const SceneOptions& options) {
    if (options.emitter_length != 1.0F)
        return "";
    std::string text = shell_word(std::filesystem::absolute(file).lexically_normal().string());
    if (options.particles)
        text += fmt::format(" --particles {}", *options.particles);
    if (options.preset)
        text += fmt::format(" --preset {}", shell_word(*options.preset));
    for (const std::string& change : options.set)
        text += fmt::format(" --set {}", shell_word(change));
    return text;
}

std::string switches_text(const Scene& scene) {
    const std::string arithmetic = switch_value(scene.switches, "arithmetic");
    if (scene.switches.search == Search::octree)
        return fmt::format("arithmetic {}, octree of depth {}, root {}", arithmetic, octree_depth,
                           scene.constants.octree_size);
    if (scene.switches.search == Search::depth)
        return fmt::format("arithmetic {}, depth {}x{}, surfaces {} thick", arithmetic, scene.width, scene.height,
                           scene.constants.surface_thickness);
    return fmt::format("arithmetic {}, CDT {} {}x{}, radius {}{}", arithmetic,
                       switch_value(scene.switches, "cdt_format"), scene.width, scene.height,
                       scene.constants.texel_collide_range, scene.switches.step == Step::compute ? ", compute" : "");
}

} // namespace lockstep
