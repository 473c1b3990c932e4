#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/shipped_shaders.hpp"

namespace lockstep::test::text_reference_test {

using Catch::Contains;

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

/// A folder with a shader of dust's update.
std::string update_in(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
    std::filesystem::create_directory(folder.path() / name);
    folder.write(name + "/update.comp", text);
    return (folder.path() / name).string();
}

Outcome check(const std::string& scene, const std::vector<std::string>& more) {
    return run_lockstep(joined({"check", "data/scenes/dust/" + scene, "--particles", "500", "--frames", "3",
                                "--no-render", "--gl", software_gl()},
                               more));
}

const std::string step = "m.next = add(m.current, mul(m.velocity, deltaTime));";

} // namespace

TEST_CASE("--reference: a plain shader takes the place of a twin, with the same bits and the same mistakes found") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string same = update_in(folder, "same", shipped_text("dust/update.comp"));
    const Outcome agrees = check("box.json", {"--reference", same});
    INFO(agrees.out << agrees.err);
    CHECK(agrees.status == 0);
    CHECK_THAT(agrees.out, Contains("verdict   AGREE") && Contains("reference of update: its text in " + same));
    const std::string wrong = update_in(
        folder, "wrong", replaced(shipped_text("dust/update.comp"), step, "m.next = add(m.current, m.velocity);"));
    const Outcome differs = check("box.json", {"--reference", same, "--shaders", wrong});
    CHECK(differs.status == 1);
    CHECK_THAT(differs.out, Contains("verdict   DIVERGENT") && Contains("--reference " + same));
    CHECK_THAT(differs.out, Contains("note      without a counterpart in the reference: update.comp:"));
    for (const std::string pass : {"update", "update_count"}) {
        const Outcome explained =
            run_lockstep({"explain", "data/scenes/dust/box.json", "--particles", "500", "--frame", "2", "--item", "0",
                          "--pass", pass, "--gl", software_gl(), "--reference", same, "--shaders", wrong});
        INFO(explained.out << explained.err);
        CHECK(explained.status == 0);
        CHECK((explained.out.find("DIVERGENT") != std::string::npos) == (pass == "update"));
    }
    // The other way round: the shipped shader is held against a wrong reference.
    CHECK(check("box.json", {"--reference", wrong}).status == 1);
    CHECK_THAT(check("box.json", {"--reference", wrong}).out, !Contains("the same that the GPU runs"));
}

TEST_CASE("--reference: a report says where the reference is what the GPU runs, and what the reference leaves unset") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string both = update_in(
        folder, "both", replaced(shipped_text("dust/update.comp"), step, "m.next = add(m.current, m.velocity);"));
    for (const Outcome& one :
         {check("box.json", {"--reference", both, "--shaders", both}),
          check("box.json", {"--reference", update_in(folder, "same", shipped_text("dust/update.comp"))})}) {
        INFO(one.out << one.err);
        CHECK_THAT(one.out,
                   Contains("the same that the GPU runs: this says what the driver does, not whether the shader "
                            "is right"));
    }
    const std::string unset =
        update_in(folder, "unset", replaced(shipped_text("dust/update.comp"), step, "vec3 far;\n    m.next = far;"));
    CHECK_THAT(check("box.json", {"--reference", unset}).out,
               Contains("note      in the reference: ") && Contains("variable far"));
}

