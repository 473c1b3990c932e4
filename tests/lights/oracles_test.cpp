#include <bit>
#include <functional>

#include "crosscheck/judge/dispatch.hpp"
#include "reference/lights/volume_twin.hpp"
#include "tests/lights/lit_points.hpp"

namespace lockstep::test::oracles_test {

/// What must hold whatever the twin says: brute force in double, conservation, symmetries.
namespace lights = lockstep::lights;

namespace {

__extension__ using Wide = __int128;

/// Lights that stand, in a grid that is symmetric around the origin; the floor fills the image's middle.
lights::Settings standing(std::size_t count, lights::Accumulate accumulate = lights::Accumulate::fixed64) {
    lights::Settings s = room(count);
    s.switches.motion = lights::Motion::still;
    s.switches.accumulate = accumulate;
    s.width = s.height = 4;
    return s;
}

double weight_of(double s, double range) {
    const double share = s / (range * range);
    return (1.0 - share * share) * (1.0 - share * share) / (s + 1.0);
}

/// Calls `visit(voxel, q, s)` for each voxel centre that lies in the light's ball.
void for_each_in_ball(const lights::Grid& grid, const lights::Light& light,
                      const std::function<void(std::size_t, const glm::dvec3&, double)>& visit) {
    for (std::size_t i = 0; i < grid.count(); ++i) {
        const lights::Voxel v = lights::Voxel::of(grid, i);
        const glm::dvec3 centre = glm::dvec3(grid.origin) + (glm::dvec3(v.x, v.y, v.z) + 0.5) * double{grid.voxel};
        const glm::dvec3 q = glm::dvec3(light.position) - centre;
        const double s = q.x * q.x + q.y * q.y + q.z * q.z;
        if (s <= double{light.range} * light.range)
            visit(i, q, s);
    }
}

/// The lights shifted, mirrored or in another order, changed one by one.
lights::Settings changed(lights::Settings s, const std::function<void(lights::Light&)>& change) {
    for (lights::Light& light : s.lights)
        change(light);
    return s;
}

} // namespace

TEST_CASE("lights oracles: a voxel's sums are those of brute force in double over all lights") {
    const auto accumulate =
        GENERATE(lights::Accumulate::gather, lights::Accumulate::fixed64, lights::Accumulate::fixed32,
                 lights::Accumulate::float_cas, lights::Accumulate::blend);
    LitPoints points(standing(64, accumulate));
    points.step();
    const lights::Settings& s = points.host().settings();
    std::vector<std::array<double, 8>> sums(s.grid.count());
    for (const lights::Light& light : s.lights)
        for_each_in_ball(s.grid, light, [&](std::size_t i, const glm::dvec3& q, double squared) {
            const double w = weight_of(squared, double{light.range}), unit = w / std::sqrt(squared);
            const std::array<double, 8> add{light.colour.x * w, light.colour.y * w, light.colour.z * w, 1.0,
                                            q.x * unit,         q.y * unit,         q.z * unit,         w};
            for (std::size_t c = 0; c < 8; ++c)
                sums[i][c] += add[c];
        });
    // A fixed-point addend is right to half a unit; floats to 2^-24 a sum, each addend to some units of its last place.
    const double unit = accumulate == lights::Accumulate::fixed32 ? std::ldexp(0.5, -points.host().fixed_bits()) : 0.0;
    double beyond = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const LitPoints::Texel is = points.texel(i);
        const double n = sums[i][3];
        CHECK(double{is[3]} == n);
        for (std::size_t c = 0; c < 8; ++c)
            beyond = std::max(beyond, std::abs(double{is[c]} - sums[i][c]) - unit * n - (n + 8.0) * 0x1p-24 * n);
    }
    CHECK(beyond == 0.0);
}

TEST_CASE("lights oracles: fixed64 is the exact integer sum of its addends") {
    lights::Settings s = standing(256);
    const lights::HostPtr host = host_of(s);
    const System system = lights::system(host);
    ReferenceRun run(system, named_profile("strict"));
    run.step(0);
    LitPoints points(s);
    const std::size_t voxels = s.grid.count();
    std::size_t different = 0;
    for (std::size_t i = 0; i < voxels; i += 7) {
        const lights::Voxel v = lights::Voxel::of(s.grid, i);
        std::array<Wide, 7> sums{};
        for (std::size_t light = 0; light < s.lights.size(); ++light)
            if (const auto made = points.added(light, {v.x, v.y, v.z}))
                for (std::size_t k = 0; k < 7; ++k)
                    sums[k] += static_cast<Wide>(
                        std::floor(static_cast<long double>(static_cast<float>(made->channels()[k])) * 0x1p32L));
        for (std::size_t k = 0; k < 7; ++k) {
            const SystemView seen = run.state().view();
            const std::uint64_t words = std::uint64_t{seen.word(lights::field::word, i + (2 * k + 1) * voxels)} << 32U |
                                        seen.word(lights::field::word, i + 2 * k * voxels);
            different += words == static_cast<std::uint64_t>(sums[k]) ? 0 : 1;
        }
    }
    CHECK(different == 0);
}

