#include <fstream>
#include <functional>
#include <new>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system_program.hpp>

#include "tests/consumer/grains/grains.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::system_test {

using lockstep::test::TemporaryFolder;

namespace {

constexpr const char* shipped = "tests/consumer/grains";

const Gl& gl() {
    static const Gl one;
    return one;
}

/// The shader with one of its texts replaced, in a folder of its own.
std::string planted(const TemporaryFolder& folder, const std::string& what, const std::string& by) {
    std::ostringstream text;
    text << std::ifstream(std::string(shipped) + "/grains_step.vert").rdbuf();
    std::string shader = text.str();
    const std::size_t at = shader.find(what);
    REQUIRE(at != std::string::npos);
    shader.replace(at, what.size(), by);
    std::ofstream(folder.path() / "grains_step.vert") << shader;
    return folder.path().string();
}

CheckReport run(const std::string& shaders, const System& system, int frames = 40) {
    GlSystemSide side(gl(), system, grains::passes(), shaders);
    CheckOptions options;
    options.frames = frames;
    return check(system, side, options);
}

} // namespace

TEST_CASE("own system: the right shader agrees or is legal, and every bit was compared") {
    if (!gl())
        return skip(gl().missing());
    const System system = grains::system(2000);
    const CheckReport report = run(shipped, system);
    INFO(report_text(report, {}));
    CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
    CHECK_THAT(report_text(report, {}), Catch::Contains("2,000 grains, 40 frames") && !Catch::Contains("particles"));
    CHECK(report.untried.empty());
    CHECK(report.total.compared() == std::uint64_t{2000} * 40 * 7);
}

TEST_CASE("own system: planted bugs are divergent, with their cause by name and the step where they show") {
    if (!gl())
        return skip(gl().missing());
    struct Bug {
        const char *what, *by, *cause;
    };
    const Bug bug = GENERATE(Bug{"u_Gravity - a_Velocity", "vec3(0.0) - a_Velocity", "gravity_missing"},
                             Bug{"normal = normalize(away)", "normal = away", "normal_not_normalised"},
                             Bug{"a_Velocity * u_Drag", "a_Velocity * -u_Drag", "u_Drag: negated"},
                             Bug{"if (distance < u_Radius)", "if (distance > u_Radius)", "inside the sphere: inverted"},
                             Bug{"bounces = bounces + 1", "bounces = bounces", ""},
                             Bug{"(1.0 + u_Elasticity)", "(1.0 + u_Radius)", "u_Elasticity: one"},
                             Bug{"position.y = 0.0;", "", ""});
    const TemporaryFolder folder;
    const System system = grains::system(2000);
    const CheckReport report = run(planted(folder, bug.what, bug.by), system);
    INFO(bug.what << "\n" << report_text(report, {}));
    REQUIRE(report.verdict == Verdict::divergent);
    if (*bug.cause == '\0')
        return;
    const CauseFindings& found = report.verdicts->causes[0];
    REQUIRE(found.explains_all());
    bool named = false;
    for (const Cause& cause : found.best)
        named = named || cause.name() == bug.cause;
    CHECK(named);
}

TEST_CASE("own system: explain names the first value that does not follow, and a capsule says the same without GL") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const System system = grains::system(500);
    const std::string shaders = planted(folder, "u_Gravity - a_Velocity * u_Drag", "u_Gravity - a_Velocity");
    GlSystemSide side(gl(), system, grains::passes(), shaders);
    SystemRun run(system, side, measured_operations(side.describe().profile), 3, 0);
    const std::string text = explain_item(run, 17);
    INFO(text);
    CHECK_THAT(text, Catch::Contains("first     acceleration.x"));
    CHECK_THAT(text, Catch::Contains("verdict   divergent"));
    CHECK_THAT(text, Catch::Contains("grains.hpp:"));

    const ItemCapsule capsule = cut_item_capsule(run, 17, side.describe().name);
    const std::string file = item_capsule_file(capsule, system);
    CHECK(file.size() < 4000);
    std::ofstream(folder.path() / "capsule.json") << file;
    const ItemCapsule back = load_item_capsule(folder.path() / "capsule.json", system);
    CHECK(item_capsule_text(back, system) == text);
    CHECK(judge(back, system).kind == DifferenceClass::divergent);

    std::ofstream(folder.path() / "broken.json") << file.substr(0, file.size() / 2);
    CHECK_THROWS_AS(load_item_capsule(folder.path() / "broken.json", system), Error);
}

TEST_CASE("own system: whether each stage says precise is known") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    std::ostringstream text;
    text << std::ifstream(std::string(shipped) + "/grains_step.vert").rdbuf();
    std::string without = text.str();
    REQUIRE(without.find("precise") != std::string::npos);
    for (std::size_t at = 0; (at = without.find("precise ", at)) != std::string::npos;)
        without.erase(at, std::string_view("precise ").size());
    folder.write("grains_step.vert", "// precise\n" + without);
    const System system = grains::system(20);
    CHECK(GlSystem(system.schema, grains::passes(), shipped).says_precise());
    CHECK_FALSE(GlSystem(system.schema, grains::passes(), folder.path()).says_precise());
}

