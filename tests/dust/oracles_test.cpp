#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include <glm/geometric.hpp>

#include "crosscheck/dust/scene.hpp"
#include "reference/model/random.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::oracles_test {

/// What must hold of any right dust system, found without its twins: closed forms, symmetries, counts, brute force.
namespace dust = lockstep::dust;

namespace {

/// Grains without gravity, drag or walls near them, in both arithmetics.
dust::Settings empty_room(std::size_t count = 1) {
    dust::Settings s;
    s.count = count;
    s.switches.random = dust::Random::integer;
    s.arithmetic = GENERATE(ArithmeticSwitch::plain, ArithmeticSwitch::exact);
    s.switches.radius_of_scale = 1.0F;
    s.gravity = glm::vec3(0.0F);
    s.air_resistance = 0.0F;
    s.scale = 0.1F;
    s.world = {glm::vec3(-1000.0F), glm::vec3(1000.0F)};
    return s;
}

/// Numbers of a grain, in [-1, 1).
glm::vec3 any_vector(std::uint64_t index, std::uint64_t seed = 7) {
    lockstep::Random random(seed, index);
    const auto number = [&] { return static_cast<float>(random.unit() * 2.0 - 1.0); };
    const float x = number(), y = number();
    return {x, y, number()};
}

dust::Tool tool(dust::Tool::Kind kind, int to = 1000) {
    return {.kind = kind, .from = 0, .to = to, .force = 30.0F, .range = 50.0F, .death_range = 0.0F};
}

/// Where cur -> next first comes to the surface of the sphere, by bisection in double.
glm::dvec3 contact_with(const glm::dvec3& current, const glm::dvec3& next, const glm::dvec3& centre, double reach) {
    double outside = 0.0, inside = 1.0;
    for (int k = 0; k < 100; ++k) {
        const double t = (outside + inside) / 2.0;
        (glm::length(current + (next - current) * t - centre) > reach ? outside : inside) = t;
    }
    return current + (next - current) * inside;
}

} // namespace

TEST_CASE("dust oracle: a fall with drag is its closed form") {
    for (const double c : {0.25, 1.0, 6.0, 59.0}) {
        dust::Settings s = empty_room();
        s.gravity = {0.0F, -9.8F, 0.0F};
        s.air_resistance = static_cast<float>(c);
        Grains grains(host_of(s));
        grains.place(0, {0.0F, 900.0F, 0.0F}, {});
        const double dt = double{s.tick}, k = 1.0 - c * dt, end = -9.8 / c;
        for (int n = 1; n <= 300; ++n) {
            grains.run("update", n);
            CHECK(grains.velocity().y == Approx(end * (1.0 - std::pow(k, n))).epsilon(2e-5));
            const double y = 900.0 + dt * end * (n - k * (1.0 - std::pow(k, n)) / (1.0 - k));
            CHECK(grains.position().y == Approx(y).epsilon(2e-5));
        }
    }
}

TEST_CASE("dust oracle: drag of more than the frame takes away alternates, of more than twice it grows without end") {
    const auto speeds = [](float c, int frames) {
        dust::Settings s = empty_room();
        s.tick = 1.0F / 30.0F;
        s.air_resistance = c;
        s.switches.world = dust::World::none;
        Grains grains(host_of(s));
        grains.place(0, {}, {1.0F, 0.0F, 0.0F});
        std::vector<float> all;
        for (int n = 0; n < frames; ++n) {
            grains.run("update", n);
            all.push_back(grains.velocity().x);
        }
        return all;
    };
    const std::vector<float> alternating = speeds(45.0F, 20);
    for (std::size_t n = 1; n < alternating.size(); ++n) {
        CHECK(alternating[n] * alternating[n - 1] < 0.0F);
        CHECK(std::abs(alternating[n]) < std::abs(alternating[n - 1]));
    }
    const std::vector<float> growing = speeds(100.0F, 200);
    CHECK(std::abs(growing[20]) > std::abs(growing[10]));
    CHECK_FALSE(std::isfinite(growing[199]));
}

TEST_CASE("dust oracle: elastic grains come to bounce at one height over the floor") {
    for (const double e : {0.3, 0.6}) {
        dust::Settings s = empty_room();
        s.gravity = {0.0F, -9.8F, 0.0F};
        s.air_resistance = 1.0F;
        s.elasticity = static_cast<float>(e);
        s.world.min.y = 0.0F;
        Grains grains(host_of(s));
        grains.place(0, {0.0F, 2.0F, 0.0F}, {});
        for (int n = 0; n < 3600; ++n)
            grains.run("update", n);
        const double dt = 1.0 / 60.0, k = 1.0 - dt;
        const double height = e * 9.8 * dt * dt / ((1.0 + e * k) * (1.0 + e)), speed = e * 9.8 * dt / (1.0 + e * k);
        CHECK(double{grains.position().y} - double{s.scale} == Approx(height).epsilon(1e-3));
        CHECK(double{grains.velocity().y} == Approx(speed).epsilon(1e-3));
    }
}