TEST_CASE("lights oracles: counts and colours are those of the lattice points in each light's ball") {
    lights::Settings s = standing(64);
    s.switches.attenuation = lights::Attenuation::none;
    s.switches.direction_weight = lights::DirectionWeight::one;
    for (lights::Light& light : s.lights)
        light.colour = glm::floor(light.colour * 256.0F) / 256.0F;
    LitPoints points(s);
    points.step();
    double count = 0.0, red = 0.0, counted = 0.0, added = 0.0;
    for (const lights::Light& light : s.lights)
        for_each_in_ball(s.grid, light, [&](std::size_t, const glm::dvec3&, double) {
            counted += 1.0;
            added += double{light.colour.x};
        });
    for (std::size_t i = 0; i < s.grid.count(); ++i) {
        red += double{points.texel(i)[0]};
        count += double{points.texel(i)[3]};
    }
    CHECK(count == counted);
    CHECK(red == added);
}

TEST_CASE("lights oracles: samples at the midpoints of every voxel have the volume's own mean") {
    lights::Settings s = standing(64);
    s.switches.supersample = lights::Supersample::two;
    s.switches.outside = lights::Outside::clamp;
    LitPoints points(s);
    points.step();
    double all = 0.0, sampled = 0.0;
    for (std::size_t i = 0; i < s.grid.count(); ++i) {
        const lights::Voxel v = lights::Voxel::of(s.grid, i);
        all += double{points.texel(i)[0]};
        sampled += double{points.sampled(glm::vec3(v.x, v.y, v.z) + 0.5F)[0]};
    }
    CHECK(sampled == Approx(all).epsilon(1e-6));
}

TEST_CASE("lights oracles: an affine volume comes out as it is, a constant one in every way") {
    using Way = lights::Interpolation;
    const auto way = GENERATE(Way::nearest, Way::trilinear, Way::trilinear8, Way::trilinear_hw, Way::tricubic);
    const auto samples = GENERATE(lights::Supersample::one, lights::Supersample::two);
    lights::Settings s = one_light();
    s.switches.interpolation = way;
    s.switches.supersample = samples;
    LitPoints affine(s), constant(s);
    const auto value = [](const glm::dvec3& u) { return 8.0 + u.x - 0.5 * u.y + 0.25 * u.z; };
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                affine.set({x, y, z}, {static_cast<float>(value(glm::dvec3(x, y, z) + 0.5))});
                constant.set({x, y, z}, {0.75F, 0.5F, 0.25F, 3.0F, -1.0F, 2.0F, -0.5F, 1.5F});
            }
    const double most = way == Way::nearest ? 0.5 * 1.75 : way == Way::trilinear8 ? 1.75 / 512.0 + 1e-5 : 1e-5;
    double furthest = 0.0;
    for (int k = 0; k < 64; ++k) {
        Random random(3, static_cast<std::uint64_t>(k));
        const glm::vec3 u(static_cast<float>(4.0 + 8.0 * random.unit()), static_cast<float>(4.0 + 8.0 * random.unit()),
                          static_cast<float>(4.0 + 8.0 * random.unit()));
        furthest = std::max(furthest, std::abs(double{affine.sampled(u)[0]} - value(glm::dvec3(u))));
        const LitPoints::Texel one = constant.sampled(u);
        CHECK(one[0] == Approx(0.75).epsilon(1e-6));
        CHECK(one[6] == Approx(-0.5).epsilon(1e-6));
    }
    CHECK(furthest <= most);
    if (way == Way::nearest)
        CHECK(furthest > 0.2);
}

