#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "reference/model/random.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::laws_test {

/// Laws of bounces off boxes and walls, by brute force in double; and the published hash in another program's hands.
namespace dust = lockstep::dust;

namespace {

dust::Settings empty_room(std::size_t count) {
    dust::Settings s;
    s.count = count;
    s.switches.random = dust::Random::integer;
    s.switches.radius_of_scale = 1.0F;
    s.gravity = glm::vec3(0.0F);
    s.air_resistance = 0.0F;
    s.elasticity = 0.6F;
    s.scale = 0.1F;
    s.world = {glm::vec3(-1000.0F), glm::vec3(1000.0F)};
    return s;
}

glm::vec3 any_vector(std::uint64_t index, std::uint64_t seed = 7) {
    lockstep::Random random(seed, index);
    const auto number = [&] { return static_cast<float>(random.unit() * 2.0 - 1.0); };
    const float x = number(), y = number();
    return {x, y, number()};
}

/// Where cur -> next first comes into what `inside` says, by bisection.
template <class Inside> glm::dvec3 entry(const glm::dvec3& current, const glm::dvec3& next, const Inside& inside) {
    double out = 0.0, in = 1.0;
    for (int k = 0; k < 100; ++k) {
        const double t = (out + in) / 2.0;
        (inside(current + (next - current) * t) ? in : out) = t;
    }
    return current + (next - current) * in;
}

/// The published hash, its sine the nearest float to the true one.
float rounded_sine(float x) { return static_cast<float>(std::sin(double{x})); }
float hashed(float a) {
    const float b = rounded_sine(a) * 39482.17593F;
    return b - std::floor(b);
}
float r11(float s) { return hashed(7.8671F * s + s * 3.3419F); }

} // namespace

TEST_CASE("dust oracle: a bounce off a turned box keeps the laws, its contact found by bisection") {
    dust::Settings s = empty_room(3000);
    const glm::vec3 degrees = GENERATE(glm::vec3(0.0F), glm::vec3(30.0F, 20.0F, 45.0F));
    s.colliders = {{.sphere = false, .position = {1.0F, 2.0F, 3.0F}, .scale = glm::vec3(6.0F), .rotate = degrees}};
    const dust::HostPtr host = host_of(s);
    Grains grains(host);
    const glm::dvec3 centre(1.0, 2.0, 3.0);
    const double half = 3.0 + double{host->radius()}, e = double{s.elasticity};
    const glm::dmat3 to_local(glm::dmat4(host->boxes()[0].world_to_local) * 6.0);
    const auto inside = [&](const glm::dvec3& p) {
        const glm::dvec3 local = glm::abs(to_local * (p - centre));
        return std::max({local.x, local.y, local.z}) < half;
    };
    std::vector<glm::vec3> at(s.count), v(s.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::vec3 out = glm::normalize(any_vector(i)) * 5.5F;
        at[i] = glm::vec3(centre) + out;
        v[i] = (-out * 0.25F + any_vector(i, 8) * 0.4F) * 60.0F;
        grains.place(i, at[i], v[i]);
    }
    grains.run("update");
    std::size_t hits = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::dvec3 cur(at[i]), next = cur + glm::dvec3(v[i]) * double{s.tick};
        if (inside(cur) || !inside(next))
            continue;
        const glm::dvec3 contact = entry(cur, next, inside), after(grains.velocity(i));
        const double in = glm::length(contact - cur), len = glm::length(next - cur);
        const glm::dvec3 local = glm::abs(to_local * (contact - centre));
        const double first = std::max({local.x, local.y, local.z});
        const double second = local.x + local.y + local.z - first - std::min({local.x, local.y, local.z});
        if (first - second < 0.01)
            continue; // at an edge
        ++hits;
        CHECK(glm::length(after) == Approx(e * glm::length(glm::dvec3(v[i]))).epsilon(1e-4));
        const double out = glm::length(glm::dvec3(grains.position(i)) - contact);
        CHECK(std::abs(in + out / e - len) < 2e-3);
        // Across the face the speed turns and is slowed down, along it it is slowed down alone.
        const glm::dvec3 was = to_local * glm::dvec3(v[i]), is = to_local * after;
        for (int axis = 0; axis < 3; ++axis)
            CHECK(std::abs(is[axis] - (local[axis] == first ? -e : e) * was[axis]) < 1e-3);
    }
    CHECK(hits > 300);
}

