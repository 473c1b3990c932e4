#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <omp.h>

#include "reference/collision/collision_pass_fast.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::collision_pass_fast_test {

namespace {

/// What obstacles may have left: a third of the texels hold a depth, many of them one that a particle has too.
DepthImage drawn_before(const FrameParams& params) {
    Random random(99);
    DepthImage depth(params.width, params.height, 1.0F);
    for (float& d : depth.texels)
        if (random.chance(0.3F))
            d = std::floor(random.between(0.47F, 0.53F) * 128.0F) / 128.0F;
    return depth;
}

template <class Update, class Rasterise>
PassOutput frame(const Update& update, const Rasterise& rasterise, const RandomScene& scene, const Profile& profile) {
    PassOutput next{
        {}, CollisionImage(scene.params.width, scene.params.height, glm::vec4(7.0F)), drawn_before(scene.params)};
    update(scene.particles, scene.cdt, scene.params, profile, next.particles);
    rasterise(scene.particles, next.particles, scene.params, profile, next.cdt, next.depth);
    return next;
}

/// One obvious frame, equal to the fast one; what of it happened.
struct Seen {
    std::size_t hits = 0, nans = 0, drawn = 0;
};
Seen check_equal(const RandomScene& scene, const Profile& profile = {}) {
    const PassOutput obvious = frame(update_particles, rasterise_particles, scene, profile);
    const PassOutput fast = frame(update_particles_fast, rasterise_particles_fast, scene, profile);
    CHECK(same_bits(fast.particles, obvious.particles));
    CHECK(same_bits(fast.cdt, obvious.cdt));
    CHECK(fast.depth.texels == obvious.depth.texels);
    Seen seen;
    for (std::size_t i = 0; i < obvious.particles.size(); ++i) {
        seen.hits += obvious.particles.collide_time[i] == scene.params.constants.collision_time;
        seen.nans += std::isnan(obvious.particles.direction[i].x);
    }
    for (const glm::vec4& texel : obvious.cdt.texels)
        seen.drawn += texel != glm::vec4(7.0F);
    return seen;
}

/// Length and normalize sum in orders of their own.
Profile own_orders(DotOrder length, DotOrder normalize) {
    Profile profile;
    profile.length_dot = length;
    profile.normalize_dot = normalize;
    return profile;
}

/// Of each kind that a driver was found to be.
std::vector<Profile> profiles() {
    Profile own_roots = profile_with_roots();
    own_roots.normalize_dot = DotOrder::sum_then_fused_x;
    return {named_profile("strict"),
            named_profile("llvmpipe"),
            named_profile("nvidia"),
            profile_with_roots(),
            own_roots,
            own_orders(DotOrder::middle_last, DotOrder::fused_y_x_z)};
}

/// Positions and stored positions moved to multiples of `step`: distances repeat, particles coincide.
void quantise(RandomScene& scene, float step) {
    const auto nearest = [&](glm::vec3 v) { return glm::floor(v / step + 0.5F) * step; };
    for (glm::vec3& p : scene.particles.position)
        p = nearest(p);
    for (glm::vec4& texel : scene.cdt.texels)
        texel = glm::vec4(nearest(texel), texel.a);
}

} // namespace

TEST_CASE("fast collision: the obvious pass's bits for every combination of switches") {
    RandomScene scene = random_scene(31, 200, 21, 15);
    scene.params.cdt_box = {glm::vec3(-1.5F), glm::vec3(1.5F)};
    std::vector<Switches> combinations{preset("corrected"), preset("exact")};
    for (const SwitchInfo& info : switch_table()) {
        if (info.values.size() < 2 || info.name == "arithmetic" || info.name == "cdt_camera" ||
            info.name == "obstacles_in_cdt" || chooses_pass(info.name))
            continue;
        std::vector<Switches> next;
        for (const Switches& switches : combinations)
            for (const std::string_view value : info.values) {
                next.push_back(switches);
                set_switch(next.back(), info.name, value);
            }
        combinations = std::move(next);
    }
    CHECK(combinations.size() == 2 * 64 * 2 * 2 * 2 * 3);
    const std::vector<glm::vec4> positions = scene.cdt.texels;
    const std::vector<Profile> all = profiles();
    std::size_t hits = 0, nans = 0, round = 0;
    for (const Switches& switches : combinations) {
        scene.params.switches = switches;
        for (int y = 0; y < scene.cdt.height; ++y)
            for (int x = 0; x < scene.cdt.width; ++x)
                if (const glm::vec4 p = positions[scene.cdt.index(x, y)]; p.a != 0.0F)
                    store(scene.cdt, scene.params, x, y, glm::vec3(p));
        scene.params.constants.texel_collide_range = static_cast<int>(1 + round % 9);
        const Seen seen = check_equal(scene, all[(round + round / all.size()) % all.size()]);
        hits += seen.hits;
        nans += seen.nans;
        ++round;
    }
    CHECK(hits > 20000);
    CHECK(nans > 100);
}