TEST_CASE("dust oracle: without loss a grain between two walls is a triangle wave") {
    dust::Settings s = empty_room();
    s.elasticity = 1.0F;
    s.world = {glm::vec3(-50.0F), glm::vec3(50.0F)};
    Grains grains(host_of(s));
    grains.place(0, {}, {37.0F, 0.0F, 0.0F});
    for (int n = 0; n < 600; ++n)
        grains.run("update", n);
    CHECK(double{grains.position().x} == Approx(-29.19998).margin(2e-3));
    CHECK(std::abs(grains.velocity().x) == Approx(37.0F));
}

TEST_CASE("dust oracle: a bounce off a sphere keeps the laws, its contact found by bisection") {
    dust::Settings s = empty_room(500);
    s.colliders = {{.position = {1.0F, 2.0F, 3.0F}, .radius = 5.0F}};
    const dust::HostPtr host = host_of(s);
    Grains grains(host);
    const glm::dvec3 centre(1.0, 2.0, 3.0);
    const double reach = double{host->radius()} + 5.0, e = double{s.elasticity};
    std::vector<glm::vec3> at(s.count), v(s.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::vec3 out = glm::normalize(any_vector(i)), aside = any_vector(i, 8);
        at[i] = glm::vec3(centre) + out * 5.8F;
        v[i] = (-out + 0.4F * aside) * 120.0F;
        grains.place(i, at[i], v[i]);
    }
    grains.run("update");
    std::size_t hits = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::dvec3 next = glm::dvec3(at[i]) + glm::dvec3(v[i]) * double{s.tick};
        if (glm::length(next - centre) > reach - 0.01)
            continue;
        ++hits;
        const glm::dvec3 contact = contact_with(at[i], next, centre, reach);
        const glm::dvec3 normal = (contact - centre) / reach, velocity(v[i]), after(grains.velocity(i));
        CHECK(glm::length(after) == Approx(e * glm::length(velocity)).epsilon(1e-4));
        CHECK(glm::length(after - (velocity - 2.0 * glm::dot(velocity, normal) * normal) * e) < 0.02);
        const double in = glm::length(contact - glm::dvec3(at[i]));
        const double out = glm::length(glm::dvec3(grains.position(i)) - contact);
        CHECK(in + out / e == Approx(glm::length(next - glm::dvec3(at[i]))).epsilon(1e-3));
    }
    CHECK(hits > 300);
}

TEST_CASE("dust oracle: tools and blasts push along the line to their centre, and fade as they should") {
    using Kind = dust::Tool::Kind;
    dust::Settings s = empty_room(400);
    s.cannon = {{.frame = 0, .position = {0.0F, 0.0F, 0.0F}, .speed = 0.0F, .range = 40.0F, .force = 3000.0F}};
    s.colliders = {{.radius = 0.5F}};
    for (const char* kernel : {"vacuum_up", "blow_wind", "explode"}) {
        s.tools = {tool(kernel == std::string("blow_wind") ? Kind::wind : Kind::vacuum)};
        Grains grains(host_of(s));
        for (std::size_t i = 0; i < s.count; ++i)
            grains.place(i, any_vector(i) * 20.0F, any_vector(i, 9));
        grains.place(0, {0.0F, 0.0F, 8.0F}, {});
        grains.place(1, {0.0F, 0.0F, 16.0F}, {});
        grains.place(2, {0.0F, 0.0F, 40.0F}, {});
        grains.run(kernel, 1);
        for (std::size_t i = 3; i < s.count; ++i) {
            const glm::dvec3 pushed = glm::dvec3(grains.velocity(i)) - glm::dvec3(any_vector(i, 9));
            const glm::dvec3 way(any_vector(i) * 20.0F);
            CHECK(glm::length(glm::cross(pushed, way)) <= 1e-4 * glm::length(way));
        }
        const float near = grains.velocity(0).z, far = grains.velocity(1).z;
        if (kernel == std::string("vacuum_up"))
            CHECK(far == Approx(near / 4.0F));
        if (kernel == std::string("blow_wind"))
            CHECK(far == Approx(near / 2.0F));
        if (kernel == std::string("explode")) {
            CHECK(far == Approx(near * (1.0F - 256.0F / 1600.0F) / (1.0F - 64.0F / 1600.0F)));
            CHECK(grains.velocity(2).z == 0.0F);
        }
    }
}