TEST_CASE("--reference: what is no reference is one line") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string same = update_in(folder, "same", shipped_text("dust/update.comp"));
    CHECK_THAT(refusal(check("black_hole_gpu.json", {"--reference", same})),
               Contains(same) && Contains("populate.comp"));
    CHECK_THAT(refusal(check("box.json", {"--reference", (folder.path() / "none").string()})), Contains("none"));
    folder.write("same/draw.frag", shipped_text("dust/draw.frag"));
    CHECK_THAT(refusal(check("box.json", {"--reference", same, "--allow-unused"})), Contains("draw.frag"));
    const std::string other = update_in(folder, "other",
                                        replaced(shipped_text("dust/update.comp"), "void main() {",
                                                 "buffer More { float more[]; };\nvoid main() {\n    more[0] = 1.0;"));
    CHECK_THAT(refusal(check("box.json", {"--reference", other})),
               Contains("other/update.comp: nothing is given for storage block More"));
    folder.write("other/update.comp", replaced(shipped_text("dust/update.comp"), "uniform vec3 gravity;",
                                               "uniform ivec3 gravity;\n#define gravity vec3(gravity)"));
    CHECK_THAT(refusal(check("box.json", {"--reference", other})),
               Contains("other/update.comp: uniform gravity has 3 integers; 3 floats are given"));
    const std::string broken =
        update_in(folder, "broken", replaced(shipped_text("dust/update.comp"), step, "m.next = nothing;"));
    CHECK_THAT(refusal(check("box.json", {"--reference", broken})), Contains("update.comp:"));
    CHECK_THAT(refusal(run_lockstep({"check", "data/scenes/lattice.json", "--reference", same, "--gl", software_gl()})),
               Contains("--reference") && Contains("collision"));
    const std::string trace = (folder.path() / "run.h5").string();
    REQUIRE(run_lockstep({"record", "data/scenes/lattice.json", "--particles", "50", "--frames", "2", "--gl",
                          software_gl(), "-o", trace})
                .status == 0);
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"check"}, {"explain", "--frame", "1", "--particle", "1"}, {"debug"}})
        CHECK_THAT(refusal(run_lockstep(joined(verb, {"--trace", trace, "--reference", same}))),
                   Contains("the passes of system collision keep their twins"));
}

TEST_CASE("a shader without precise is legal where its own text leaves open what the twin gives, and only there") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string drag = "return add(v, mul(sub(a, drag), deltaTime));";
    const std::string free =
        update_in(folder, "free",
                  replaced(shipped_text("dust/update.comp"), drag, "return (v + a * deltaTime) - drag * deltaTime;"));
    for (const char* const scene : {"wind.json", "physics.json"}) {
        const Outcome legal = check(scene, {"--shaders", free});
        INFO(legal.out << legal.err);
        CHECK(legal.status == 0);
        CHECK_THAT(legal.out, Contains("verdict   LEGAL"));
    }
    const std::string slip = update_in(
        folder, "slip",
        replaced(shipped_text("dust/update.comp"), drag, "return (v + a * deltaTime) - drag * (deltaTime * 1.01);"));
    CHECK_THAT(check("physics.json", {"--shaders", slip}).out, Contains("verdict   DIVERGENT"));
    // What says `precise` has the bits that it asks for, and is held to them.
    const std::string precise =
        update_in(folder, "precise",
                  replaced(shipped_text("dust/update.comp"), drag,
                           "precise vec3 r = (v + a * deltaTime) - drag * deltaTime;\n    return r;"));
    CHECK_THAT(check("physics.json", {"--shaders", precise}).out, Contains("verdict   DIVERGENT"));
}

TEST_CASE("a shader without precise is legal in every output of its dispatch") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string shipped_sum = "return add(whole(high), mul(float(low >> 8), 1.0 / 16777216.0));";
    const auto resolved = [&](const std::string& by) {
        folder.write("light_volume_resolve.comp",
                     replaced(shipped_text("lights/light_volume_resolve.comp"), shipped_sum, by));
        return run_lockstep({"check", "data/scenes/lights/edge_of_world.json", "--frames", "1", "--no-render", "--set",
                             "accumulate=fixed64", "--shaders", folder.path().string(), "--gl", software_gl()});
    };
    const std::string regrouped =
        "return (float(low >> 8) / 16777216.0 + float(high & 4095)) + float(high >> 12) * 4096.0;";
    const Outcome legal = resolved(regrouped);
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL") && Contains("direction texture"));
    const Outcome slip = resolved(replaced(regrouped, "16777216.0", "16777217.5 * 1.001"));
    CHECK_THAT(slip.out, Contains("verdict   DIVERGENT") && Contains("without a counterpart in the reference"));
}

