#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lockstep/catch.hpp>
#include <lockstep/shader_names.hpp>
#include <lockstep/system.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/record/system_recording.hpp"
#include "crosscheck/report/page/system_page.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/system/item_words.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::images_test {

using lockstep::test::TemporaryFolder;

/// Lamps in a buffer: their light is added up in an image and hazes one of three dimensions; the nearest marks its
/// texel, and each draws a pane of two. All numbers are exact in any order.
namespace {

enum : std::uint8_t { lamps, light, haze, marks, panes };
constexpr FieldId place{lamps, 0}, depth{lamps, 1}, power{lamps, 2}, of_light{light, 0}, of_haze{haze, 0},
    mark{marks, 0};
constexpr Extent flat{8, 4, 1}, deep{8, 4, 2};

namespace site {
inline constexpr Site power{"power"}, light{"light"}, haze{"haze"}, half{"half"}, share{"share"}, mark{"mark"};
} // namespace site

Schema schema() {
    return checked({"glow",
                    {{.name = "lamps",
                      .item = "lamp",
                      .title = "the lamps",
                      .fields = {{.name = "place", .components = 2}, {.name = "depth"}, {.name = "power"}}},
                     {.name = "light",
                      .item = "texel",
                      .title = "the light",
                      .fields = {{.name = "light"}},
                      .dimensions = 2,
                      .format = "r32f"},
                     {.name = "haze",
                      .item = "cell",
                      .title = "the haze",
                      .fields = {{.name = "haze"}},
                      .dimensions = 3,
                      .format = "r32f"},
                     {.name = "marks",
                      .item = "mark",
                      .title = "the marks",
                      .fields = {{.name = "mark", .scalar = Scalar::uint32}},
                      .dimensions = 2,
                      .format = "r32ui"},
                     {.name = "panes",
                      .item = "pane",
                      .title = "the panes",
                      .fields = {{.name = "pane", .scalar = Scalar::uint32}},
                      .dimensions = 2,
                      .format = "r8"}}});
}

std::size_t texel_of(const SystemView& state, std::size_t lamp) {
    const glm::vec2 at = state.vec2(place, lamp);
    return static_cast<std::size_t>(at.y) * flat.width + static_cast<std::size_t>(at.x);
}

struct Shine {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        typename R::Real sum(0.0F);
        for (std::size_t lamp = 0; lamp < in.before[lamps].count(); ++lamp)
            if (texel_of(in.before, lamp) == item)
                sum = sum + r.read(site::power, in.before.real(power, lamp));
        ItemWords<R> words;
        words.add(r.note(site::light, sum));
        return words;
    }
};

struct Spread {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        const float part = item < flat.count() ? 1.0F : 0.25F;
        const auto old = r.read(site::haze, in.before.real(of_haze, item));
        const auto lit = r.read(site::light, in.before.real(of_light, item % flat.count()));
        ItemWords<R> words;
        words.add(r.note(site::haze, r.uniform(site::half, 0.5F) * old + r.uniform(site::share, part) * lit));
        return words;
    }
};

struct MarkNearest {
    template <class R> auto operator()(R&, const PassInput& in, std::size_t item) const {
        std::uint32_t nearest = in.before.word(mark, item);
        float least = 1.0F;
        for (std::size_t lamp = 0; lamp < in.before[lamps].count(); ++lamp)
            if (texel_of(in.before, lamp) == item && in.before.real(depth, lamp) < least) {
                least = in.before.real(depth, lamp);
                nearest = static_cast<std::uint32_t>(lamp) + 1;
            }
        ItemWords<R> words;
        words.add(nearest);
        return words;
    }
};

struct Pane {
    template <class R> auto operator()(R&, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        bool covered = false;
        for (std::size_t lamp = 0; lamp < in.before[lamps].count(); ++lamp) {
            const std::size_t first = texel_of(in.before, lamp);
            covered = covered || item == first || (item == first + 1 && item % flat.width != 0);
        }
        words.add(std::uint32_t{covered ? 51U : 0U});
        return words;
    }
};

