#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::capsule_test {

using Catch::Contains;
using test::refusal;
using test::run_lockstep;

namespace {

struct Setting {
    test::TemporaryFolder folder;
    test::TemporaryFolder shaders;
    std::string scene = folder.write("scene.json", test::small_scene).string();
    std::string trace = (folder.path() / "run.h5").string();
    std::string file = (folder.path() / "capsule.json").string();

    [[nodiscard]] std::vector<std::string> live(const char* verb) const {
        return test::joined({verb, scene, "--gl", test::software_gl()}, test::shader_options(shaders));
    }
    [[nodiscard]] test::Outcome cut(std::vector<std::string> from, const std::string& frame,
                                    const std::string& particle) const {
        std::vector<std::string> arguments{"capsule", "cut", "--frame", frame, "--particle", particle, "-o", file};
        arguments.insert(arguments.end(), from.begin(), from.end());
        return run_lockstep(arguments);
    }
    [[nodiscard]] test::Outcome cut_live(const std::string& frame, const std::string& particle) const {
        return cut(test::joined({scene, "--gl", test::software_gl()}, test::shader_options(shaders)), frame, particle);
    }
    [[nodiscard]] test::Outcome show() const { return run_lockstep({"capsule", "show", file}); }
};

/// From the line that names the particle's verdict on.
std::string verdict_of(const std::string& text) {
    const std::size_t place = text.find(": ", text.find("\nparticle "));
    REQUIRE(place != std::string::npos);
    return text.substr(place);
}

/// The first divergent particle's number, of a report.
std::string first_particle(const std::string& report) {
    const std::size_t place = report.find("--particle ");
    REQUIRE(place != std::string::npos);
    const std::size_t number = place + std::string("--particle ").size();
    return report.substr(number, report.find_first_not_of("0123456789", number) - number);
}

} // namespace

TEST_CASE("capsule: cut out of a live run, it tells what explain tells, without GL") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const char* particle : {"0", "17", "123"}) {
        REQUIRE(setting.cut_live("4", particle).status == 0);
        const test::Outcome shown = setting.show();
        CHECK(shown.status == 0);
        CHECK(shown.err.empty());
        const test::Outcome explained = run_lockstep(
            {"explain", setting.scene, "--gl", test::software_gl(), "--frame", "4", "--particle", particle});
        CHECK(verdict_of(shown.out) == verdict_of(explained.out));
        CHECK_THAT(shown.out, Contains("every bit agrees") && Contains("texture coordinate.x"));
    }
}

TEST_CASE("capsule: of a planted bug it names the wrong operation anywhere, from a live run and from a trace") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                "v_Speed = product(a_Speed, 0.5);");
    const test::Outcome checked = run_lockstep(
        {"check", setting.scene, "--gl", test::software_gl(), "--shaders", setting.shaders.path(), "--frames", "4"});
    REQUIRE(checked.status == 1);
    const std::string particle = first_particle(checked.out);
    const std::string frame = checked.out.substr(checked.out.find("--frame ") + 8, 1);

    const test::Outcome cut = setting.cut_live(frame, particle);
    CHECK(cut.status == 0);
    CHECK(cut.out ==
          "written   " + setting.file + "\nholds     particle " + particle + " of frame " + frame + ": divergent\n");
    const test::Outcome live = setting.show();
    CHECK(live.status == 1);
    CHECK_THAT(live.out, Contains("first     speed: ") && Contains(": divergent\n") && Contains("DIVERGENT"));

    REQUIRE(run_lockstep({"record", setting.scene, "--gl", test::software_gl(), "--shaders", setting.shaders.path(),
                          "--cdt", "--frames", "4", "-o", setting.trace})
                .status == 0);
    CHECK(setting.cut({"--trace", setting.trace}, frame, particle).status == 0);
    const test::Outcome recorded = setting.show();
    CHECK(recorded.status == 1);
    CHECK_THAT(recorded.out, Contains("GL        recorded: llvmpipe") && Contains("note    the vertex stage"));
    const std::string of_live = verdict_of(live.out), of_recorded = verdict_of(recorded.out);
    CHECK(of_live.substr(0, of_live.find("first ")) == of_recorded.substr(0, of_recorded.find("first ")));

    // Without the CDT too, as long as the reference draws what the GPU drew.
    REQUIRE(run_lockstep({"record", setting.scene, "--gl", test::software_gl(), "--shaders", setting.shaders.path(),
                          "--frames", "4", "-o", setting.trace})
                .status == 0);
    CHECK(setting.cut({"--trace", setting.trace}, frame, particle).status == 0);
    CHECK(verdict_of(setting.show().out) == of_recorded);
}

