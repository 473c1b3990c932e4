#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <omp.h>

#include "reference/collision/collision_pass.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::collision_properties_test {

namespace {

PassOutput frame(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                 const Profile& profile = {}) {
    PassOutput next{{}, empty_cdt(params), DepthImage(params.width, params.height, 1.0F)};
    update_particles(before, cdt, params, profile, next.particles);
    rasterise_particles(before, next.particles, params, profile, next.cdt, next.depth);
    return next;
}

std::size_t hits(const Particles& after, const FrameParams& params) {
    return static_cast<std::size_t>(
        std::count(after.collide_time.begin(), after.collide_time.end(), params.constants.collision_time));
}

Particles permuted(const Particles& p, const std::vector<std::size_t>& order) {
    Particles q;
    q.resize(p.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        q.position[i] = p.position[order[i]];
        q.direction[i] = p.direction[order[i]];
        q.speed[i] = p.speed[order[i]];
        q.collide_time[i] = p.collide_time[order[i]];
    }
    return q;
}

/// In double, straight from the description: clip space, texel, the closest of the texels round it.
struct Oracle {
    glm::dvec3 direction{0.0};
    bool hit = false;
    bool close_call = false; ///< a rounding could decide otherwise
};

Oracle oracle(glm::vec3 position, float collide_time, const CollisionImage& cdt, const FrameParams& params) {
    Oracle answer;
    if (!(collide_time < 0.0F))
        return answer;
    const glm::dvec4 clip = glm::dmat4(params.collision_proj_view) * glm::dvec4(glm::dvec3(position), 1.0);
    const double x = (clip.x / clip.w * 0.5 + 0.5) * params.width;
    const double y = (clip.y / clip.w * 0.5 + 0.5) * params.height;
    answer.close_call = std::abs(x - std::round(x)) < 1e-3 || std::abs(y - std::round(y)) < 1e-3;
    const int base_x = static_cast<int>(std::floor(x)), base_y = static_cast<int>(std::floor(y));
    if (!cdt.contains(base_x, base_y))
        return answer;
    std::vector<std::pair<double, glm::dvec3>> found;
    for (int ty = 0; ty < cdt.height; ++ty)
        for (int tx = 0; tx < cdt.width; ++tx) {
            const int ring = std::max(std::abs(tx - base_x), std::abs(ty - base_y));
            if (ring == 0 || ring > params.constants.texel_collide_range || cdt.at(tx, ty).a == 0.0F)
                continue;
            const glm::dvec3 apart = glm::dvec3(position) - glm::dvec3(cdt.at(tx, ty));
            found.emplace_back(glm::length(apart), apart);
        }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (found.empty())
        return answer;
    const double range = params.constants.collision_range;
    answer.hit = found[0].first < range;
    answer.direction = found[0].second / found[0].first;
    answer.close_call = answer.close_call || std::abs(found[0].first - range) < 1e-5 * range ||
                        (found.size() > 1 && found[1].first - found[0].first < 1e-5 * range);
    return answer;
}

} // namespace

TEST_CASE("collision property: a search of the whole image finds the same nearest neighbour") {
    for (const int radius : {1, 2, 4}) {
        RandomScene scene = random_scene(7U + static_cast<std::uint32_t>(radius), 2000, 48, 32);
        scene.params.constants.texel_collide_range = radius;
        const PassOutput next = frame(scene.particles, scene.cdt, scene.params);
        std::size_t judged = 0, wrong = 0;
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            const Oracle expected =
                oracle(scene.particles.position[i], scene.particles.collide_time[i], scene.cdt, scene.params);
            if (expected.close_call)
                continue;
            ++judged;
            const bool hit = next.particles.collide_time[i] == scene.params.constants.collision_time;
            const double off = glm::length(glm::dvec3(next.particles.direction[i]) - expected.direction);
            wrong += hit != expected.hit || (hit && !(off < 1e-3));
        }
        INFO("radius " << radius);
        CHECK(wrong == 0);
        CHECK(judged > 1900);
        CHECK(hits(next.particles, scene.params) > 500);
        CHECK(hits(next.particles, scene.params) < 1600);
    }
}

TEST_CASE("collision property: permuting the particles permutes the answer and leaves the CDT") {
    const RandomScene scene = random_scene(11, 3000, 64, 48);
    std::vector<std::size_t> order(scene.particles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random random(12);
    for (std::size_t i = order.size() - 1; i > 0; --i)
        std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i + 1))]);
    const PassOutput straight = frame(scene.particles, scene.cdt, scene.params);
    const PassOutput shuffled = frame(permuted(scene.particles, order), scene.cdt, scene.params);
    CHECK(same_bits(shuffled.particles, permuted(straight.particles, order)));
    CHECK(same_bits(shuffled.cdt, straight.cdt)); // no two depths are equal in a texel here
    CHECK(hits(straight.particles, scene.params) > 500);
}