struct Dim {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        const glm::vec2 at = in.before.vec2(place, item);
        const auto old = r.read(site::power, in.before.real(power, item));
        const auto lit = r.read(site::light, in.before.real(of_light, texel_of(in.before, item)));
        ItemWords<R> words;
        words.add(typename R::Real(at.x < 7.0F ? at.x + 1.0F : 0.0F));
        words.add(typename R::Real(at.y));
        words.add(typename R::Real(in.before.real(depth, item)));
        words.add(r.note(site::power, old * 0.5F + lit * 0.25F));
        return words;
    }
};

const Schema& glow() {
    static const Schema all = schema();
    return all;
}

System system() {
    System made{.name = "glow",
                .schema = glow(),
                .passes = {},
                .mistakes = {},
                .start = {glow(), {{24}, flat, deep, flat, flat}},
                .settings = {}};
    for (std::size_t i = 0; i < 24; ++i) {
        made.start.set(place, i, glm::vec2(static_cast<float>(i * 5 % 8), static_cast<float>(i * i % 4)));
        made.start.set(depth, i, static_cast<float>(i * 7 % 24) / 32.0F);
        made.start.set(power, i, 1.0F + 0.25F * static_cast<float>(i % 3));
    }
    made.passes.push_back(item_pass({.name = "shine", .resource = light}, Shine{}));
    made.passes.push_back(item_pass({.name = "spread", .resource = haze, .stage = PassStage::compute}, Spread{}));
    made.passes.push_back(item_pass({.name = "mark", .resource = marks}, MarkNearest{}));
    made.passes.push_back(item_pass({.name = "pane", .resource = panes}, Pane{}));
    made.passes.push_back(item_pass({.name = "dim", .resource = lamps}, Dim{}));
    return made;
}

std::vector<GlPass> passes() {
    using Blend = GlDraw::Blend;
    std::vector<GlPass> all{{.name = "shine", .resource = light},
                            {.name = "spread", .stage = Stage::compute, .resource = haze},
                            {.name = "mark", .resource = marks},
                            {.name = "pane", .resource = panes},
                            {.name = "dim", .resource = lamps}};
    all[0].draw = GlDraw{.buffer = lamps, .blend = Blend::added};
    all[2].draw = GlDraw{.buffer = lamps, .has_depth = true, .clears = false};
    all[3].draw = GlDraw{.buffer = lamps, .primitive = GlDraw::Primitive::triangles, .vertices = 6};
    return all;
}

const Gl& gl() {
    static const Gl one;
    return one;
}

CheckReport run(const std::string& shaders, std::vector<GlPass> of = passes()) {
    const System made = system();
    GlSystemSide side(gl(), made, std::move(of), shaders);
    CheckOptions options;
    options.frames = 6;
    return check(made, side, options);
}

/// "(3, 1)" of an image of 8 x 4, "(3, 1, 0)" of the deep one.
std::string told_place(const Resource& resource, std::size_t item) {
    if (resource.dimensions == 1)
        return fmt::format("{}", item);
    const std::string at = fmt::format("{}, {}", item % 8, item / 8 % 4);
    return resource.dimensions == 2 ? fmt::format("({})", at) : fmt::format("({}, {})", at, item / 32);
}

/// The shaders with one text replaced, in a folder of their own.
std::string planted(const TemporaryFolder& folder, const std::string& file, const std::string& right,
                    const std::string& by) {
    std::filesystem::copy("tests/package/glow", folder.path());
    std::ostringstream text;
    text << std::ifstream(folder.path() / file).rdbuf();
    std::string shader = text.str();
    REQUIRE(shader.find(right) != std::string::npos);
    std::ofstream(folder.path() / file) << shader.replace(shader.find(right), right.size(), by);
    return folder.path().string();
}

} // namespace

TEST_CASE("images: a system draws into them with blending and depth, writes and reads them, and every bit agrees") {
    if (!gl())
        return skip(gl().missing());
    const CheckReport report = run("tests/package/glow");
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried.empty());
    CHECK(report.total.compared() == std::uint64_t{6} * (24 * 4 + 32 + 64 + 32 + 32));
}