TEST_CASE("a green run says that a shader's text has a race") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string alone =
        replaced(shipped_text("lights/light_volume_resolve.comp"), "void main", "shared float kept;\nvoid main");
    folder.write("light_volume_resolve.comp", replaced(alone, "    imageStore(u_LightColorAfter",
                                                       "    kept = colour.x;\n    imageStore(u_LightColorAfter"));
    const Outcome races =
        run_lockstep({"check", "data/scenes/lights/edge_of_world.json", "--frames", "1", "--no-render", "--set",
                      "accumulate=fixed64", "--shaders", folder.path().string(), "--gl", software_gl()});
    INFO(races.out << races.err);
    CHECK(races.status == 0);
    CHECK_THAT(races.out, Contains("verdict   AGREE, but light_volume_resolve.comp:51 races with another invocation") &&
                              Contains("race on shared memory"));
}

TEST_CASE("an item that a shader without precise may come to write, and did not, is open") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string sum = "hashed(add(mul(s, rd1), mul(s, rd2)))"; // whether a grain comes out hangs on its last bit
    const auto sprayed = [&](const std::string& name, const std::string& by) {
        std::filesystem::create_directory(folder.path() / name);
        folder.write(name + "/random.glsl", replaced(shipped_text("dust/random.glsl"), sum, by));
        return run_lockstep({"check", "data/scenes/dust/catalogue/static_spray.json", "--preset", "corrected",
                             "--particles", "4000", "--frames", "4", "--no-render", "--shaders",
                             (folder.path() / name).string(), "--gl", software_gl()});
    };
    const Outcome legal = sprayed("free", "hashed(s * (rd1 + rd2))");
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL"));
    CHECK_THAT(sprayed("slip", "hashed(s * (rd1 + rp1))").out, Contains("verdict   DIVERGENT"));
}

TEST_CASE("collision: points in neighbouring texels that have the same half codes are none that is drawn twice") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    std::ifstream stream("tests/collision/right_shaders/factored_tick.vert");
    folder.write("collision_pass.vert", std::string{std::istreambuf_iterator<char>(stream), {}});
    folder.write("collision_pass.geom", "");
    folder.write("collision_pass.frag", "#version 330 core\nflat in vec3 out_Position;\nout vec4 o_Texel;\n"
                                        "void main() { o_Texel = vec4(out_Position, 1.0); }\n"); // the driver cuts
    const Outcome legal =
        run_lockstep({"check", "data/scenes/stress/wide_and_fast.json", "--frames", "9", "--no-render", "--set",
                      "cdt_format=rgba16f", "--shaders", folder.path().string(), "--gl", software_gl()});
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL"));
}

TEST_CASE("collision: floats without precise are legal in any order, unless they are held to what was measured") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const auto check = [&](const std::string& text, const std::vector<std::string>& more) {
        folder.write("collision_pass.vert", text);
        if (text.find("out_Position") != std::string::npos)
            folder.write("collision_pass.geom", ""); // it needs none
        else
            std::filesystem::remove(folder.path() / "collision_pass.geom");
        return run_lockstep(joined({"check", "data/scenes/lattice.json", "--particles", "500", "--frames", "4",
                                    "--no-render", "--shaders", folder.path().string(), "--gl", software_gl()},
                                   more));
    };
    std::ifstream stream("tests/collision/right_shaders/factored_tick.vert"); // v * (speed * tick)
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const Outcome legal = check(text, {});
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL") && Contains("note      collision_pass.vert:") &&
                              Contains("floats without `precise`, which GL may fuse or take in any order"));
    const Outcome held = check(text, {"--legal", "measured"});
    CHECK(held.status == 1);
    CHECK_THAT(held.out, Contains("verdict   DIVERGENT") && Contains("--legal measured"));
    CHECK(check(replaced(text, " * u_Tick", " * (1.001 * u_Tick)"), {}).status == 1);
    // What says `precise` has the order that it asks for.
    const Outcome precise = check(replaced(shipped_text("collision/collision_pass.vert"), "v_Speed = ls_length(temp);",
                                           "v_Speed = sqrt(temp.y * temp.y + (temp.z * temp.z + temp.x * temp.x));"),
                                  {});
    CHECK(precise.status == 1);
    CHECK_THAT(precise.out, Contains("verdict   DIVERGENT") && !Contains("floats without `precise`"));
}