TEST_CASE("lights oracles: another order of lights, a mirror, a shift and twice the colour do what they should") {
    const lights::Settings s = standing(48);
    LitPoints points(s);
    points.step();
    const auto same = [&](const lights::Settings& other, const std::function<glm::ivec3(glm::ivec3)>& place,
                          const std::function<LitPoints::Texel(LitPoints::Texel)>& as) {
        LitPoints again(other);
        again.step();
        std::size_t different = 0;
        for (int z = 0; z < s.grid.size.z; ++z)
            for (int y = 0; y < s.grid.size.y; ++y)
                for (int x = 0; x < s.grid.size.x; ++x) {
                    const glm::ivec3 to = place({x, y, z});
                    if (to.x >= 0 && to.x < s.grid.size.x)
                        different += as(points.texel({x, y, z})) == again.texel(to) ? 0 : 1;
                }
        return different;
    };
    const auto here = [](glm::ivec3 v) { return v; };
    const auto as_it_is = [](LitPoints::Texel t) { return t; };
    lights::Settings permuted = s;
    std::reverse(permuted.lights.begin(), permuted.lights.end());
    CHECK(same(permuted, here, as_it_is) == 0);
    // Negative sums are rounded down, so a mirrored one differs by a unit an addend, which resolving may round.
    const auto mirrored = changed(s, [](lights::Light& light) { light.position.x = -light.position.x; });
    const auto colours = [](LitPoints::Texel t) { return LitPoints::Texel{t[0], t[1], t[2], t[3], 0, 0, 0, 0}; };
    LitPoints mirror(mirrored);
    mirror.step();
    std::size_t different = 0;
    double furthest = 0.0;
    for (int x = 0; x < s.grid.size.x; ++x)
        for (int z = 0; z < s.grid.size.z; ++z) {
            const auto a = points.texel(glm::ivec3{x, 2, z}), b = mirror.texel(glm::ivec3{s.grid.size.x - 1 - x, 2, z});
            different += colours(a) == colours(b) ? 0 : 1;
            furthest = std::max(furthest, std::abs(double{a[4]} + double{b[4]}));
        }
    CHECK(different == 0);
    CHECK(furthest <= 48.0 * 0x1p-32 + 0x1p-24);
    const auto grid_aligned =
        changed(s, [](lights::Light& light) { light.position = glm::floor(light.position * 1024.0F) / 1024.0F; });
    LitPoints aligned(grid_aligned);
    aligned.step();
    LitPoints shifted(changed(grid_aligned, [](lights::Light& light) { light.position.x += 2.0F; }));
    shifted.step();
    different = 0;
    for (int x = 0; x + 2 < s.grid.size.x; ++x)
        for (int z = 0; z < s.grid.size.z; ++z)
            different += aligned.texel(glm::ivec3{x, 3, z}) == shifted.texel(glm::ivec3{x + 2, 3, z}) ? 0 : 1;
    CHECK(different == 0);
    LitPoints once(standing(48, lights::Accumulate::gather));
    once.step();
    LitPoints twice(
        changed(standing(48, lights::Accumulate::gather), [](lights::Light& light) { light.colour *= 2.0F; }));
    twice.step();
    different = 0;
    for (std::size_t i = 0; i < s.grid.count(); ++i)
        different += 2.0F * once.texel(i)[0] == twice.texel(i)[0] ? 0 : 1;
    CHECK(different == 0);
}

TEST_CASE("lights oracles: forward and deferred agree in every bit, on both sides") {
    using Values = std::vector<std::pair<const char*, std::function<void(lights::Switches&)>>>;
    const Values all{
        {"corrected", [](lights::Switches&) {}},
        {"tricubic", [](lights::Switches& on) { on.interpolation = lights::Interpolation::tricubic; }},
        {"texture units", [](lights::Switches& on) { on.interpolation = lights::Interpolation::trilinear_hw; }},
        {"directionality", [](lights::Switches& on) { on.shading = lights::Shading::directionality; }}};
    for (const auto& [name, change] : all) {
        INFO(name);
        std::vector<SystemState> made, drawn;
        for (const auto pipeline : {lights::Pipeline::forward, lights::Pipeline::deferred}) {
            lights::Settings s = room(16);
            change(s.switches);
            s.switches.pipeline = pipeline;
            s.switches.glow = lights::OffOn::off;
            const lights::HostPtr host = host_of(s);
            const System system = lights::system(host);
            ReferenceRun run(system, named_profile("strict"));
            run.step(0);
            made.push_back(run.state());
            if (!gl())
                continue;
            GlSystemSide side(gl(), system, lights::passes(host), "shaders/lights", s.arithmetic);
            SystemState state = system.start;
            run_gpu(system, side, 1, [&](std::size_t, int, const SystemState& now) {
                state = now;
                return true;
            });
            drawn.push_back(state);
        }
        for (const auto* two : {&made, &drawn})
            if (two->size() == 2) {
                CHECK(compare(std::as_const((*two)[0])[lights::lit_image], std::as_const((*two)[1])[lights::lit_image])
                          .agree());
                CHECK(compare(std::as_const((*two)[0])[lights::encoded_image],
                              std::as_const((*two)[1])[lights::encoded_image])
                          .agree());
            }
    }
}

TEST_CASE("lights oracles: the way to all items at once has the twin's bits") {
    const auto accumulate =
        GENERATE(lights::Accumulate::fixed64, lights::Accumulate::fixed32, lights::Accumulate::float_cas,
                 lights::Accumulate::gather, lights::Accumulate::blend, lights::Accumulate::blend_exact);
    const auto exact = GENERATE(ArithmeticSwitch::plain, ArithmeticSwitch::exact);
    lights::Settings s = standing(20, accumulate);
    s.arithmetic = exact;
    s.lights[3].position.y = NAN;
    s.switches.volume_format = GENERATE(lights::Format::rgba32f, lights::Format::rgba16f);
    const lights::HostPtr host = host_of(s);
    const System system = lights::system(host);
    const Profile profile = named_profile("llvmpipe");
    SystemState state = system.start;
    for (const auto& pass : system.passes) {
        if (pass->name().find("gbuffer") == 0)
            break;
        SystemState quick = state, slow = state;
        const SystemView before = std::as_const(state).view();
        const PassInput in{before, 0};
        run_pass(*pass, in, profile, quick[pass->resource()]);
        const WritableView after = slow[pass->resource()];
        pass->run(in, profile, 0, after.count(), after);
        INFO(pass->name());
        CHECK(compare(std::as_const(quick)[pass->resource()], std::as_const(slow)[pass->resource()]).agree());
        state.take(pass->resource(), quick);
    }
}

} // namespace lockstep::test::oracles_test