TEST_CASE("images: what a wrong shader leaves in one is divergent there") {
    if (!gl())
        return skip(gl().missing());
    struct Bug {
        const char *file, *right, *by;
        std::uint8_t resource;
    };
    const Bug bug =
        GENERATE(Bug{"shine.frag", "light = power;", "light = power > 1.25 ? 0.0 : power;", light},
                 Bug{"spread.comp", "0.5 *", "0.25 *", haze}, Bug{"mark.vert", "a_Depth, 1.0", "-a_Depth, 1.0", marks},
                 Bug{"pane.vert", "vec2(2, 1), vec2(0, 1)", "vec2(0, 1), vec2(0, 1)", panes},
                 Bug{"dim.vert", "ivec2(a_Place)", "ivec2(a_Place.yx)", lamps});
    const TemporaryFolder folder;
    const CheckReport report = run(planted(folder, bug.file, bug.right, bug.by));
    CAPTURE(bug.file);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::divergent);
    for (std::uint8_t r = 0; r < glow().resources.size(); ++r)
        CHECK((report.total.differing(r) > 0) == (r == bug.resource));
    const Resource& wrong = glow().resources[bug.resource];
    const Place& first = report.verdicts->first->place;
    CHECK_THAT(report_text(report, {}), Catch::Contains(fmt::format("first     frame {} {} {},", first.frame,
                                                                    wrong.item, told_place(wrong, first.index))));
}

TEST_CASE("images: they go by a shader's own names") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    std::string theirs = planted(folder, "spread.comp", "u_HazeBefore;", "fog;");
    std::ostringstream text;
    text << std::ifstream(folder.path() / "spread.comp").rdbuf();
    std::string shader = text.str();
    for (const auto& [ours, name] :
         {std::pair{"u_HazeBefore", "fog"}, {"u_LightBefore", "lit"}, {"u_HazeAfter", "made"}})
        shader = std::regex_replace(shader, std::regex(ours), name);
    std::ofstream(folder.path() / "spread.comp") << shader;
    ShaderNames names;
    names.uniforms = {{"fog", "u_HazeBefore"}, {"lit", "u_LightBefore"}, {"made", "u_HazeAfter"}};
    {
        const NamedShaders bound(theirs, names);
        CHECK(run(theirs).verdict == Verdict::agree);
    }
    names.uniforms.insert_or_assign("fog", "u_LightBefore");
    const NamedShaders bound(theirs, names);
    CHECK_THROWS_WITH(run(theirs), Catch::Contains("uniform fog is ") && Catch::Contains("but must be sampler2D"));
}

TEST_CASE("images: what is told of a texel names its column, row and layer, in explain and in a capsule") {
    if (!gl())
        return skip(gl().missing());
    const System twins = system();
    GlSystemSide side(gl(), twins, passes(), "tests/package/glow");
    for (const auto& [pass, item, name] : {std::tuple{0U, 11U, "texel (3, 1) in frame 1, pass shine"},
                                           {1U, 43U, "cell (3, 1, 1) in frame 1, pass spread"}}) {
        SystemRun run(twins, side, measured_operations(side.describe().profile), 1, pass);
        CHECK_THAT(explain_item(run, item), Catch::StartsWith(name));
        CHECK_THAT(item_capsule_text(cut_item_capsule(run, item, "here"), twins), Catch::StartsWith(name));
    }
}

TEST_CASE("images: the report page of a program of one's own has the texels that differ, by column and row") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const System twins = system();
    GlSystemSide side(gl(), twins, passes(), planted(folder, "spread.comp", "0.5 *", "0.25 *"));
    SystemPage seen(twins, side, 3);
    CheckOptions options;
    options.frames = 3;
    const CheckReport report =
        check(twins, side, options, {[&](const CheckedPass& checked) { seen.add(checked); }, {}});
    CHECK(report.verdict == Verdict::divergent);
    const std::string page = seen.text(
        "<!-- lockstep data -->", report, {}, {},
        [](const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }, "");
    const std::string start = "id=\"lockstep-head\">";
    const std::size_t from = page.find(start) + start.size();
    const auto head = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    CHECK(head.at("system").at("extents")[haze] == nlohmann::json{8, 4, 2});
    REQUIRE(!head.at("items").empty());
    for (const auto& item : head.at("items")) {
        CHECK(item.at("pass") == 1);
        CHECK_THAT(item.at("name").get<std::string>(), Catch::Matches("cell \\(\\d, \\d, \\d\\)"));
        CHECK_THAT(item.at("command").get<std::string>(), Catch::Contains("--pass spread --item "));
    }
}

