#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "crosscheck/dust/picture.hpp"
#include "crosscheck/dust/scene.hpp"
#include "tests/dust/one_grain.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::drawing_test {

namespace dust = lockstep::dust;

namespace {

constexpr FieldId clip{dust::corner_buffer, 0}, tint{dust::corner_buffer, 1}, drawn{dust::corner_buffer, 2},
    texel_place{dust::corner_buffer, 3};

/// A camera on the z axis that sees 90 degrees: w is the way to it, x and y are as many world units.
dust::Settings before_camera() {
    dust::Settings s;
    s.count = 1;
    s.scale = 2.0F;
    s.camera = {
        .eye = {0.0F, 0.0F, 10.0F}, .target = glm::vec3(0.0F), .fov_y = 90.0F, .near_plane = 1.0F, .far_plane = 100.0F};
    return s;
}

SystemState one_grain(glm::vec3 position, int alive = 1) {
    SystemState state(dust::schema(), {{1}, {1}});
    state.set(dust::field::position, 0, position);
    state.set(dust::field::colour, 0, glm::vec3(0.25F, 0.5F, 0.75F));
    state.set(dust::field::alive, 0, static_cast<std::int32_t>(alive));
    return state;
}

SystemState corners_of(const SystemPicture& picture) {
    ReferenceRun run(picture.system, named_profile("strict"));
    run.step(0);
    return run.state();
}

/// A state in which grains are everywhere, some of them dead.
SystemState after_frames(const dust::HostPtr& host, int frames) {
    const System system = dust::system(host);
    ReferenceRun run(system, named_profile("strict"));
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return run.state();
}

CheckReport check_drawn(const dust::HostPtr& host, const SystemState& state, int frame,
                        const std::string& shaders = "shaders/dust") {
    const SystemPicture picture = dust::picture(host, state, frame);
    GlSystemSide side(gl(), picture.system, picture.passes, shaders, host->settings().arithmetic);
    CheckOptions options;
    options.frames = 1;
    return check(picture.system, side, options);
}

dust::HostPtr kernels(const std::string& preset, dust::Mesh mesh = dust::Mesh::quad) {
    dust::Settings s = dust::load_scene("data/scenes/dust/vacuum_and_back.json", {.particles = 700, .preset = preset});
    s.switches.mesh = mesh;
    return host_of(s);
}

} // namespace

TEST_CASE("dust drawing by hand: a quad faces the camera, its corners in clip space") {
    const dust::HostPtr host = host_of(before_camera());
    const SystemState state = corners_of(dust::picture(host, one_grain({3.0F, -2.0F, 2.0F}, 0), 0));
    const SystemView view = state.view();
    const float aspect = 960.0F / 540.0F;
    const glm::vec2 places[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec4 at = view.vec4(clip, i);
        CHECK(std::abs(at.x - (3.0F + 2.0F * places[i].x - 1.0F) / aspect) < 1e-5F);
        CHECK(std::abs(at.y - (-2.0F + 2.0F * places[i].y - 1.0F)) < 1e-5F);
        CHECK(std::abs(at.w - 8.0F) < 1e-5F);
        CHECK(view.vec3(tint, i) == glm::vec3(0.25F, 0.5F, 0.75F));
        CHECK(view.integer(drawn, i) == 0);
        CHECK(view.vec2(texel_place, i) == places[i]);
    }
}

TEST_CASE("dust drawing: the vertex stage agrees, for quads and cubes, living and dead") {
    if (!gl())
        return;
    for (const char* preset : {"corrected", "exact"})
        for (const dust::Mesh mesh : {dust::Mesh::quad, dust::Mesh::cube}) {
            const dust::HostPtr host = kernels(preset, mesh);
            const CheckReport report = check_drawn(host, after_frames(host, 20), 19);
            INFO(preset << " " << static_cast<int>(mesh));
            CHECK(report.verdict == (std::string(preset) == "exact" ? Verdict::agree : report.verdict));
            CHECK(passes(report));
            CHECK(report.untried.empty());
        }
}

