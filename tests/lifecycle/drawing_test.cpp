#include "crosscheck/lifecycle/picture.hpp"
#include "reference/model/lifecycle/drawing.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/shaders_with.hpp"

namespace lockstep::test::drawing_test {

namespace lifecycle = lockstep::lifecycle;
namespace counter = lifecycle::counter;

namespace {

/// Sprites and a ribbon, some of them dead in the last frame.
lifecycle::Settings both() {
    lifecycle::Settings s;
    s.camera.eye = {0.0F, 1.0F, 6.0F};
    s.switches.time_code = lifecycle::TimeCode::half_seconds;
    lifecycle::Emitter& sprites = s.emitters.front();
    sprites.capacity = 300;
    sprites.rate = 900.0;
    sprites.lifetime = {0.1F, 0.3F};
    sprites.direction_jitter = 0.5F;
    sprites.size = {0.2F, 0.05F};
    sprites.color = {glm::vec4(1.0F, 0.7F, 0.2F, 1.0F), glm::vec4(0.4F, 0.0F, 0.3F, 0.0F)};
    lifecycle::Emitter ribbon = sprites;
    ribbon.capacity = 40;
    ribbon.rate = 120.0;
    ribbon.path = {{0, {-1, 0, 0}}, {20, {1, 1, 0}}};
    ribbon.draw = lifecycle::Emitter::Draw::ribbon;
    s.emitters.push_back(ribbon);
    return s;
}

/// After 20 frames, of the reference alone.
SystemState state_of(const lifecycle::HostPtr& host) {
    const System system = lifecycle::system(host);
    ReferenceRun run = reference_of(system);
    for (int frame = 0; frame < 20; ++frame)
        run.step(frame);
    return run.state();
}

} // namespace

TEST_CASE("drawing: the corners of sprites and segments agree with their twin, from every layout") {
    if (!gl())
        return skip(gl().missing());
    lifecycle::Settings s = both();
    const int layout = GENERATE(0, 1, 3, 5, 6);
    s.switches.layout = static_cast<lifecycle::Layout>(layout);
    s.arithmetic = layout % 2 == 0 ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    const lifecycle::HostPtr host = host_of(s);
    const SystemPicture picture = lifecycle::picture(host, state_of(host), 19);
    GlSystemSide side(gl(), picture.system, picture.passes, "shaders/lifecycle", s.arithmetic);
    CheckOptions options;
    options.frames = 1;
    const CheckReport report = check(picture.system, side, options);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
}

TEST_CASE(
    "drawing: a driver that multiplies by a constant's reciprocal is legal where its row says so, and not where the "
    "row says that it divides") {
    if (!gl())
        return skip(gl().missing());
    const lifecycle::HostPtr host = host_of(both());
    const SystemPicture picture = lifecycle::picture(host, state_of(host), 19);
    const auto check_with = [&](const std::string& reciprocal, std::vector<std::string> not_followed) {
        const TemporaryFolder shaders;
        copy_replacing("shaders/lifecycle", shaders, "packing.glsl", ", 255.0)", " * " + reciprocal + ", 1.0)");
        OtherDriver side(picture.system, picture.passes, shaders.path(),
                         [&](Profile& profile) { profile.not_followed = not_followed; });
        CheckOptions options;
        options.frames = 1;
        return check(picture.system, side, options);
    };
    const std::string row = "a/c, c constant, precise";
    const CheckReport open = check_with("(1.0 / 255.0)", {row});
    INFO(report_text(open, {}));
    CHECK(open.verdict == Verdict::legal);
    CHECK(check_with("(1.0 / 255.0)", {}).verdict == Verdict::divergent);
    CHECK(check_with("(1.0 / 255.0)", {"compute: a/c, c constant"}).verdict == Verdict::divergent);
    CHECK(check_with("(1.0 / 256.0)", {row}).verdict == Verdict::divergent);
}

TEST_CASE("drawing: what is drawn are the living, and with expired=hidden none that has no time left") {
    lifecycle::Settings s = both();
    struct Counts {
        std::size_t alive = 0, dead = 0, drawn = 0;
    };
    const auto counts = [&](lifecycle::Expired expired) {
        s.switches.expired = expired;
        const lifecycle::HostPtr host = host_of(s);
        const SystemState state = state_of(host);
        const SystemPicture picture = lifecycle::picture(host, state, 19);
        ReferenceRun run = reference_of(picture.system);
        run.step(0);
        Counts of{.alive = state.view().word({lifecycle::counter_buffer, counter::alive}, 0)};
        for (std::size_t i = 0; i < of.alive; ++i)
            of.dead += (state.view().word(field_named(state.schema(), "lifetimes"), i) & 0x8000U) != 0 ? 1 : 0;
        for (std::size_t corner = 0; corner < 4 * s.emitters[0].capacity; corner += 4)
            of.drawn += run.state().view().word({lifecycle::corner_buffer, 2}, corner);
        return of;
    };
    const Counts all = counts(lifecycle::Expired::drawn), living = counts(lifecycle::Expired::hidden);
    CHECK(all.drawn == all.alive);
    CHECK(living.drawn == living.alive - living.dead);
    CHECK(living.dead > 0);
}

TEST_CASE("drawing: both sides' pictures are the same but for a few steps") {
    if (!gl())
        return skip(gl().missing());
    const lifecycle::Settings s = both();
    const lifecycle::HostPtr host = host_of(s);
    const SystemPicture picture = lifecycle::picture(host, state_of(host), 19);
    ReferenceRun run = reference_of(picture.system);
    run.step(0);
    const ColorImage reference = picture.image(run.state().view());
    GlSystemSide side(gl(), picture.system, picture.passes, "shaders/lifecycle", s.arithmetic);
    side.upload(picture.system.start.view());
    const ColorImage gpu = side.picture(0, 0, picture.how);
    std::size_t lit = 0, off = 0;
    for (std::size_t p = 0; p < gpu.texels.size(); ++p) {
        lit += gpu.texels[p].r > picture.how.background.r + 20 ? 1 : 0;
        off += std::abs(int{gpu.texels[p].r} - int{reference.texels[p].r}) > 12 ? 1 : 0;
    }
    CHECK(lit > 2000);
    CHECK(off < lit / 50);
}

} // namespace lockstep::test::drawing_test
