#include "crosscheck/collision/report/pixel_text.hpp"

#include <catch2/catch.hpp>

namespace lockstep::test::pixel_text_test {
namespace {

using Catch::Contains;

/// Camera at z = 3 looking down -z, 64 pixels square; half a particle's side is 5 pixels at z = 0.
struct Drawn {
    FrameParams params;
    Particles particles;
    Mesh obstacles;
    ColorImage gpu;
    KnownOperations known;

    explicit Drawn(const std::vector<glm::vec3>& positions, Mesh mesh = {}) : obstacles(std::move(mesh)) {
        params.render_width = params.render_height = 64;
        params.render_view = view_matrix(Camera{});
        params.render_projection = projection_matrix(Camera{}, 1.0F);
        params.constants.billboard_radius = 5.0F / pixels_a_unit();
        particles.resize(positions.size());
        particles.position = positions;
        gpu = render_pass(particles, obstacles, params, Profile{});
    }
    [[nodiscard]] float pixels_a_unit() const { return params.render_projection[0][0] * 32.0F / 3.0F; }

    [[nodiscard]] PixelTable table(int x, int y) const {
        const RenderInputs inputs{particles, obstacles, params};
        return pixel_table(inputs, Profile{}, known, gpu.index(x, y), gpu.at(x, y),
                           judge_render(inputs, Profile{}, known, gpu));
    }
    [[nodiscard]] std::string at(int x, int y, NumberFormat format = NumberFormat::decimal) const {
        return pixel_text(table(x, y), format);
    }
};

const Mesh screen{{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {0, 1, 2}};

} // namespace

TEST_CASE("pixel text: an agreeing pixel names who is seen, its square and what lies behind") {
    const std::string text = Drawn({{0, 0, 0}, {0, 0, -1}}).at(33, 32);
    CHECK_THAT(text, Catch::StartsWith("pixel (33, 32) in frame 0: every bit agrees\n") &&
                         Contains("\n    particle 0 ") && Contains(", seen\n      its square: window (32, 32), half") &&
                         Contains("\n    particle 1 ") && Contains(", hidden by particle 0\n") && !Contains("cause") &&
                         !Contains("may be seen"));
    CHECK_THAT(Drawn({{0, 0, 0}}).at(33, 32, NumberFormat::hexadecimal), Contains("window (0x1p+5, 0x1p+5)"));
}

TEST_CASE("pixel text: of an empty pixel it says what is beside it") {
    CHECK_THAT(Drawn({{0, 0, 0}}).at(42, 31), Contains("reference  #") && Contains(", the background\n") &&
                                                  Contains("\n  beside it: particle 0 (5.51 pixels from its rim)\n"));
    CHECK_THAT(Drawn({}).at(3, 4), Contains("\n  no other particle is drawn into the frame\n"));
    CHECK_THAT(Drawn({{0, 0, 9}}).at(3, 4), Contains("\n  no other particle is drawn into the frame\n"));
}

TEST_CASE("pixel text: behind an obstacle a particle is hidden, and one that the GPU shows there is named") {
    Drawn drawn({{0, 0, 0}}, screen);
    CHECK_THAT(drawn.at(32, 32), Contains("hidden by triangle 0 of the obstacles"));
    drawn.gpu = mistaken_render_pass({drawn.particles, drawn.obstacles, drawn.params}, Profile{},
                                     RenderMistake::depth_not_tested);
    CHECK_THAT(drawn.at(32, 32), Contains(": divergent\n") &&
                                     Contains(", as of particle 0, which triangle 0 of the obstacles hides\n") &&
                                     Contains("\ncause     depth_not_tested: ") && Contains(", as the GPU does\n"));
}

TEST_CASE("pixel text: a colour of nothing that is drawn there is told channel by channel") {
    Drawn drawn({{0, 0, 0}});
    Rgba8& pixel = drawn.gpu.at(32, 32);
    pixel.g = static_cast<std::uint8_t>(pixel.g - 9);
    pixel.a = 7;
    CHECK_THAT(drawn.at(32, 32),
               Contains(" alpha 7, of nothing that is drawn there; nearest particle 0, but for green") &&
                   Contains("; alpha 7, legal 255\n") && Contains("frame     1 of its pixels are divergent\n") &&
                   Contains("cause     no named mistake explains the whole frame\n"));
    CHECK_THAT(drawn.at(33, 32), Contains(": every bit agrees\n") && Contains("frame     1 of its pixels"));
}

TEST_CASE("pixel text: a side through the pixel's centre is a tie with its margin, the other way") {
    Drawn drawn({});
    const float unit = 1.0F / drawn.pixels_a_unit();
    drawn.obstacles = {{{0.5F * unit, -0.5F, 0}, {0.5F * unit, 0.5F, 0}, {0.5F, 0, 0}}, {0, 1, 2}};
    drawn.gpu = render_pass({}, drawn.obstacles, drawn.params, Profile{});
    const PixelTable table = drawn.table(32, 32);
    REQUIRE(table.drawn.size() == 2);
    for (const DrawnHere& here : table.drawn) {
        drawn.gpu.at(32, 32) = here.fragment.candidate.low;
        const bool same = here.fragment.candidate.owner == table.owner;
        CHECK_THAT(drawn.at(32, 32), Contains("drawn here or not: its side or rim is ") &&
                                         Contains(same ? ": every bit agrees\n"
                                                       : ": tie: a side or rim of triangle 0 of the obstacles "));
    }
}

TEST_CASE("pixel text: of two spheres at one depth the other is a tie, and at a rim what GL leaves open is undefined") {
    Drawn drawn({{0, 0, 0}, {0, 0, 0}});
    drawn.particles.speed = {0.0F, 2.0F};
    drawn.gpu = render_pass(drawn.particles, {}, drawn.params, Profile{});
    const PixelTable table = drawn.table(32, 32);
    for (const DrawnHere& here : table.drawn)
        if (here.fragment.candidate.owner == PixelOwner{PixelOwner::Kind::particle, 1})
            drawn.gpu.at(32, 32) = here.fragment.candidate.low;
    CHECK_THAT(drawn.at(32, 32), Contains(": tie: of depths that rounding may swap\n") &&
                                     Contains("as of particle 1\n") && Contains(", may be seen\n") &&
                                     Contains(", seen\n"));

    const float half = 0.5F / drawn.pixels_a_unit();
    Drawn rim({{half, half, 0}});
    rim.gpu.at(37, 32) = rim.table(37, 32).drawn.front().fragment.candidate.low;
    CHECK_THAT(rim.at(37, 32), Contains(": undefined: particle 0 rests on what GL leaves open\n") &&
                                   Contains(", may be seen, on what GL leaves open\n"));
}

TEST_CASE("pixel text: arithmetic=exact leaves one that is seen, and tells who else covers the pixel") {
    Drawn drawn({{0, 0, 0}, {0, 0, -1}});
    drawn.params.switches.arithmetic = ArithmeticSwitch::exact;
    drawn.gpu = render_pass(drawn.particles, drawn.obstacles, drawn.params, Profile{});
    CHECK_THAT(drawn.at(32, 32),
               Contains("particle 0 ") && Contains("particle 1 (inside its rim)") && !Contains("depth"));
}

} // namespace lockstep::test::pixel_text_test