TEST_CASE("dust drawing: mistakes of the vertex stage are found, and named") {
    if (!gl())
        return;
    struct Mutant {
        std::string text, replacement, cause;
    };
    const std::vector<Mutant> mutants{
        {"ls_multiply(cameraRight[axis], x)", "ls_multiply(cameraUp[axis], x)", "up_twice"},
        {"ls_multiply(cameraUp[axis], y)", "ls_multiply(cameraRight[axis], y)", "right_twice"},
        {"ls_multiply(cameraUp[axis], y)", "ls_multiply(cameraUp[axis], x)", "x_for_both"},
        {"ls_multiply(cameraRight[axis], x)", "ls_multiply(cameraRight[axis], y)", "y_for_both"},
        {"ls_multiply(cameraRight[axis], x), ls_multiply(cameraUp[axis], y)",
         "ls_multiply(cameraUp[axis], x), ls_multiply(cameraRight[axis], y)", "axes_swapped"},
        {"ls_multiply(cameraRight[axis], x)", "ls_multiply(cameraRight[axis], -x)", "right_reversed"},
        {"ls_multiply(cameraUp[axis], y)", "ls_multiply(-cameraUp[axis], y)", "up_reversed"},
        {"ls_multiply(turned[axis], scale)", "turned[axis]", "scale_missing"},
        {"ls_multiply(turned[axis], scale)", "ls_multiply(turned[axis], scale * 2.0)", "grains_twice_as_large"},
        {"ls_multiply(turned[axis], scale)", "ls_multiply(turned[axis], scale * 0.5)", "grains_half_as_large"},
        {"ls_add(ls_multiply(turned[axis], scale), ls_flush(a_Position[axis]))",
         "(turned[axis] + a_Position[axis]) * scale", "place_scaled"},
        {"ls_flush(a_Position[axis])", "0.0", "place_missing"},
        {"ls_flush(a_Position[axis])", "-a_Position[axis]", "place_subtracted"},
        {"ls_transform(viewProjection, world)", "ls_transform(transpose(viewProjection), world)", "matrix_transposed"},
        {"ls_transform(viewProjection, world);", "ls_transform(viewProjection, world); out_Clip /= out_Clip.w;",
         "divided_by_w"},
        {"(gl_VertexID & 2)", "(gl_VertexID & 1)", ""},
        {"(gl_VertexID & 1) == 0 ? -0.5 : 0.5;\n    float y = (gl_VertexID & 2)",
         "(gl_VertexID & 2) == 0 ? -0.5 : 0.5;\n    float y = (gl_VertexID & 1)", "corners_swapped"},
        {"? -0.5 : 0.5;\n    float y", "? 0.5 : -0.5;\n    float y", "mirrored"},
        {"(gl_VertexID & 2) == 0 ? -0.5 : 0.5", "(gl_VertexID & 2) == 0 ? 0.5 : -0.5", "upside_down"},
        {"out_Drawn = a_Alive", "out_Drawn = 1", "dead_drawn"},
        {"out_Drawn = a_Alive", "out_Drawn = 1 - a_Alive", "dead_alone_drawn"},
        {"out_Drawn = a_Alive", "out_Drawn = 0", "nothing_drawn"},
        {"ls_flush3(a_Colour)", "ls_flush3(a_Colour.bgr)", "red_is_blue"},
        {"ls_flush3(a_Colour)", "ls_flush3(a_Position)", ""},
        {"vec2(x + 0.5, y + 0.5)", "vec2(y + 0.5, x + 0.5)", "texture_swapped"},
        {"vec2(x + 0.5, y + 0.5)", "vec2(0.5 - x, y + 0.5)", "texture_mirrored"},
        {"vec2(x + 0.5, y + 0.5)", "vec2(x + 0.5, 0.5 - y)", "texture_upside_down"},
        {"vec2(x + 0.5, y + 0.5)", "vec2(x, y)", "texture_not_moved"},
        {"    for (int axis = 0; axis < 3; ++axis) {\n        turned[axis] =",
         "    mat3 axes = mat3(cameraRight, cameraUp, cameraBack);\n"
         "    for (int axis = 0; axis < 3; ++axis) {\n        turned[axis] = dot(vec3(x, y, z), axes[axis]) + 0.0 *",
         "turned_back"},
        {"turned[axis] = ls_add", "turned[axis] = vec3(x, y, z)[axis] + 0.0 * ls_add", "not_turned"}};
    const dust::HostPtr host = kernels("exact");
    SystemState state = after_frames(host, 20);
    for (std::size_t i = 0; i < host->settings().count; i += 5)
        state.set(dust::field::alive, i, std::int32_t{0});
    for (std::size_t i = 0; i < host->settings().count; ++i)
        state.set(dust::field::colour, i, glm::vec3(0.25F, 0.5F, 0.75F));
    for (const Mutant& mutant : mutants) {
        INFO(mutant.text << " -> " << mutant.replacement);
        std::ostringstream read;
        read << std::ifstream("shaders/dust/draw.vert").rdbuf();
        std::string text = read.str();
        const std::size_t at = text.find(mutant.text);
        REQUIRE(at != std::string::npos);
        text.replace(at, mutant.text.size(), mutant.replacement);
        const TemporaryFolder folder;
        std::ofstream(folder.path() / "draw.vert") << text;
        const CheckReport report = check_drawn(host, state, 19, folder.path().string());
        CHECK(report.verdict == Verdict::divergent);
        const auto& best = report.verdicts->causes[dust::corner_buffer].best;
        const std::string found = best.empty() ? "none" : best.front().name();
        UNSCOPED_INFO("found " << found);
        CHECK((mutant.cause.empty() || found == mutant.cause));
    }
}

