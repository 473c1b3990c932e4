#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::clip_space_test {

namespace {

constexpr std::array depths{ClipDepth{-1.0F, 1.0F}, ClipDepth{0.0F, 1.0F}, ClipDepth{1.0F, 0.0F},
                            ClipDepth{1.0F, -1.0F}};

/// flat_params() with z in world units from 0, at the near plane, to 1, at the far one.
FrameParams from_near_to_far(const ClipDepth& depth) {
    FrameParams params = flat_params();
    params.clip_depth = depth;
    params.collision_proj_view[2][2] = depth.far_plane - depth.near_plane;
    params.collision_proj_view[3][2] = depth.near_plane;
    return params;
}

Particles at_depths(const std::vector<float>& depths_of) {
    Particles particles;
    particles.resize(depths_of.size());
    for (std::size_t i = 0; i < depths_of.size(); ++i)
        particles.position[i] = {0.1F, 0.1F, depths_of[i]};
    return particles;
}

/// The z that a texel keeps, below 0 where nothing is drawn.
float kept(const FrameParams& params, const std::vector<float>& depths_of) {
    const Particles particles = at_depths(depths_of);
    CollisionImage cdt = empty_cdt(params);
    DepthImage depth(params.width, params.height, params.clip_depth.cleared());
    rasterise_particles(particles, particles, params, {}, cdt, depth);
    const glm::vec4 texel = cdt.at(4, 4);
    return texel.a == 0.0F ? -1.0F : texel.z;
}

} // namespace

TEST_CASE("clip space: the nearest particle stays on every convention of depth, the first of equals") {
    for (const ClipDepth& depth : depths)
        for (const Step step : {Step::transform_feedback, Step::compute}) {
            FrameParams params = from_near_to_far(depth);
            params.switches.step = step;
            INFO(depth.near_plane << " to " << depth.far_plane << (step == Step::compute ? ", compute" : ""));
            CHECK(kept(params, {0.5F, 0.25F, 0.75F}) == 0.25F);
            CHECK(kept(params, {0.75F, 0.5F, 0.25F}) == 0.25F);
            CHECK(kept(params, {0.0F, 0.5F}) == 0.0F); // on the near plane
            CHECK(kept(params, {-0.25F, 0.5F}) == 0.5F);
            CHECK(kept(params, {1.25F}) == -1.0F);
            CHECK(kept(params, {1.0F}) == -1.0F); // on the far plane it is no nearer than what was cleared
        }
}

TEST_CASE("clip space: depth from 0 keeps apart what a depth from -1 rounds to one") {
    const float near_one = 0x1p-30F, nearer_one = 0x1p-31F;
    CHECK(kept(from_near_to_far({0.0F, 1.0F}), {near_one, nearer_one}) == nearer_one);
    FrameParams params = flat_params(); // -1 to 1, w = 1
    params.collision_proj_view[3][2] = 0.0F;
    CHECK(kept(params, {near_one, nearer_one}) == near_one);
    params.clip_depth = {1.0F, 0.0F}; // reversed: the greater is nearer
    CHECK(kept(params, {nearer_one, near_one}) == near_one);
}

TEST_CASE("clip space: the fast pass draws what the obvious one draws") {
    RandomScene scene = random_scene(77, 4000, 24, 18);
    for (const ClipDepth& depth : depths)
        for (const char* preset_name : {"corrected", "exact"})
            for (const char* profile_name : {"strict", "llvmpipe", "nvidia"}) {
                FrameParams params = scene.params;
                params.switches = preset(preset_name);
                params.clip_depth = depth;
                const auto draw = [&](const auto& rasterise) {
                    PassOutput drawn{{}, empty_cdt(params), DepthImage(24, 18, depth.cleared())};
                    rasterise(scene.particles, scene.particles, params, named_profile(profile_name), drawn.cdt,
                              drawn.depth);
                    return drawn;
                };
                const PassOutput obvious = draw(rasterise_particles), fast = draw(rasterise_particles_fast);
                CHECK(same_bits(fast.cdt, obvious.cdt));
                CHECK(fast.depth.texels == obvious.depth.texels);
            }
}

TEST_CASE("clip space: obstacles are cut at the near plane, and the nearest of them stays") {
    for (const ClipDepth& depth : depths) {
        FrameParams params = from_near_to_far(depth);
        params.switches.obstacles_in_cdt = ObstaclesInCdt::triangles;
        // Two that cover the image, one half in front of the near plane: z = x / 2 + 1 / 4, and one at z = 3 / 8.
        Mesh mesh;
        for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(3, -1), glm::vec2(-1, 3)}) {
            mesh.positions.emplace_back(corner, 0.375F);
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
        }
        for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(3, -1), glm::vec2(-1, 3)}) {
            mesh.positions.emplace_back(corner, corner.x / 2.0F + 0.25F);
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
        }
        CollisionImage cdt = empty_cdt(params);
        DepthImage image(params.width, params.height, depth.cleared());
        obstacle_pass(mesh, params, {}, cdt, image);
        INFO(depth.near_plane << " to " << depth.far_plane);
        for (int x = 0; x < params.width; ++x) {
            const float slope = (static_cast<float>(x) - 3.5F) / 8.0F + 0.25F; // at the texel's centre
            CHECK(cdt.at(x, 3).z == Approx(slope < 0.0F || slope > 0.375F ? 0.375F : slope).margin(1e-6));
        }
    }
}

TEST_CASE("clip space: rows downwards is the matrix with y negated, and no other bit") {
    Scene scene;
    scene.width = 40;
    scene.height = 30;
    scene.frames = {{.frame = 2, .proj_view = view_projection_matrix({}, 1.25F), .constants = {.tick = 0.5F}}};
    const glm::mat4 upwards = frame_params(scene, 2).collision_proj_view;
    scene.clip_space.first_row = 1.0F;
    const FrameParams params = frame_params(scene, 2);
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 p(random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F));
        const glm::vec4 there = Strict::transform(params.collision_proj_view, p), here = Strict::transform(upwards, p);
        CHECK((there.x == here.x && there.y == -here.y && there.z == here.z && there.w == here.w));
        const auto row = static_cast<int>(std::floor((1.0F - here.y / here.w) * 0.5F * 30.0F));
        CHECK(base_texel(p, params, {}).y == row);
    }
}

TEST_CASE("clip space: a frame's settings hold from it on, and the scene's before") {
    Scene scene;
    scene.constants.tick = 0.25F;
    scene.switches.speed_factor = 0.5F;
    scene.frames = {{.frame = 2, .constants = {.tick = 0.5F}, .speed_factor = 0.75F},
                    {.frame = 5, .proj_view = glm::mat4(2.0F), .constants = {.tick = 1.0F}}};
    CHECK(frame_params(scene, 1).constants.tick == 0.25F);
    CHECK(frame_params(scene, 1).switches.speed_factor == 0.5F);
    for (const int frame : {2, 3, 4}) {
        CHECK(frame_params(scene, frame).constants.tick == 0.5F);
        CHECK(frame_params(scene, frame).switches.speed_factor == 0.75F);
        CHECK(frame_params(scene, frame).collision_proj_view == frame_params(scene, 0).collision_proj_view);
    }
    CHECK(frame_params(scene, 99).constants.tick == 1.0F);
    CHECK(frame_params(scene, 99).collision_proj_view == glm::mat4(2.0F));
}

} // namespace lockstep::test::clip_space_test
