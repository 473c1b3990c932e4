#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <omp.h>

#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/neighbours.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::layered_collision_pass_test {

namespace {

/// flat_params() with layers: 8 x 8 texels over -1..1, depth = z / 2 + 1 / 2.
FrameParams layered_params(int layers) {
    FrameParams params = flat_params();
    params.constants.gravity = glm::vec3(0.0F);
    params.switches.cdt_layers = layers;
    return params;
}

Particles particles_at(const std::vector<glm::vec3>& positions) {
    Particles particles;
    particles.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        particles.set(i, {positions[i], {1.0F, 0.0F, 0.0F}, 3.0F, -1.0F});
    return particles;
}

CollisionImage planes_of(const FrameParams& params) {
    return {params.width, params.height * cdt_planes(params.switches).count()};
}

CollisionImage drawn(const Particles& particles, const FrameParams& params, const Mesh& obstacles = {}) {
    CollisionImage cdt = planes_of(params);
    draw_layered_cdt(particles, obstacles, params, {}, cdt);
    return cdt;
}

/// What layer `layer` holds where a particle at `position` is drawn by flat_params().
glm::vec4 stored(const CollisionImage& cdt, const FrameParams& params, int layer, glm::vec3 position) {
    return cdt.at(static_cast<int>(4.0F * position.x + 4.0F),
                  cdt_planes(params.switches).position(0, layer) * params.height +
                      static_cast<int>(4.0F * position.y + 4.0F));
}

/// One frame of particles that have been drawn as they stand.
Particles step(const Particles& before, const FrameParams& params, const Mesh& obstacles = {},
               const Profile& profile = {}) {
    Particles after;
    update_particles_layered(before, drawn(before, params, obstacles), params, profile, after);
    return after;
}

/// A triangle over the whole image at depth z.
Mesh wall(float z) { return {{{-4.0F, -4.0F, z}, {8.0F, -4.0F, z}, {-4.0F, 8.0F, z}}, {0, 1, 2}}; }

glm::dvec3 momentum(const ParticleState& p) { return glm::dvec3(p.direction) * double{p.speed}; }

/// A camera that looks at a cloud of `count` particles, all of which search; range 0.05.
struct Cloud {
    FrameParams params;
    Particles particles;
};
Cloud cloud(std::uint32_t seed, std::size_t count) {
    Scene scene;
    scene.width = 80;
    scene.height = 60;
    scene.camera.eye = {0.3F, 0.2F, 1.9F};
    scene.constants.collision_range = 0.05F;
    scene.constants.texel_collide_range = 24;
    scene.constants.gravity = glm::vec3(0.0F);
    Cloud result{frame_params(scene, 0), {}};
    Random random(seed);
    result.particles.resize(count);
    const auto vector = [&](float side) {
        return glm::vec3(random.between(-side, side), random.between(-side, side), random.between(-side, side));
    };
    for (std::size_t i = 0; i < count; ++i)
        result.particles.set(i, {vector(0.5F), glm::normalize(vector(1.0F)), random.between(0.1F, 3.0F), -1.0F});
    return result;
}

} // namespace

TEST_CASE("layered collision: layers hold the nearest in their order, and no more") {
    const FrameParams params = layered_params(3);
    const std::vector<glm::vec3> positions{
        {0.1F, 0.1F, 0.5F}, {0.15F, 0.1F, -0.5F}, {0.2F, 0.1F, 0.0F}, {0.1F, 0.2F, 0.75F}, {-0.9F, 0.1F, 0.0F}};
    const CollisionImage cdt = drawn(particles_at(positions), params);
    const glm::vec3 there(0.1F, 0.1F, 0.0F);
    CHECK(stored(cdt, params, 0, there) == glm::vec4(positions[1], 1.0F));
    CHECK(stored(cdt, params, 1, there) == glm::vec4(positions[2], 1.0F));
    CHECK(stored(cdt, params, 2, there) == glm::vec4(positions[0], 1.0F));
    CHECK(stored(cdt, params, 0, positions[4]) == glm::vec4(positions[4], 1.0F));
    CHECK(stored(cdt, params, 1, positions[4]) == glm::vec4(0.0F));
    CHECK(std::count_if(cdt.texels.begin(), cdt.texels.end(), [](glm::vec4 t) { return t.a != 0.0F; }) == 4);
}

