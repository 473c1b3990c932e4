#include "tests/collision/twin/twin_scenes.hpp"

#include "crosscheck/scene/surface.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"

namespace lockstep::test {

Scene crowded_scene(std::size_t count, int width, int height) {
    RandomScenes random(7);
    Scene scene;
    scene.name = "crowded";
    scene.start = random.particles(count, 0.45F);
    for (std::size_t i = 0; i < count; ++i) {
        scene.start.direction[i] = random.position(1.0F);
        scene.start.collide_time[i] = 0.0F;
    }
    place(plane_surface(1.5, 1.5), {0.0, 0.0, {0.0, -0.5, 0.0}}, scene.obstacles);
    place(sphere_surface(0.2, 6), {}, scene.obstacles);
    scene.width = width;
    scene.height = height;
    scene.constants.collision_range = 0.08F;
    return scene;
}

CheckReport check_twins(const Scene& scene, int frames, const std::filesystem::path& shaders, CheckMode mode,
                        Legal legal) {
    GpuSimulation gpu(scene, shaders);
    const Profile profile = llvmpipe_profile(shaders);
    CheckOptions options;
    options.frames = frames;
    options.mode = mode;
    options.known = known_operations(legal, profile);
    return check(scene, profile, gpu, options);
}

} // namespace lockstep::test