TEST_CASE("dust oracle: one in a hundred of the dead comes back, inside the emitter's cone") {
    dust::Settings s = empty_room(200'000);
    s.tools = {{.kind = dust::Tool::Kind::emit, .from = 0, .to = 10, .force = 1.0F, .angle = 30.0F}};
    const bool integer = GENERATE(true, false);
    s.switches.random = integer ? dust::Random::integer : dust::Random::sin_portable;
    Grains grains(host_of(s));
    for (std::size_t i = 0; i < s.count; ++i)
        grains.state.set(dust::field::alive, i, std::int32_t{0});
    grains.state.set(dust::field::alive_number, 0, std::uint32_t{0});
    grains.run("emit", 3);
    std::size_t emitted = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (grains.alive(i) == 0)
            continue;
        ++emitted;
        const glm::vec3 v = grains.velocity(i);
        CHECK(std::sqrt(v.x * v.x + v.y * v.y) <= v.z * std::tan(30.0F * 0.0174532924F) * 1.00001F);
    }
    CHECK(grains.count() == emitted);
    const double share = double(emitted) / double(s.count);
    if (integer)
        CHECK(std::abs(share - 167773.0 / 16777216.0) < 5.0 * std::sqrt(0.01 * 0.99 / double(s.count)));
    else
        CHECK(share == Approx(0.0114).margin(0.002)); // the sine hash's numbers are multiples of 1/256 too often
}

TEST_CASE("dust oracle: an emission a second later is the next grain's, by the hash") {
    dust::Settings s = empty_room(20'000);
    s.tick = 1.0F;
    s.switches.random = dust::Random::sin_portable;
    s.tools = {tool(dust::Tool::Kind::emit)};
    const auto emitted = [&](int frame) {
        Grains grains(host_of(s));
        std::vector<int> alive;
        for (std::size_t i = 0; i < s.count; ++i)
            grains.state.set(dust::field::alive, i, std::int32_t{0});
        grains.run("emit", frame);
        for (std::size_t i = 0; i < s.count; ++i)
            alive.push_back(grains.alive(i));
        return alive;
    };
    const std::vector<int> now = emitted(4), later = emitted(5);
    CHECK(std::equal(later.begin(), later.end() - 1, now.begin() + 1));
    CHECK(std::count(now.begin(), now.end(), 1) > 100);
}

namespace {

dust::Settings furnished(std::size_t count) {
    dust::Settings s = empty_room(count);
    s.gravity = {0.0F, -9.8F, 0.0F};
    s.air_resistance = 1.0F;
    s.world = {glm::vec3(-20.0F), glm::vec3(20.0F)};
    s.colliders = {{.position = {3.0F, 2.0F, 1.0F}, .radius = 5.0F},
                   {.sphere = false, .position = {-8.0F, -3.0F, 2.0F}, .scale = {6, 3, 8}}};
    s.tools = {tool(dust::Tool::Kind::vacuum, 12), tool(dust::Tool::Kind::wind)};
    s.controller = {{0, {0.5F, -8.0F, -3.0F}, {0.3F, 0.4F, 1.0F}}};
    for (const int frame : {2, 9})
        s.cannon.push_back({.frame = frame, .position = {4.0F, 2.5F, 1.0F}, .speed = 0.0F, .range = 15.0F});
    return s;
}

} // namespace

TEST_CASE("dust oracle: grains in another order have the same fates, bit for bit") {
    const dust::Settings s = furnished(700);
    std::vector<std::size_t> order(s.count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::rotate(order.begin(), order.begin() + 313, order.end());
    std::reverse(order.begin() + 100, order.end());
    Grains one(host_of(s)), other(host_of(s));
    for (std::size_t i = 0; i < s.count; ++i) {
        one.place(i, any_vector(i) * 19.0F, any_vector(i, 5) * 60.0F);
        other.place(order[i], any_vector(i) * 19.0F, any_vector(i, 5) * 60.0F);
    }
    for (int frame = 0; frame < 20; ++frame)
        for (const char* kernel : {"explode", "vacuum_up", "blow_wind", "update"}) {
            one.run(kernel, frame);
            other.run(kernel, frame);
        }
    CHECK(one.count() < s.count);
    CHECK(one.count() == other.count());
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(one.position(i) == other.position(order[i]));
        CHECK(one.velocity(i) == other.velocity(order[i]));
        CHECK(one.alive(i) == other.alive(order[i]));
    }
}

TEST_CASE("dust oracle: a mirrored room has mirrored grains, bit for bit but for the signs of zeros") {
    const dust::Settings s = furnished(500);
    dust::Settings mirrored = s;
    for (dust::Collider& collider : mirrored.colliders)
        collider.position.x = -collider.position.x;
    for (dust::Ball& ball : mirrored.cannon)
        ball.position.x = -ball.position.x;
    for (dust::Pose& pose : mirrored.controller) {
        pose.position.x = -pose.position.x;
        pose.forward.x = -pose.forward.x;
    }
    const glm::vec3 turned(-1.0F, 1.0F, 1.0F);
    Grains one(host_of(s)), other(host_of(mirrored));
    for (std::size_t i = 0; i < s.count; ++i) {
        one.place(i, any_vector(i) * 19.0F, any_vector(i, 5) * 60.0F);
        other.place(i, turned * (any_vector(i) * 19.0F), turned * (any_vector(i, 5) * 60.0F));
    }
    for (int frame = 0; frame < 20; ++frame)
        for (const char* kernel : {"explode", "vacuum_up", "blow_wind", "update"}) {
            one.run(kernel, frame);
            other.run(kernel, frame);
        }
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(one.position(i) == turned * other.position(i));
        CHECK(one.velocity(i) == turned * other.velocity(i));
        CHECK(one.alive(i) == other.alive(i));
    }
}