TEST_CASE("dust drawing: a picture of both sides shows the living alone, blended in their order") {
    dust::Settings s = before_camera();
    for (const int alive : {0, 1}) {
        const dust::HostPtr host = host_of(s);
        const SystemPicture picture = dust::picture(host, one_grain(glm::vec3(0.0F), alive), 0);
        std::vector<ColorImage> images{picture.image(corners_of(picture).view())};
        if (gl()) {
            GlSystemSide side(gl(), picture.system, picture.passes, "shaders/dust");
            side.upload(picture.system.start.view());
            images.push_back(side.picture(0, 0, picture.how));
        }
        for (const ColorImage& image : images) {
            const Rgba8 middle = image.at(480, 270), corner = image.at(5, 5);
            CHECK(corner == picture.how.background);
            CHECK((middle == picture.how.background) == (alive == 0));
            if (alive == 1) { // its alpha is 1 in the middle
                CHECK(std::abs(middle.r - 64) <= 1);
                CHECK(std::abs(middle.b - 191) <= 1);
            }
        }
    }
}

TEST_CASE("dust drawing: with draw_bounds=box a camera that sees dust outside the box sees none") {
    dust::Settings s = before_camera();
    s.spawn = {{-5.0F, 0.0F, -5.0F}, {5.0F, 5.0F, 5.0F}};
    s.camera.eye = {40.0F, 0.0F, 10.0F};
    s.camera.target = {40.0F, 0.0F, 0.0F};
    for (const bool box : {true, false}) {
        s.switches.draw_bounds = box ? dust::DrawBounds::box : dust::DrawBounds::off;
        CHECK(dust::picture(host_of(s), one_grain({40.0F, 0.0F, 0.0F}), 0).how.indices.empty() == box);
    }
    s.camera = before_camera().camera; // and one that sees the box
    s.switches.draw_bounds = dust::DrawBounds::box;
    CHECK_FALSE(dust::picture(host_of(s), one_grain({40.0F, 0.0F, 0.0F}), 0).how.indices.empty());
}

} // namespace lockstep::test::drawing_test