TEST_CASE("collision property: translation by whole texels translates the answer") {
    // 64 x 64 texels of 1/32 over -1..1; positions on a grid of 2^-12, so that a translation rounds nothing away.
    FrameParams params = flat_params();
    params.width = params.height = 64;
    params.constants.collision_range = 0.02F;
    params.constants.texel_collide_range = 2;
    params.constants.gravity = glm::vec3(0.0F);
    const glm::vec3 shift{5.0F / 32.0F, -7.0F / 32.0F, 0.0F};
    Random random(5);
    const auto grid_point = [&] {
        const auto coordinate = [&](float extent) {
            return std::floor(random.between(-extent, extent) * 4096.0F) / 4096.0F;
        };
        return glm::vec3{coordinate(0.6F), coordinate(0.6F), coordinate(0.02F)};
    };
    Particles here, there;
    here.resize(2000);
    for (std::size_t i = 0; i < here.size(); ++i) {
        here.position[i] = grid_point();
        here.direction[i] = glm::vec3(1.0F, 0.0F, 0.0F);
        here.speed[i] = std::floor(random.between(1.0F, 8.0F)) / 256.0F;
        here.collide_time[i] = -1.0F;
    }
    there = here;
    for (glm::vec3& p : there.position)
        p += shift;

    PassOutput cdt_here{{}, empty_cdt(params), DepthImage(64, 64, 1.0F)}, cdt_there = cdt_here;
    rasterise_particles(here, here, params, {}, cdt_here.cdt, cdt_here.depth);
    rasterise_particles(there, there, params, {}, cdt_there.cdt, cdt_there.depth);
    int drawn = 0, moved = 0;
    for (int y = 7; y < 64; ++y)
        for (int x = 0; x < 64 - 5; ++x) {
            const glm::vec4 texel = cdt_here.cdt.at(x, y);
            drawn += texel.a != 0.0F;
            moved += texel.a != 0.0F && cdt_there.cdt.at(x + 5, y - 7) == texel + glm::vec4(shift, 0.0F) &&
                     cdt_there.depth.at(x + 5, y - 7) == cdt_here.depth.at(x, y);
        }
    CHECK(drawn > 700);
    CHECK(moved == drawn);

    Particles after_here, after_there;
    update_particles(here, cdt_here.cdt, params, {}, after_here);
    update_particles(there, cdt_there.cdt, params, {}, after_there);
    CHECK(hits(after_here, params) > 200);
    CHECK(hits(after_here, params) < 1900);
    CHECK(after_there.direction == after_here.direction);
    CHECK(after_there.speed == after_here.speed);
    CHECK(after_there.collide_time == after_here.collide_time);
    for (std::size_t i = 0; i < here.size(); ++i)
        if (!(glm::length(after_there.position[i] - shift - after_here.position[i]) < 1e-6F))
            FAIL_CHECK("particle " << i << " is not translated");
}

TEST_CASE("collision property: the same bits for 1, 2 and 4 threads") {
    const int threads = omp_get_max_threads();
    for (const char* name : {"paper", "corrected"}) {
        RandomScene scene = random_scene(21, 4001, 80, 60);
        scene.params.switches = preset(name);
        scene.params.constants.texel_collide_range = 2;
        std::vector<PassOutput> last;
        for (const int count : {1, 2, 4}) {
            omp_set_num_threads(count);
            PassOutput now{scene.particles, scene.cdt, {}};
            for (int i = 0; i < 4; ++i)
                now = frame(now.particles, now.cdt, scene.params);
            last.push_back(now);
        }
        omp_set_num_threads(threads);
        CHECK(same_bits(last[1].particles, last[0].particles));
        CHECK(same_bits(last[2].particles, last[0].particles));
        CHECK(same_bits(last[1].cdt, last[0].cdt));
        CHECK(same_bits(last[2].cdt, last[0].cdt));
    }
}

TEST_CASE("collision property: subnormals are flushed in every thread, or in none") {
    // Falling by a subnormal speed, 2^-20 * 2^-110: flushed, nothing moves and no direction is left.
    FrameParams params = flat_params();
    params.constants.gravity = {0.0F, -0x1p-110F, 0.0F};
    params.constants.tick = 0x1p-20F;
    Particles p;
    p.resize(4000);
    std::fill(p.collide_time.begin(), p.collide_time.end(), 1.0F);
    const int threads = omp_get_max_threads();
    for (const int count : {1, 2, 4}) {
        omp_set_num_threads(count);
        for (const bool flush : {true, false}) {
            Profile profile;
            profile.flush_subnormals = flush;
            p.position.assign(p.size(), glm::vec3(0.0F));
            p.direction.assign(p.size(), glm::vec3(0x1p-100F, 0.0F, 0.0F));
            p.speed.assign(p.size(), 0x1p-30F); // direction * speed = 2^-130, subnormal too
            Particles after;
            update_particles(p, empty_cdt(params), params, profile, after);
            // The squares vanish either way. What is left of the sum is scaled by 1 / 0: NaN where it was flushed.
            const auto nans = std::count_if(after.direction.begin(), after.direction.end(),
                                            [](glm::vec3 d) { return std::isnan(d.x) && std::isnan(d.y); });
            const auto infinite = std::count_if(after.direction.begin(), after.direction.end(),
                                                [](glm::vec3 d) { return std::isinf(d.x) && std::isinf(d.y); });
            INFO(count << " threads, flush " << flush);
            CHECK(nans == (flush ? 4000 : 0));
            CHECK(infinite == (flush ? 0 : 4000));
        }
    }
    omp_set_num_threads(threads);
}

} // namespace lockstep::test::collision_properties_test