TEST_CASE("dust oracle: a box that is not turned, of side 1 at the origin, is an axis-aligned one") {
    dust::Settings s = empty_room(2000);
    s.colliders = {{.sphere = false}};
    dust::Settings aligned = s;
    aligned.switches.box_kind = dust::BoxKind::aabb;
    Grains one(host_of(s)), other(host_of(aligned));
    std::size_t hits = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        one.place(i, any_vector(i) * 1.5F, any_vector(i, 5) * 60.0F);
        other.place(i, any_vector(i) * 1.5F, any_vector(i, 5) * 60.0F);
    }
    one.run("update");
    other.run("update");
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(one.position(i) == other.position(i));
        CHECK(one.velocity(i) == other.velocity(i));
        hits += one.velocity(i) == any_vector(i, 5) * 60.0F ? 0 : 1;
    }
    CHECK(hits > 100);
}

TEST_CASE("dust oracle: steps of half the time halve the error") {
    const auto error = [](int parts) {
        dust::Settings s;
        s.count = 1;
        s.switches.random = dust::Random::integer;
        s.switches.world = dust::World::none;
        s.tick = 1.0F / static_cast<float>(30 * parts);
        Grains grains(host_of(s));
        grains.place(0, {0.0F, 100.0F, 0.0F}, {5.0F, 20.0F, 0.0F});
        for (int n = 0; n < 30 * parts; ++n)
            grains.run("update", n);
        const double y = 100.0 + (20.0 + 9.8) * (1.0 - std::exp(-1.0)) - 9.8; // one second, drag 1
        return std::abs(double{grains.position().y} - y);
    };
    CHECK(error(1) / error(2) == Approx(2.0).margin(0.1));
    CHECK(error(2) / error(4) == Approx(2.0).margin(0.1));
}

TEST_CASE("dust oracle: the numbers are as coarse as the sine makes them, and even by integers") {
    dust::Settings s = empty_room(100'000);
    s.spawn = {{0.0F, 0.0F, 0.0F}, {100.0F, 1.0F, 1.0F}};
    const bool integer = GENERATE(true, false);
    s.switches.random = integer ? dust::Random::integer : dust::Random::sin_portable;
    Grains grains(host_of(s));
    grains.run("populate");
    std::set<float> distinct;
    std::vector<double> bins(64);
    double sum_y = 0.0, sum_z = 0.0, sum_yz = 0.0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const glm::vec3 p = grains.position(i);
        distinct.insert(p.y);
        bins[std::min<std::size_t>(static_cast<std::size_t>(p.y * 64.0F), 63)] += 1.0;
        sum_y += p.y;
        sum_z += p.z;
        sum_yz += double{p.y} * double{p.z};
    }
    const double n = double(s.count);
    double chi = 0.0;
    for (const double bin : bins)
        chi += (bin - n / 64.0) * (bin - n / 64.0) / (n / 64.0);
    CHECK(std::abs(sum_yz / n - (sum_y / n) * (sum_z / n)) < 0.01);
    CHECK(std::abs(sum_y / n - 0.5) < 0.01);
    if (integer) {
        CHECK(distinct.size() > 99'000);
        CHECK(chi < 110.0); // 63 degrees of freedom
    } else {
        CHECK(distinct.size() < 20'000);
    }
}

TEST_CASE("dust oracle: no shipped scene comes to a NaN") {
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes/dust")) {
        if (entry.path().extension() != ".json")
            continue;
        for (const char* preset : {"corrected", "exact"}) {
            INFO(entry.path() << " " << preset);
            const dust::Settings s = dust::load_scene(entry.path(), {.particles = 500, .preset = preset});
            const System system = dust::system(host_of(s));
            ReferenceRun run(system, named_profile("strict"));
            for (int frame = 0; frame < 90; ++frame)
                run.step(frame);
            std::size_t nan = 0;
            for (std::size_t i = 0; i < s.count; ++i)
                nan += has_nan(run.state()[dust::grain_buffer], i) ? 1 : 0;
            CHECK(nan == 0);
        }
    }
}

} // namespace lockstep::test::oracles_test