TEST_CASE("a wrong shader stays DIVERGENT where its own text has more ways than are followed") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    folder.write("simulation.glsl", replaced(shipped_text("lifecycle/simulation.glsl"), "mul(m.acceleration, u_Tick)",
                                             "mul(mul(m.acceleration, 2.0), u_Tick)"));
    const Outcome outcome = run_lockstep({"check", "data/scenes/lifecycle/embers.json", "--frames", "2", "--no-render",
                                          "--shaders", folder.path().string(), "--gl", software_gl()});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("verdict   DIVERGENT"));
    CHECK_THAT(outcome.out, Contains("cause     ") && Contains("acceleration_doubled"));
}

TEST_CASE("a wrong shader's line that has no counterpart in the reference's text is in the report") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    struct Change {
        std::string what, by, line;
    };
    const Change changes[] = {
        {"mul(sub(a, drag), deltaTime)", "mul(add(a, drag), deltaTime)", "update.comp:20: return add("},
        {"a = add(a, gravity);", "a = sub(a, gravity);", "update.comp:39: a = sub(a, gravity);"},
        {"a = add(a, gravity);", "", "update.comp:39 of the reference: a = add(a, gravity);"},
        {"dust[i].position = m.next;", "dust[i].position = m.current;",
         "update.comp:50: dust[i].position = m.current;"},
        {"set_velocity(i, m.velocity);", "set_velocity(i, mul(m.velocity, 0.5));", "update.comp:49: set_velocity("}};
    for (const Change& one : changes) {
        const std::string wrong =
            update_in(folder, "wrong", replaced(shipped_text("dust/update.comp"), one.what, one.by));
        const Outcome outcome = check("physics.json", {"--shaders", wrong});
        INFO(outcome.out << outcome.err);
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.out, Contains("note      without a counterpart in the reference: " + one.line));
        std::filesystem::remove_all(wrong);
    }
}

TEST_CASE("a vertex stage that is captured is judged by its own text, and may be the reference") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const auto drawn = [&](const std::string& name, const std::string& place, const std::string& precise) {
        std::filesystem::create_directory(folder.path() / name);
        folder.write(name + "/draw.vert", R"(#version 430 core
in vec3 a_Position, a_Colour;
in int a_Alive;
uniform vec3 cameraRight, cameraUp, cameraBack;
uniform float scale;
uniform mat4 viewProjection;
)" + precise + R"(out vec4 out_Clip;
flat out vec3 out_Tint;
flat out int out_Drawn;
out vec2 out_TexelPlace;
void main() {
    ivec2 bits = (ivec2(gl_VertexID) >> ivec2(0, 1)) & 1;
    vec2 corner = vec2(bits) - 0.5;
    )" + precise + R"(vec3 world = cameraRight * corner.x + cameraUp * corner.y;
    world = )" + place + R"(;
    out_Clip = (viewProjection[0] * world.x + viewProjection[3]) +
               (viewProjection[1] * world.y + viewProjection[2] * world.z);
    gl_Position = out_Clip;
    out_Tint = a_Colour;
    out_TexelPlace = vec2(bits);
    out_Drawn = a_Alive;
}
)");
        return (folder.path() / name).string();
    };
    const auto checked = [&](const std::vector<std::string>& more) {
        return run_lockstep(
            joined({"check", "data/scenes/dust/obb.json", "--particles", "500", "--frames", "3", "--gl", software_gl()},
                   more));
    };
    const std::string own = drawn("own", "a_Position + world * scale", "");
    const Outcome legal = checked({"--shaders", own});
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("drawn     LEGAL") || Contains("drawn     AGREE"));
    const std::string wrong = drawn("wrong", "a_Position + world * (scale * 1.01)", "");
    const Outcome divergent = checked({"--shaders", wrong});
    CHECK(divergent.status == 1);
    CHECK_THAT(divergent.out, Contains("DIVERGENT in what the last frame draws") && Contains("draw.vert:15: world ="));
    const Outcome of_itself = checked({"--reference", wrong, "--shaders", wrong});
    INFO(of_itself.out << of_itself.err);
    CHECK(of_itself.status == 0);
    CHECK_THAT(of_itself.out, Contains("reference of draw: its text in " + wrong));
    CHECK(checked({"--reference", wrong}).status == 1);
    CHECK(
        checked({"--reference", own, "--shaders", drawn("precise", "a_Position + world * scale", "precise ")}).status ==
        0);
}

} // namespace lockstep::test::text_reference_test