TEST_CASE("layered collision: of equally deep particles the lower index comes first") {
    const FrameParams params = layered_params(4);
    const std::vector<glm::vec3> positions{
        {0.1F, 0.1F, 0.5F}, {0.2F, 0.1F, 0.25F}, {0.1F, 0.2F, 0.25F}, {0.2F, 0.2F, 0.25F}, {0.15F, 0.1F, 0.0F}};
    const CollisionImage cdt = drawn(particles_at(positions), params);
    int layer = 0;
    for (const std::size_t i : {4U, 1U, 2U, 3U})
        CHECK(stored(cdt, params, layer++, positions[0]) == glm::vec4(positions[i], 1.0F));
}

TEST_CASE("layered collision: a neighbour behind another particle is found where a layer holds it") {
    // A pair, the right one hidden by a particle far in front of it.
    const std::vector<glm::vec3> positions{{0.1F, 0.1F, 0.5F}, {0.3F, 0.1F, 0.5F}, {0.3F, 0.15F, -0.9F}};
    CHECK(!collided(step(particles_at(positions), [] {
        FrameParams params = layered_params(1);
        params.switches.search_window = SearchWindow::projected;
        return params;
    }())));
    const Particles after = step(particles_at(positions), layered_params(2));
    REQUIRE(collided(after, 0));
    CHECK(after.direction[0] == glm::vec3(-1.0F, 0.0F, 0.0F));
    CHECK(collided(after, 1));
    CHECK(!collided(after, 2));
}

TEST_CASE("layered collision: a neighbour in its own base texel is found, itself not") {
    const FrameParams params = layered_params(2);
    const Particles pair = step(particles_at({{0.1F, 0.1F, 0.5F}, {0.2F, 0.1F, 0.5F}}), params);
    CHECK(collided(pair, 0));
    CHECK(collided(pair, 1));
    CHECK(!collided(step(particles_at({{0.1F, 0.1F, 0.5F}}), params)));
    CHECK(!collided(step(particles_at({{0.1F, 0.1F, 0.5F}, {0.1F, 0.1F, 0.5F}}), params))); // coincident
    for (const CdtFormat format : {CdtFormat::rgba16f, CdtFormat::rgba8}) {
        FrameParams coded = params;
        coded.switches.cdt_format = format;
        CHECK(!collided(step(particles_at({{0.1F, 0.1F, 0.5F}}), coded)));
    }
}

TEST_CASE("layered collision: obstacles hide no particle, and particles no obstacle") {
    const FrameParams params = layered_params(2);
    const std::vector<glm::vec3> positions{{0.1F, 0.1F, 0.75F}, {0.3F, 0.1F, 0.75F}};
    const Particles behind = step(particles_at(positions), params, wall(-0.5F));
    CHECK(collided(behind, 0));
    CHECK(collided(behind, 1));
    const CollisionImage cdt = drawn(particles_at(positions), params, wall(0.875F));
    CHECK(stored(cdt, params, 0, positions[0]) == glm::vec4(positions[0], 1.0F));
    CHECK(cdt.at(4, 4).a != 0.0F);
    CHECK(collided(step(particles_at({{0.1F, 0.1F, 0.75F}}), params, wall(0.875F))));
}

TEST_CASE("layered collision: the second camera sees what the first one's nearest hides") {
    FrameParams params = layered_params(1);
    const std::vector<glm::vec3> positions{{0.1F, 0.1F, 0.5F}, {0.3F, 0.1F, 0.5F}, {0.3F, 0.15F, -0.9F}};
    params.switches.cdt_cameras = 2;
    params.second_proj_view = glm::mat4(0.0F); // from +x: z to the right
    params.second_proj_view[2][0] = 1.0F;
    params.second_proj_view[1][1] = 1.0F;
    params.second_proj_view[0][2] = -1.0F;
    params.second_proj_view[3][3] = 1.0F;
    const Particles after = step(particles_at(positions), params);
    CHECK(collided(after, 0));
    CHECK(collided(after, 1));
}

TEST_CASE("layered collision: the second camera stands at a right angle to the first, as far from the target") {
    const Camera camera{{1.0F, 2.0F, 4.0F}, {1.0F, 0.0F, 1.0F}};
    const Camera turned = turned_aside(camera);
    CHECK(turned.eye == glm::vec3(4.0F, 2.0F, 1.0F));
    CHECK(turned.target == camera.target);
}