TEST_CASE("dust oracle: a bounce off a wall keeps the laws, on all six") {
    dust::Settings s = empty_room(3000);
    s.world = {{-4.0F, -5.0F, -6.0F}, {5.0F, 6.0F, 4.0F}};
    const dust::HostPtr host = host_of(s);
    Grains grains(host);
    const double r = double{host->radius()}, e = double{s.elasticity};
    std::vector<glm::vec3> at(s.count), v(s.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        at[i] = any_vector(i) * 3.8F;
        v[i] = any_vector(i, 9) * 200.0F;
        grains.place(i, at[i], v[i]);
    }
    grains.run("update");
    std::array<int, 6> hits{};
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::dvec3 cur(at[i]), way = glm::dvec3(v[i]) * double{s.tick}, next = cur + way;
        int crossed = 0, wall = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (const bool upper : {true, false}) {
                const double limit = upper ? double{s.world.max[axis]} - r : double{s.world.min[axis]} + r;
                if (upper ? next[axis] > limit : next[axis] < limit) {
                    ++crossed;
                    wall = 2 * axis + (upper ? 0 : 1);
                }
            }
        if (crossed != 1)
            continue;
        ++hits[static_cast<std::size_t>(wall)];
        const int axis = wall / 2;
        const double limit = wall % 2 == 0 ? double{s.world.max[axis]} - r : double{s.world.min[axis]} + r;
        const double t = (limit - cur[axis]) / way[axis];
        glm::dvec3 right = cur + way * t, mirrored = way, velocity(v[i]);
        mirrored[axis] = -mirrored[axis];
        velocity[axis] = -velocity[axis];
        right += mirrored * ((1.0 - t) * e);
        CHECK(glm::length(glm::dvec3(grains.position(i)) - right) < 1e-4);
        CHECK(glm::length(glm::dvec3(grains.velocity(i)) - velocity * e) < 1e-3);
    }
    for (const int of_wall : hits)
        CHECK(of_wall > 20);
}

