#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "crosscheck/dust/scene.hpp"
#include "tests/dust/dust_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::invariants_test {

/// What must hold of the GPU's own states after every kernel, whatever the twins say.
namespace dust = lockstep::dust;

namespace {

struct Broken {
    std::string kernel; ///< empty: nothing is
    int frame = 0;
};

/// Runs the kernels on GL alone, and stops at the first that leaves a count beside that of the living, or by which a
/// grain dies or comes back that should not.
Broken first_broken(const dust::Settings& settings, int frames, const std::string& shaders = "shaders/dust") {
    const dust::HostPtr host = host_of(settings);
    const System system = dust::system(host);
    GlSystemSide side(gl(), system, dust::passes(host), shaders, settings.arithmetic);
    SystemState state = system.start;
    side.upload(std::as_const(state).view());
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            const ItemPass& pass = *system.passes[p];
            if (!pass.runs(frame) || pass.continues())
                continue;
            const std::string kernel(pass.name());
            const SystemState before = state;
            side.step(p, frame);
            side.read(state);
            std::uint32_t living = 0, wrong = 0;
            for (std::size_t i = 0; i < settings.count; ++i) {
                const int was = before.view().integer(dust::field::alive, i);
                const int is = std::as_const(state).view().integer(dust::field::alive, i);
                living += is == 1 ? 1 : 0;
                const bool may_die = kernel == "vacuum_up" || kernel == "update";
                const bool may_return = kernel == "emit" || kernel == "populate";
                wrong += is == was || (was == 1 && is == 0 && may_die) || (was == 0 && is == 1 && may_return) ? 0 : 1;
            }
            if (wrong > 0 || living != std::as_const(state).view().word(dust::field::alive_number, 0))
                return {kernel, frame};
        }
    return {};
}

dust::Settings suction_and_back() {
    using Kind = dust::Tool::Kind;
    dust::Settings s;
    s.count = 1000;
    s.spawn = {{-10.0F, 0.0F, -10.0F}, {10.0F, 10.0F, 10.0F}};
    s.world = s.spawn;
    s.tools = {{.kind = Kind::vacuum, .from = 0, .to = 25, .force = 30.0F, .range = 25.0F, .death_range = 1.0F},
               {.kind = Kind::emit, .from = 25, .to = 45, .force = 10.0F, .angle = 30.0F},
               {.kind = Kind::wind, .from = 45, .to = 50, .force = 10.0F, .range = 20.0F}};
    s.cannon = {{.frame = 1, .position = {0.0F, 2.0F, 0.0F}, .speed = 60.0F, .range = 10.0F}};
    s.colliders = {{.position = {4.0F, 2.0F, 4.0F}, .radius = 2.0F}};
    return s;
}

/// Whether a text that stands in a shader, replaced, is noticed.
Broken with(const std::string& file, const std::string& text, const std::string& replacement) {
    const TemporaryFolder folder;
    for (const auto& entry : std::filesystem::directory_iterator("shaders/dust")) {
        std::ostringstream all;
        all << std::ifstream(entry.path()).rdbuf();
        std::string shader = all.str();
        if (entry.path().filename() == file) {
            const std::size_t at = shader.find(text);
            REQUIRE(at != std::string::npos);
            shader.replace(at, text.size(), replacement);
        }
        folder.write(entry.path().filename(), shader);
    }
    return first_broken(suction_and_back(), 50, folder.path());
}

} // namespace

TEST_CASE("dust invariant: on the GPU the count is the number alive after every kernel, in every version") {
    if (!gl())
        return skip(gl().missing());
    for (const char* stage : {"s1", "s2_lerp", "s2_step", "s2_gpu", "s4", "s5", "s8", "sRE", "s11", "s15", "s17"})
        for (const char* preset : {"corrected", "exact"}) {
            INFO(stage << " " << preset);
            dust::Settings s = suction_and_back();
            s.switches = dust::stage(stage, dust::preset(preset));
            s.arithmetic = preset == std::string("exact") ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
            const Broken broken = first_broken(s, 50);
            CHECK(broken.kernel.empty());
        }
}

TEST_CASE("dust invariant: a count that forgets, doubles or races is noticed without a twin, and in its kernel") {
    if (!gl())
        return skip(gl().missing());
    CHECK(with("dust.glsl", "atomicAdd(aliveNumber, 0xffffffffu)", "").kernel == "vacuum_up");
    CHECK(with("dust.glsl", "0xffffffffu", "0xfffffffeu").kernel == "vacuum_up");
    CHECK(with("dust.glsl", "atomicAdd(aliveNumber, 0xffffffffu)", "aliveNumber = aliveNumber - 1u").kernel ==
          "vacuum_up");
    CHECK(with("dust.glsl", "atomicAdd(aliveNumber, 1u)", "").kernel == "emit");
    CHECK(with("populate.comp", "dust[i].isAlive = 1;", "dust[i].isAlive = 0;").kernel == "populate");
    CHECK(
        with("blow_wind.comp", "    float d2 = squared(way);", "    dust[i].isAlive = 0;\n    float d2 = squared(way);")
            .kernel == "blow_wind");
    CHECK(with("vacuum_up.comp", " || dust[i].isAlive != 1", "").kernel == "vacuum_up");
}

TEST_CASE("dust failure count_underflow: a count that is kept while the grains come anew wraps with the first death") {
    if (!gl())
        return skip(gl().missing());
    dust::Settings s;
    s.count = 500;
    s.switches.random = dust::Random::integer;
    s.tools = {{.kind = dust::Tool::Kind::vacuum,
                .from = 0,
                .to = 10,
                .range = 1000.0F,
                .angle = 90.0F,
                .death_range = 1000.0F}};
    const dust::HostPtr host = host_of(s);
    const System system = dust::system(host);
    for (const bool kept : {true, false}) {
        GlSystemSide side(gl(), system, dust::passes(host), "shaders/dust");
        SystemState state = system.start;
        state.set(dust::field::alive_number, 0, kept ? 0U : 500U);
        side.upload(std::as_const(state).view());
        for (std::size_t p = 0; p < system.passes.size(); ++p)
            side.step(p, 0);
        side.read(state);
        const std::uint32_t count = state.view().word(dust::field::alive_number, 0);
        const std::uint32_t living = state.view().total(dust::field::alive);
        CHECK(living < 500);
        CHECK((count > 500) == kept);
        CHECK((count == living) == !kept);
    }
}

} // namespace lockstep::test::invariants_test