TEST_CASE("fast collision: equal where distances are equal or zero") {
    for (const ZeroDistance zero : {ZeroDistance::hit, ZeroDistance::skip})
        for (const Profile& profile : profiles())
            for (int radius = 1; radius <= 8; ++radius) {
                RandomScene scene = random_scene(41, 1000, 32, 24);
                scene.params.switches.zero_distance = zero;
                scene.params.constants.texel_collide_range = radius;
                quantise(scene, 1.0F / 32.0F);
                CHECK(check_equal(scene, profile).hits > 250);
            }
}

/// Stored positions on a sphere around the origin, where all particles are, if in different texels: squares a few last
/// places apart, two or three to a root.
RandomScene sphere_around_all(float range, int radius) {
    RandomScene scene = random_scene(45, 2000, 40, 40);
    Random random(46);
    scene.params.collision_proj_view = glm::mat4(0.0F);
    scene.params.collision_proj_view[0][0] = scene.params.collision_proj_view[1][1] = 0x1p30F;
    scene.params.collision_proj_view[3][3] = 1.0F;
    scene.params.constants.collision_range = range;
    scene.params.constants.texel_collide_range = radius;
    for (glm::vec3& p : scene.particles.position)
        p *= 0x1p-30F;
    for (glm::vec4& texel : scene.cdt.texels) {
        const glm::vec3 v{random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F)};
        texel = {v * 1.3F / glm::length(v), 1.0F};
    }
    return scene;
}

TEST_CASE("fast collision: equal where different squares share a root, or the larger has the smaller one") {
    for (int radius = 1; radius <= 8; ++radius)
        for (const Profile& profile : profiles())
            CHECK(check_equal(sphere_around_all(2.0F, radius), profile).hits > 500);
}

TEST_CASE("fast collision: equal where roots next to each other lie on both sides of the collision range") {
    for (const Profile& profile : {named_profile("llvmpipe"), profile_with_roots()}) {
        std::size_t fewest = SIZE_MAX, most = 0;
        for (int ulp = -4; ulp <= 4; ++ulp) {
            const std::size_t hits =
                check_equal(sphere_around_all(1.3F + static_cast<float>(ulp) * 0x1p-23F, 1), profile).hits;
            fewest = std::min(fewest, hits);
            most = std::max(most, hits);
        }
        CHECK(fewest < 100);
        CHECK(most > 1000);
    }
}

TEST_CASE("fast collision: equal with NaN, infinite, huge and tiny values, flushed or not") {
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> odd{std::numeric_limits<float>::quiet_NaN(),
                                 inf,
                                 -inf,
                                 3e38F,
                                 -1e20F,
                                 1e-40F,
                                 -1e-45F,
                                 0.0F,
                                 -0.0F,
                                 0x1p-126F,
                                 1e-20F,
                                 100000.0F};
    for (const char* name : {"corrected", "paper", "exact"})
        for (const bool flush : {true, false})
            for (const float range : {0.1F, 1e-19F, 1e30F, inf, 0.0F, -1.0F, odd[0]}) {
                RandomScene scene = random_scene(51, 800, 32, 24);
                scene.params.switches = preset(name);
                scene.params.constants.collision_range = range;
                scene.params.constants.texel_collide_range = 2;
                Random random(52);
                const auto pick = [&] { return odd[random.below(static_cast<std::uint32_t>(odd.size()))]; };
                for (std::size_t i = 0; i < scene.particles.size(); ++i) {
                    if (random.chance(0.1F))
                        scene.particles.position[i][static_cast<int>(random.below(3))] = pick();
                    if (random.chance(0.1F))
                        scene.particles.direction[i][static_cast<int>(random.below(3))] = pick();
                    if (random.chance(0.1F))
                        scene.particles.speed[i] = pick();
                    if (random.chance(0.1F))
                        scene.particles.collide_time[i] = pick();
                }
                for (glm::vec4& texel : scene.cdt.texels)
                    if (random.chance(0.1F))
                        texel[static_cast<int>(random.below(3))] = pick();
                for (Profile profile : profiles()) {
                    profile.flush_subnormals = flush;
                    INFO(name << ", flush " << flush << ", range " << range << ", profile " << profile.name);
                    check_equal(scene, profile);
                }
            }
}