TEST_CASE("layered collision: a projected window misses no stored particle within range") {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        Cloud c = cloud(seed, 1500);
        c.params.switches.cdt_layers = 8;
        c.params.switches.search_window = SearchWindow::projected;
        const Particles after = step(c.particles, c.params);
        const Neighbourhoods truth = find_neighbourhoods(c.particles.position, c.params.constants.collision_range);
        std::size_t found = 0, missed = 0, extra = 0;
        for (std::size_t i = 0; i < c.particles.size(); ++i) {
            const bool hit = after.collide_time[i] > 0.0F;
            const bool neighbour = truth.particle[i].nearest != no_neighbour;
            found += hit && neighbour ? 1U : 0U;
            missed += !hit && neighbour ? 1U : 0U;
            extra += hit && !neighbour ? 1U : 0U;
        }
        CHECK(found > 500);
        CHECK(missed == 0);
        CHECK(extra == 0);
    }
}

TEST_CASE("layered collision: a projected window is bounded by texel_collide_range") {
    Cloud c = cloud(4, 1500);
    c.params.switches.cdt_layers = 8;
    std::array<Particles, 2> after;
    for (const SearchWindow window : {SearchWindow::texels, SearchWindow::projected}) {
        c.params.switches.search_window = window;
        c.params.constants.texel_collide_range = 1; // the range projects to more
        after[static_cast<std::size_t>(window)] = step(c.particles, c.params);
    }
    CHECK(same_bits(after[0], after[1]));
}