TEST_CASE(
    "images: a recorded run has every pass's image, is judged as it was, and is refused by a system of other sizes") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder, out;
    const System twins = system();
    GlSystemSide side(gl(), twins, passes(), planted(folder, "spread.comp", "0.5 *", "0.25 *"));
    CheckOptions options;
    options.frames = 4;
    const CheckReport live = check(twins, side, options);
    const std::string file = (out.path() / "run.h5").string();
    const SystemRunInfo info{.name = "glow", .profile = side.describe().profile, .frames = 4};
    SystemRecorder recorder(file, twins, info);
    run_gpu(twins, side, 4, [&](std::size_t pass, int frame, const SystemState& state) {
        recorder.add(pass, frame, state);
        return true;
    });
    recorder.commit();

    CHECK(recorded_system(file) == "glow");
    SystemRecording recording(file, "glow");
    recording.open(twins);
    CHECK(recording.frames() == 4);
    CHECK(recording.warnings().empty());
    RecordedSide recorded(recording, twins);
    const CheckReport again = check(twins, recorded, options);
    CHECK(again.verdict == Verdict::divergent);
    CHECK(again.gpu_hash == live.gpu_hash);
    CHECK(again.reference_hash == live.reference_hash);
    CHECK(verdict_text(*again.verdicts, again.schema, {}) == verdict_text(*live.verdicts, live.schema, {}));
    CHECK_THROWS_WITH(recorded.step(0, 4), file + " holds frames 0 to 3, not 4");

    CHECK_THROWS_WITH(SystemRecording(file, "gleam"),
                      file + ": a recording of system glow; right is one of system gleam");
    const auto refused = [&](const System& other, const std::string& why) {
        SystemRecording one(file, "glow");
        CHECK_THROWS_WITH(one.open(other), file + ": " + why);
    };
    System larger = system();
    larger.start = {glow(), {{24}, Extent{4, 8, 1}, deep, flat, flat}};
    refused(larger, "state/light/light/value: is float32 [5][4][8]; right is float32 [rows][8][4]");
    System brighter = system();
    brighter.start.set(power, 7, 9.0F);
    refused(brighter, "state/lamps: its row 0 is not the start of glow: lamp 7 is another");
    System shorter = system();
    shorter.passes.pop_back();
    refused(shorter, "state/lamps: 4 rows follow those of this system's passes");
    System swapped = system();
    std::swap(swapped.passes[0], swapped.passes[1]);
    refused(swapped, "state/haze: row 1 is of frame 0, pass 1; in this system it is of frame 0, pass 0");
    static const Schema dimmer = [] {
        Schema changed = schema();
        changed.resources[lamps].fields[2].name = "strength";
        return checked(changed);
    }();
    const System renamed{.name = "glow",
                         .schema = dimmer,
                         .passes = {},
                         .mistakes = {},
                         .start = {dimmer, {{24}, flat, deep, flat, flat}},
                         .settings = {}};
    refused(renamed,
            "parameters/lockstep/schema: the state of glow is another here, first at /resources/0/fields/2/name");
}

TEST_CASE("images: a texel that a dispatch leaves out is an error, not a value of before") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const std::string shaders =
        planted(folder, "spread.comp", "    float share", "    if (texel.x == 3)\n        return;\n    float share");
    CHECK_THROWS_WITH(run(shaders), Catch::Contains("spread did not write cell (3, 0, 0)"));
}

TEST_CASE("images: formats and passes that do not fit are named") {
    if (!gl())
        return skip(gl().missing());
    std::vector<GlPass> all = passes();
    all[0].draw.reset();
    CHECK_THROWS_WITH(run("tests/package/glow", all),
                      "shine: a vertex shader makes the light where it says how it draws");
    Schema wrong = schema();
    wrong.resources[light].format = "r33f";
    CHECK_THROWS_WITH(GlSystem(wrong, {}, "tests/package/glow"),
                      Catch::Contains("no image has format 'r33f'; there are r32f"));
    wrong.resources[light].format = "rgba32f";
    CHECK_THROWS_WITH(GlSystem(wrong, {}, "tests/package/glow"),
                      "'light': its texels are floats; an image of format rgba32f has vec4s");
}

} // namespace lockstep::test::images_test