TEST_CASE("fast collision: equal where squares are subnormal, and round the listing's first best distance") {
    for (const char* name : {"corrected", "paper", "exact"})
        for (const bool flush : {true, false})
            for (const auto& [scale, range] : {std::pair{1e-20F, 1e-19F}, {2e6F, 1e9F}}) {
                RandomScene scene = random_scene(61, 1500, 32, 24);
                scene.params.switches = preset(name);
                scene.params.constants.collision_range = range;
                for (int column = 0; column < 3; ++column)
                    scene.params.collision_proj_view[column] /= scale;
                for (glm::vec3& p : scene.particles.position)
                    p *= scale;
                for (glm::vec4& texel : scene.cdt.texels)
                    texel = glm::vec4(glm::vec3(texel) * scale, texel.a);
                for (Profile profile : profiles()) {
                    profile.flush_subnormals = flush;
                    INFO(name << ", flush " << flush << ", scale " << scale << ", profile " << profile.name);
                    const Seen seen = check_equal(scene, profile);
                    if (scale > 1.0F) {
                        CHECK(seen.hits > 100);
                        CHECK(seen.hits < 1100);
                    }
                }
            }
}

TEST_CASE("fast collision: equal for every raster rule, and where depths are equal") {
    for (const char* name : {"corrected", "exact"})
        for (const ViewportRounding viewport :
             {ViewportRounding::separate, ViewportRounding::fused, ViewportRounding::scaled})
            for (const SnapRounding snap :
                 {SnapRounding::half_to_even, SnapRounding::half_away, SnapRounding::half_up, SnapRounding::down})
                for (const bool lower : {true, false})
                    for (const int bits : {4, 8})
                        for (const float step : {0.0F, 1.0F / 64.0F, 1.0F / 640.0F}) {
                            RandomScene scene = random_scene(71, 1500, 40, 30);
                            scene.params.switches = preset(name);
                            scene.params.switches.raster_position = RasterPosition::before_step;
                            scene.params.collision_proj_view = glm::mat4(1.0F);
                            if (step > 0.0F)
                                quantise(scene, step);
                            Profile profile = bits == 8 ? profile_with_roots() : Profile();
                            profile.raster.depth_by_driver_reciprocal = lower;
                            profile.raster.subpixel_bits = bits;
                            profile.raster.point_snap = snap;
                            profile.raster.viewport = viewport;
                            profile.raster.point_edge_to_lower = lower;
                            CHECK(check_equal(scene, profile).drawn > 300);
                        }
}

TEST_CASE("fast collision: equal for any clip space") {
    const float inf = std::numeric_limits<float>::infinity();
    for (const char* name : {"corrected", "exact"})
        for (const bool flush : {true, false}) {
            RandomScene scene = random_scene(75, 3000, 40, 30);
            scene.params.switches = preset(name);
            scene.params.collision_proj_view = glm::mat4(1.0F);
            scene.params.collision_proj_view[2] = {0.0F, 0.0F, 0.5F, 1.0F}; // w = z
            scene.params.collision_proj_view[3] = glm::vec4(0.0F);
            Random random(76);
            const std::array odd{inf, -inf, 0.0F, 1e-40F, 0x1p-126F, 3e38F, 0x1p-125F};
            for (glm::vec3& p : scene.particles.position) {
                p.z = random.between(-2.0F, 2.0F);
                if (random.chance(0.3F)) {
                    p = glm::vec3(0.0F, 0.0F, odd[random.below(static_cast<std::uint32_t>(odd.size()))]);
                    p.x = random.chance(0.5F) ? 0.0F : 0.3F * p.z;
                }
            }
            scene.params.switches.raster_position = RasterPosition::before_step;
            for (Profile profile : profiles()) {
                profile.flush_subnormals = flush;
                CHECK(check_equal(scene, profile).drawn > 100);
            }
        }
}

