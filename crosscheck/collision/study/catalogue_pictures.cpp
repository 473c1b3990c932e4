#include "crosscheck/collision/study/catalogue_pictures.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/collision/study/catalogue.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr int side = 400; ///< of each half, pixels
constexpr int gap = 8;

void as_it_is(Scene&) {}
void from_near(Scene& scene) { scene.camera.eye.z = 0.4F; }
void ten_times_as_often(Scene& scene) { scene.constants.collision_time /= 10.0F; }
void from_the_side(Scene& scene) {
    scene.switches.cdt_camera = CdtCamera::fixed;
    scene.collision_camera = scene.camera;
    scene.collision_camera.eye = {scene.camera.eye.z, 0.0F, 0.0F};
}

/// When an effect shows best, and what brings it about.
struct Picture {
    std::string_view name;
    int frame;
    void (*bring_about)(Scene&);
};
constexpr std::array views{
    Picture{"close_up", 1, from_near},        Picture{"one_sided", 30, as_it_is},
    Picture{"overlap_jitter", 120, as_it_is}, Picture{"horn_growth", 120, ten_times_as_often},
    Picture{"camera_drop", 120, as_it_is},    Picture{"occluded_neighbour", 1, as_it_is},
    Picture{"off_axis_spread", 1, as_it_is},  Picture{"plane_hides", 30, as_it_is},
    Picture{"side_view", 100, from_the_side},
};

/// Puts `image`, scaled to side x side by repeating pixels, into `picture` from column `left` on.
void paste(const ColorImage& image, int left, ColorImage& picture) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            picture.at(left + x, y) = image.at(x * image.width / side, y * image.height / side);
}

} // namespace

ColorImage catalogue_picture(std::string_view name, const std::filesystem::path& scenes) {
    const auto view = std::find_if(views.begin(), views.end(), [&](const Picture& v) { return v.name == name; });
    if (view == views.end())
        throw Error(fmt::format("catalogue: nothing is named {}; the effects are {}", name,
                                fmt::join(catalogue_names(), ", ")));
    Scene scene = load_scene(scenes / fmt::format("{}.json", name));
    view->bring_about(scene);
    scene.render_width = scene.render_height = side;
    scene.constants.billboard_radius *= 2.0F;
    ColorImage picture(2 * side + gap, side, Rgba8{255, 255, 255, 255});
    StudyOptions options;
    options.frames = view->frame + 1;
    options.every = std::max(view->frame - 1, 1);
    options.on_state = [&](const StudiedState& state) {
        if (state.frame != view->frame)
            return;
        paste(render_pass(state.particles, scene.obstacles, state.params, {}), 0, picture);
        paste(study_picture(state, {}), side + gap, picture);
    };
    study_run(scene, {}, options);
    return picture;
}

} // namespace lockstep