TEST_CASE("layered collision: both of a pair answer, and their momentum stays") {
    for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba16f}) {
        FrameParams params = layered_params(2);
        params.switches.response = Response::mutual;
        params.switches.cdt_format = format;
        Random random(5);
        std::size_t hits = 0;
        double worst = 0.0;
        for (int round = 0; round < 4000; ++round) {
            const auto vector = [&](float side) {
                return glm::vec3(random.between(-side, side), random.between(-side, side), random.between(-side, side));
            };
            const glm::vec3 middle = vector(0.5F);
            Particles pair = particles_at({middle + vector(0.2F), middle + vector(0.2F)});
            for (std::size_t i = 0; i < 2; ++i) {
                pair.direction[i] = glm::normalize(vector(1.0F));
                pair.speed[i] = random.between(0.01F, 3.0F);
            }
            params.switches.speed_factor = random.between(0.0F, 1.0F);
            const Particles after = step(pair, params);
            REQUIRE(collided(after, 0) == collided(after, 1));
            if (!collided(after, 0))
                continue;
            ++hits;
            const double scale = glm::length(momentum(pair[0])) + glm::length(momentum(pair[1]));
            const glm::dvec3 change = momentum(after[0]) + momentum(after[1]) - momentum(pair[0]) - momentum(pair[1]);
            worst = std::max(worst, glm::length(change) / scale);
        }
        CHECK(hits > 500);
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("layered collision: head-on, speed_factor is the coefficient of restitution") {
    FrameParams params = layered_params(2);
    params.switches.response = Response::mutual;
    Particles pair = particles_at({{0.0F, 0.125F, 0.5F}, {0.25F, 0.125F, 0.5F}});
    pair.direction[1] = {-1.0F, 0.0F, 0.0F};
    pair.speed = {3.0F, 1.0F};
    const auto velocities = [&](float restitution) {
        params.switches.speed_factor = restitution;
        const Particles after = step(pair, params);
        return std::pair{momentum(after[0]).x, momentum(after[1]).x};
    };
    CHECK(velocities(1.0F) == std::pair{-1.0, 3.0}); // exchanged
    CHECK(velocities(0.0F) == std::pair{1.0, 1.0});  // together
    CHECK(velocities(0.5F) == std::pair{0.0, 2.0});
    params.switches.speed_factor = 0.5F; // to a standstill: the direction stays
    const Particles after = step(pair, params);
    CHECK(after.speed[0] == 0.0F);
    CHECK(after.direction[0] == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(after.position[0] == pair.position[0]);
    CHECK(after.position[1] == pair.position[1] + glm::vec3(1.0F, 0.0F, 0.0F));
}

TEST_CASE("layered collision: only who is seen and searches takes part in a mutual response") {
    FrameParams params = layered_params(1);
    params.switches.response = Response::mutual;
    Particles pair = particles_at({{0.0F, 0.125F, 0.5F}, {0.25F, 0.125F, 0.5F}});
    pair.direction[1] = {-1.0F, 0.0F, 0.0F};
    CHECK(collided(step(pair, params), 0));

    Particles hidden = particles_at({{0.0F, 0.125F, 0.5F}, {0.25F, 0.125F, 0.5F}, {0.25F, 0.125F, -0.75F}});
    hidden.direction[1] = {-1.0F, 0.0F, 0.0F};
    CHECK(!collided(step(hidden, params), 0));
    CHECK(!collided(step(hidden, params), 1));

    Particles cooling = pair;
    cooling.collide_time[1] = 0.25F;
    CHECK(!collided(step(cooling, params), 0));
    CHECK(!collided(step(cooling, params), 1));

    Particles parting = pair;
    std::swap(parting.direction[0], parting.direction[1]);
    CHECK(!collided(step(parting, params), 0));
}

TEST_CASE("layered collision: in mutual response an obstacle reflects what comes towards it") {
    FrameParams params = layered_params(1);
    params.switches.response = Response::mutual;
    Particles one = particles_at({{0.125F, 0.125F, 0.5F}});
    one.direction[0] = {0.0F, 0.0F, 1.0F};
    const Particles after = step(one, params, wall(0.75F));
    CHECK(momentum(after[0]) == glm::dvec3(0.0, 0.0, -1.5)); // 3 * restitution 1/2
    one.direction[0] = {0.0F, 0.0F, -1.0F};
    CHECK(!collided(step(one, params, wall(0.75F))));
}

TEST_CASE("layered collision: a crowd with mutual response keeps its momentum") {
    Cloud c = cloud(9, 2000);
    c.params.switches.cdt_layers = 8;
    c.params.switches.search_window = SearchWindow::projected;
    c.params.switches.response = Response::mutual;
    const Particles after = step(c.particles, c.params);
    glm::dvec3 change(0.0);
    double scale = 0.0;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        change += momentum(after[i]) - momentum(c.particles[i]);
        scale += glm::length(momentum(c.particles[i]));
        hits += after.collide_time[i] > 0.0F ? 1U : 0U;
    }
    CHECK(hits > 300);
    CHECK(glm::length(change) / scale < 1e-6);
}

TEST_CASE("layered collision: the same bits for any number of threads") {
    Cloud c = cloud(11, 3000);
    c.params.switches.cdt_layers = 4;
    c.params.switches.cdt_cameras = 2;
    c.params.switches.search_window = SearchWindow::projected;
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Particles one = step(c.particles, c.params);
    omp_set_num_threads(4);
    const Particles four = step(c.particles, c.params);
    omp_set_num_threads(threads);
    CHECK(same_bits(one, four));
}

TEST_CASE("layered collision: switches that do not go with remedies are told") {
    const auto error = [](const std::vector<std::pair<const char*, const char*>>& set) -> std::string {
        Switches switches;
        for (const auto& [name, value] : set)
            set_switch(switches, name, value);
        try {
            check_switches(switches);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    CHECK(error({}).empty());
    CHECK(error({{"empty_texel", "phantom"}, {"self_position", "texel"}}).empty());
    CHECK(error({{"cdt_layers", "4"}, {"response", "mutual"}, {"cdt_format", "rgba16f"}}).empty());
    for (const auto& [name, value] :
         std::vector<std::pair<const char*, const char*>>{{"perspective_divide", "off"},
                                                          {"base_texel", "truncate"},
                                                          {"self_position", "texel"},
                                                          {"empty_texel", "phantom"},
                                                          {"zero_distance", "hit"},
                                                          {"raster_position", "before_step"}})
        CHECK_THAT(error({{"cdt_layers", "2"}, {name, value}}),
                   Catch::StartsWith(std::string("switch ") + name + ": ") &&
                       Catch::EndsWith(std::string("not ") + value));
    CHECK_THAT(error({{"response", "mutual"}, {"cdt_format", "rgba8"}}), Catch::StartsWith("switch cdt_format: "));
    CHECK_THAT(error({{"response", "mutual"}, {"cdt_cameras", "2"}}), Catch::StartsWith("switch cdt_cameras: "));
    CHECK_THAT(error({{"search", "octree"}, {"cdt_cameras", "2"}}), Catch::StartsWith("switch search: "));
}

} // namespace lockstep::test::layered_collision_pass_test