TEST_CASE("fast collision: equal on the edges of texels and of the image") {
    for (const BaseTexel base : {BaseTexel::floor, BaseTexel::truncate})
        for (const bool lower : {true, false}) {
            RandomScene scene;
            scene.params = flat_params();
            scene.params.switches.base_texel = base;
            scene.params.constants.collision_range = 9.0F;
            scene.cdt = empty_cdt(scene.params);
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x)
                    store(scene.cdt, scene.params, x, y, {0.25F * static_cast<float>(x), static_cast<float>(y), 0.1F});
            const int steps = 48; // eighths of a texel, from two texels outside to two texels outside
            scene.particles.resize((2 * steps + 1) * (2 * steps + 1));
            for (std::size_t i = 0; i < scene.particles.size(); ++i) {
                const auto row = static_cast<int>(i) / (2 * steps + 1), column = static_cast<int>(i) % (2 * steps + 1);
                scene.particles.position[i] = {static_cast<float>(column - steps) / 32.0F,
                                               static_cast<float>(row - steps) / 32.0F, 0.0F};
                scene.particles.direction[i] = {1.0F, 0.0F, 0.0F};
                scene.particles.collide_time[i] = -1.0F;
            }
            Profile profile;
            profile.raster.point_edge_to_lower = lower;
            scene.params.switches.raster_position = RasterPosition::before_step;
            CHECK(check_equal(scene, profile).drawn > 0);
        }
}

TEST_CASE("fast collision: equal for any number of particles and threads") {
    const int threads = omp_get_max_threads();
    for (const int count : {1, 2, 4, 11}) {
        omp_set_num_threads(count);
        for (const std::size_t particles : {0U, 1U, 2U, 255U, 256U, 257U, 9000U}) {
            RandomScene scene = random_scene(81, particles, 61, 47);
            scene.params.constants.texel_collide_range = 4;
            INFO(count << " threads, " << particles << " particles");
            check_equal(scene);
        }
    }
    omp_set_num_threads(threads);
}

TEST_CASE("fast collision: a radius it is not made for is answered all the same") {
    for (const int radius : {0, 9, 12}) {
        RandomScene scene = random_scene(91, 300, 20, 20);
        scene.params.constants.texel_collide_range = radius;
        CHECK((check_equal(scene).hits > 0) == (radius > 0));
    }
}

TEST_CASE("fast collision: tables that cannot be packed are followed all the same") {
    Profile profile = profile_with_roots();
    RootTables tables = *profile.roots;
    for (std::size_t i = 0; i < tables.inverse_sqrt.size(); i += 3)
        tables.inverse_sqrt[i] *= 1.0F + 0x1p-18F;
    profile.roots = std::make_shared<const RootTables>(std::move(tables));
    CHECK(check_equal(random_scene(95, 1000, 32, 24), profile).hits > 100);
}

TEST_CASE("fast collision: the texels points are drawn to are those of the obvious pass") {
    RandomScene scene = random_scene(97, 3000, 40, 30);
    for (const char* name : {"corrected", "paper", "exact"})
        for (const Step step : {Step::transform_feedback, Step::compute})
            for (const Profile& profile : profiles()) {
                scene.params.switches = preset(name);
                scene.params.switches.step = step;
                std::vector<std::int32_t> texels(scene.particles.size());
                point_texels_fast(scene.particles.position, scene.params, profile, texels);
                std::size_t wrong = 0, drawn = 0;
                for (std::size_t i = 0; i < texels.size(); ++i) {
                    const PointFragment point = point_fragment(scene.particles.position[i], scene.params, profile);
                    wrong += texels[i] != (point.x < 0 ? no_texel : point.y * scene.params.width + point.x);
                    drawn += texels[i] != no_texel;
                }
                CHECK(wrong == 0);
                CHECK(drawn > 1000);
                DrawingScratch scratch;
                CollisionImage cdt = empty_cdt(scene.params);
                DepthImage depth = drawn_before(scene.params);
                std::vector<std::int32_t> while_drawing(texels.size());
                draw_particles_fast(scene.particles, scene.particles, scene.params, profile, cdt, depth, scratch,
                                    while_drawing);
                CHECK(while_drawing == texels);
            }
}

} // namespace lockstep::test::collision_pass_fast_test