TEST_CASE("dust oracle: ten thousand sub-steps a frame see every sphere that one step a frame tunnels through, unless "
          "movements are swept") {
    for (const auto& [speed, sweep] : {std::pair(60.0F, dust::OffOn::off), std::pair(2400.0F, dust::OffOn::off),
                                       std::pair(60.0F, dust::OffOn::on), std::pair(2400.0F, dust::OffOn::on)}) {
        dust::Settings s = empty_room(300);
        s.switches.sweep = sweep;
        s.colliders = {{.radius = 2.0F}};
        Grains grains(host_of(s));
        std::size_t met = 0, tunnelled = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const glm::vec3 out = glm::normalize(any_vector(i));
            grains.place(i, out * 2.5F, (-out + any_vector(i, 3) * 0.5F) * speed);
        }
        const SystemState start = grains.state;
        grains.run("update");
        for (std::size_t i = 0; i < s.count; ++i) {
            const glm::dvec3 cur(start.view().vec3(dust::field::position, i));
            const glm::dvec3 v(start.view().vec3(dust::field::velocity, i));
            bool meets = false;
            for (int k = 1; k <= 10'000 && !meets; ++k)
                meets = glm::length(cur + v * (double{s.tick} * k / 10'000.0)) < 2.1;
            const bool bounced = glm::length(grains.velocity(i) - glm::vec3(v)) > 1e-3F * speed;
            met += meets ? 1 : 0;
            tunnelled += meets && !bounced ? 1 : 0;
            CHECK((meets || !bounced));
        }
        CHECK(met > 150);
        CHECK((speed < 100.0F || sweep == dust::OffOn::on ? tunnelled == 0 : tunnelled > met / 2));
    }
}

TEST_CASE("dust by hand: grain 12345 by the published hash and the sine's nearest float, to the last digit") {
    const float i = 12345.0F, s = i / (100.0F * 100.0F);
    CHECK(s == 1.23450005F);
    const glm::vec3 r(r11(s), r11(s + 2.1759F), r11(s + 4.7921F));
    CHECK(r == glm::vec3(0.77734375F, 0.46484375F, 0.05859375F));
    const auto lerp = [](float a, float b, float t) { return a + (b - a) * t; };
    CHECK(lerp(-50.0F, 50.0F, r.x) == 27.734375F);
    CHECK(lerp(0.0F, 5.0F, r.y) == 2.32421875F);
    CHECK(lerp(-50.0F, 50.0F, r.z) == -44.140625F);
    const float row = i / 100.0F, step = i - 100.0F * std::floor(row);
    CHECK(hashed(step * 7.8671F + row * 3.3419F) == 0.888549805F);
    const float of_ray = i / 82801.277F, th = lerp(-6.28318530F, 6.28318530F, r11(of_ray)), rho = r11(of_ray + 2.1759F);
    CHECK(th == -0.63813591F);
    CHECK(rho == 0.6015625F);
    const float tangent = static_cast<float>(std::tan(double{30.0F * 0.0174532924F}));
    CHECK(static_cast<float>(std::cos(double{th})) * rho * tangent == 0.278963864F);
    CHECK(rounded_sine(th) * rho * tangent == -0.206893653F);
}

TEST_CASE("dust by hand: on the way to the sphere's answer, and to the turned box's") {
    dust::Settings s = empty_room(1);
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F}};
    const dust::HostPtr host = host_of(s);
    Grains grains(host);
    grains.place(0, {3.0F, 8.0F, 0.0F}, {0.0F, -120.0F, 0.0F});
    const auto row_of = [&](std::string_view label) {
        for (const auto& pass : dust::twins(host))
            if (pass->name() == "update")
                for (const RecordedRow& row :
                     pass->record({std::as_const(grains.state).view(), 0}, 0, named_profile("strict")))
                    if (row.site->label == label)
                        return row.values;
        FAIL(label << " is not come by");
        return std::array<float, 4>{};
    };
    CHECK(row_of("nearest of the ray")[0] == 5.5F);
    CHECK(row_of("squared distance of the ray")[0] == 9.0F);
    CHECK(row_of("contact")[1] == 6.62431812F);
    CHECK(row_of("normal")[0] == 0.588235319F);
    CHECK(row_of("normal")[1] == 0.808689833F);
}

TEST_CASE("dust failure recheck_mismatch: in rounded arithmetic the cone's test and its repetition never differ") {
    dust::Settings s = empty_room(20'000);
    s.tools = {{.kind = dust::Tool::Kind::vacuum, .from = 0, .to = 1, .force = 1.0F, .range = 50.0F}};
    const dust::HostPtr host = host_of(s);
    Grains grains(host);
    for (std::size_t i = 0; i < s.count; ++i) {
        const float z = 1.0F + std::abs(any_vector(i).x) * 9.0F, turn = any_vector(i).y * 3.14159F;
        grains.place(i, {z * std::cos(turn), z * std::sin(turn), z}, {});
    }
    std::size_t pulled = 0, immortal = 0;
    for (const auto& pass : dust::twins(host))
        if (pass->name() == "vacuum_up")
            for (std::size_t i = 0; i < s.count; ++i) {
                bool in = false;
                for (const RecordedRow& row :
                     pass->record({std::as_const(grains.state).view(), 0}, i, named_profile("strict"))) {
                    in = in || (row.site->label == "in the cone" && row.values[0] == 1.0F);
                    immortal += row.site->label == "grain was in the cone" && row.values[0] == 0.0F ? 1 : 0;
                }
                pulled += in ? 1 : 0;
            }
    CHECK(pulled > 1000);
    CHECK(pulled < 19'000); // on the border itself
    CHECK(immortal == 0);
}

} // namespace lockstep::test::laws_test