TEST_CASE("capsule: at most 100 kB, in every preset, format and at a wide radius") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--preset", "paper"},
                                               {"--preset", "exact"},
                                               {"--set", "cdt_format=rgba8"},
                                               {"--set", "cdt_format=rgba16f", "--set", "texel_collide_range=8"}}) {
        std::vector<std::string> from{setting.scene, "--gl", test::software_gl()};
        from.insert(from.end(), options.begin(), options.end());
        CHECK(setting.cut(from, "7", "42").status == 0);
        CHECK(std::filesystem::file_size(setting.file) <= 100'000);
        CHECK(setting.show().status == 0);
    }
}

TEST_CASE("capsule: a step of the octree, and one with remedies, says what the run's says") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const char* search : {"search=octree", "cdt_layers=2", "cdt_cameras=2"})
        for (const char* particle : {"3", "42", "117"}) {
            INFO(search << " " << particle);
            const std::vector<std::string> from{setting.scene, "--gl", test::software_gl(), "--set", search};
            REQUIRE(setting.cut(from, "3", particle).status == 0);
            const test::Outcome shown = setting.show();
            CHECK(shown.status == 0);
            CHECK_THAT(shown.out, Contains("particle " + std::string(particle) + " in frame 3: every bit agrees"));
        }
}

TEST_CASE("capsule: what cannot be cut or read is refused in a line, and no file is left") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK_THAT(refusal(setting.cut_live("3", "300")), Contains("300"));
    CHECK_THAT(refusal(setting.cut({setting.scene, "--pixel", "1,1"}, "3", "3")),
               Contains("needs --particle I or --pixel X,Y"));
    CHECK_THAT(refusal(setting.cut({}, "3", "3")), Contains("a scene or --trace FILE is needed"));
    CHECK_THAT(refusal(setting.show()), Contains("capsule.json: cannot be read"));
    CHECK_THAT(refusal(run_lockstep({"capsule", "show", setting.scene})),
               Contains("scene.json: /: no capsule: the key \"lockstep_capsule\" is missing"));
    CHECK(test::names_in(setting.folder.path()) == std::vector<std::string>{"scene.json"});
}

TEST_CASE("capsule: a pixel of the rendered frame says without GL what explain says, right or divergent") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    std::string large = test::small_scene;
    large.replace(large.find("\"collision_range\""), 0, "\"billboard_radius\": 0.06, ");
    setting.folder.write("scene.json", large);
    const auto cut = [&](const std::string& pixel, int status) {
        std::vector<std::string> place{"--frame", "3", "--pixel", pixel};
        CHECK(run_lockstep(test::joined(test::joined({"capsule", "cut", setting.scene, "--gl", test::software_gl(),
                                                      "-o", setting.file},
                                                     test::shader_options(setting.shaders)),
                                        place))
                  .status == 0);
        CHECK(std::filesystem::file_size(setting.file) <= 100'000);
        const test::Outcome shown = setting.show();
        CHECK(shown.status == status);
        CHECK(shown.err.empty());
        const std::string explained = run_lockstep(test::joined(setting.live("explain"), place)).out;
        const std::size_t begins = explained.find("\npixel ("), ends = explained.find("source    ");
        CHECK(shown.out.substr(shown.out.find("\npixel (")) == explained.substr(begins, ends - begins));
        return shown.out;
    };
    CHECK_THAT(cut("20,15", 0), Contains("every bit agrees") && Contains("hidden by "));
    CHECK_THAT(cut("0,0", 0), Contains("beside it: "));
    test::plant(setting.shaders, "render_pass.geom", "EmitVertex();", "");
    CHECK_THAT(cut("20,15", 1), Contains(": divergent\n") && Contains("cause     sprites_not_drawn"));

    std::ifstream stream(setting.file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto damaged = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        REQUIRE(changed.find(from) != std::string::npos);
        setting.folder.write("capsule.json", changed.replace(changed.find(from), from.size(), to));
        return refusal(setting.show());
    };
    CHECK_THAT(damaged("\"pixel\":[20,15]", "\"pixel\":[40,15]"), Contains("/pixel/0: 40 is not"));
    CHECK_THAT(damaged("\"sprites_not_drawn\"", "\"sprites_not_drawm\""), Contains("/causes/0: "));
    CHECK_THAT(damaged("\"gpu\":[", "\"gpu\":[7,"), Contains("/gpu: not [red, green, blue, alpha]"));
}

} // namespace lockstep::test::capsule_test