TEST_CASE("own system: what would prove nothing is an error or said") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const System system = grains::system(100);
    const auto throws = [&](const std::string& what, const std::string& by, const std::string& words) {
        const std::string shaders = planted(folder, what, by);
        try {
            run(shaders, system, 3);
        } catch (const Error& error) {
            INFO(error.what());
            CHECK_THAT(error.what(), Catch::Contains(words));
            return;
        }
        FAIL("no error for " << by);
    };
    throws("uniform vec3 u_Gravity, u_Centre;",
           "uniform vec3 u_Gravity, u_Centre;\nuniform float u_Tock;\n#define u_Drag u_Tock", "u_Tock");
    throws("out_Bounces = bounces;", "", "out_Bounces");
    throws("void main() {", "out float out_Extra;\nvoid main() {\n    out_Extra = 1.0;", "out_Extra");
    throws("in int a_Bounces;", "in float a_Bounces;", "cannot be assigned");
    CHECK_THROWS_WITH(run(folder.path().string() + "/nowhere", system, 3), Catch::Contains("nowhere"));
    CHECK_THROWS_WITH(run(shipped, grains::system(0), 3), Catch::Contains("there are no grains"));
}

namespace {

/// A twin that reads another item's field; a number of it is negated, which every reading can.
struct Elsewhere {
    FieldId field;
    std::size_t further;
    template <class R> grains::Grain<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        grains::Grain<R> g;
        g.position = r.read(grains::site::start, in.before.vec3(field, item + further));
        g.velocity.x = -g.position.x;
        return g;
    }
};

/// A twin of one number.
struct Speck {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        struct State {
            typename R::Real x;
            auto fields() const { return std::tie(x); }
        };
        return State{r.read(grains::site::start, in.before.real(grains::position, item))};
    }
};

System with_twin(std::unique_ptr<ItemPass> pass) {
    System system = grains::system(3000);
    system.mistakes.clear();
    system.passes.clear();
    system.passes.push_back(std::move(pass));
    return system;
}

} // namespace

TEST_CASE("own system: a twin that reads or gives what the state does not have is an error that names it") {
    if (!gl())
        return skip(gl().missing());
    const auto elsewhere = [](FieldId field, std::size_t further) {
        return with_twin(item_pass({.name = "grains_step"}, Elsewhere{field, further}));
    };
    CHECK_THROWS_WITH(
        run(shipped, elsewhere(grains::position, 1), 3),
        "frame 0: the twin of grains_step: position of grain 3000 is asked for; there are grains 0 to 2999");
    CHECK_THROWS_WITH(run(shipped, elsewhere(grains::position, static_cast<std::size_t>(-1)), 3),
                      Catch::Contains("position of grain -1 is asked for"));
    CHECK_THROWS_WITH(run(shipped, elsewhere({3, 0}, 0), 3), Catch::Contains("grains has no buffer or image 3"));
    CHECK_THROWS_WITH(run(shipped, elsewhere({0, 9}, 0), 3), Catch::Contains("'grains' has no field 9"));
    CHECK_THROWS_WITH(run(shipped, elsewhere(grains::bounces, 0), 3),
                      Catch::Contains("bounces of a grain has type int; there is no component 1"));
    CHECK_THROWS_WITH(run(shipped, with_twin(item_pass({.name = "grains_step"}, Speck{})), 3),
                      Catch::Contains("its twin gives 1 numbers; a grain has 7"));
}

TEST_CASE("own system: a start, twins and shaders that do not belong together are an error") {
    if (!gl())
        return skip(gl().missing());
    System system = grains::system(10);
    CHECK_THROWS_WITH(system.start.set(grains::position, 10, 1.0F), Catch::Contains("there are grains 0 to 9"));
    CHECK_THROWS_WITH(SystemState().set(grains::position, 0, 1.0F), Catch::Contains("a state of nothing"));
    const auto refused = [&](std::vector<GlPass> passes, const std::string& words) {
        CHECK_THROWS_WITH(GlSystemSide(gl(), system, std::move(passes), shipped), Catch::Contains(words));
    };
    refused({}, "0 shaders for 1 twins");
    std::vector<GlPass> passes = grains::passes();
    passes[0].name = "fall";
    refused(passes, "pass 0 is shader 'fall', but twin 'grains_step'");
    passes = grains::passes();
    passes[0].stage = Stage::compute;
    refused(passes, "its GlPass is a compute shader, its twin's stage is vertex");
    passes = grains::passes();
    passes[0].resource = 1;
    refused(passes, "its GlPass is of buffer 1, its twin of buffer 0");
    system.start = {};
    CHECK_THROWS_WITH(run(shipped, system, 3), Catch::Contains("its start is no state of its schema"));
    const System right = grains::system(10);
    GlSystemSide side(gl(), right, grains::passes(), shipped);
    System with_null = grains::system(10);
    with_null.passes.push_back(nullptr);
    CHECK_THROWS_WITH(check(with_null, side, {}), Catch::Contains("a pass is null"));
}

TEST_CASE("a program of one's own ends with a message and status 2 where its system cannot be made") {
    std::string name = "grains", verb = "check";
    std::vector<char*> argv{name.data(), verb.data(), nullptr};
    const auto status = [&](const std::function<System()>& system) {
        return run_system_program(2, argv.data(), system, grains::passes, "shaders");
    };
    CHECK(status([]() -> System { throw Error("grains: two fields are named 'speed'"); }) == 2);
    CHECK(status([]() -> System { throw std::bad_alloc(); }) == 2);
}

} // namespace lockstep::test::system_test
