#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::driver_faults_test {

using Catch::Contains;

namespace {

/// A line of a shader that leaves the state as it is, and what a driver does wrong in it.
struct Fault {
    std::string line, lines_of_driver, operation;
};

const std::vector<Fault> faults{
    {"m.next.x = clamp(m.next.x, -1e9, 1e9);", "#define clamp(a, b, c) (a + 1.0)", "clamp(a, b, c) of "},
    {"m.next.x = max(m.next.x, -1e9);", "#define max(a, b) (b)", "max(a, b) of "},
    {"m.next.x = min(m.next.x, 1e9);", "#define min(a, b) (b)", "min(a, b) of "},
    {"m.next.x = abs(m.next.x) * sign(m.next.x);", "#define abs(a) (a)", "abs(a) of "},
    {"m.next.x = mix(m.next.x, m.next.x, 0.0);", "#define mix(a, b, c) (b + 1.0)", "mix(a, b, c) of "},
    {"m.next.x = cross(vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, m.next.x)).x;", "#define cross(a, b) cross(b, a)",
     "cross(a, b) of "},
    {"m.next.x += float(int(m.next.x)) - trunc(m.next.x);", "#define trunc(a) floor(a - 0.5)", "trunc(a) of "},
    {"m.next.x += unpackHalf2x16(packHalf2x16(vec2(float(dust[i].isAlive)))).x - 1.0;",
     "#define packHalf2x16(a) (packHalf2x16(a) + 1u)", "packHalf2x16(a) of "},
    {"m.next.x += float(bitCount(uint(dust[i].isAlive)) - 1);", "#define bitCount(a) (bitCount(a) + 1)",
     "bitCount(a) of "},
    {"m.next.x += step(2.0, float(dust[i].isAlive));", "#define step(a, b) (1.0 - step(a, b))", "step(a, b) of "},
};

const std::string before = "    set_velocity(i, m.velocity);\n";

Surroundings driver(const std::string& fault) {
    return {.environment = {{"LOCKSTEP_OSMESA_LIBRARY", LOCKSTEP_FAULTY_OSMESA},
                            {"LOCKSTEP_TEST_FAULT", fault},
                            {"LOCKSTEP_CACHE", "off"}}};
}

Outcome check(const TemporaryFolder& shaders, const std::string& fault) {
    return run_lockstep({"check", "data/scenes/dust/free_fall.json", "--particles", "500", "--frames", "3", "--gl",
                         "osmesa", "--no-render", "--shaders", shaders.path().string()},
                        driver(fault));
}

bool have_osmesa() {
    if (open_context("osmesa"))
        return true;
    skip("there is no OSMesa", "LOCKSTEP_REQUIRE_OSMESA");
    return false;
}

} // namespace

TEST_CASE("check: what a driver makes otherwise than the shader's text says is the driver's, with the operation") {
    if (!have_osmesa())
        return;
    const TemporaryFolder right;
    std::string lines;
    for (const Fault& fault : faults)
        lines += "    " + fault.line + "\n";
    plant(right, "update.comp", before, lines + before);
    REQUIRE_THAT(check(right, "").out, Contains("verdict   AGREE"));
    for (const Fault& fault : faults) {
        CAPTURE(fault.line);
        const TemporaryFolder shaders;
        plant(shaders, "update.comp", before, "    " + fault.line + "\n" + before);
        const Outcome outcome = check(shaders, fault.lines_of_driver);
        CAPTURE(outcome.out, outcome.err);
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.out, Contains("items looked at are not what"));
        CHECK_THAT(outcome.out, Contains("driver: update.comp:49: " + fault.operation));
        CHECK_THAT(outcome.out, Contains("this stage shows it alone:") && Contains("void main() {"));
        CHECK_THAT(outcome.out, !Contains("without a counterpart in the reference"));
    }
}

TEST_CASE("check: a driver that reads elsewhere makes each operation as expected") {
    if (!have_osmesa())
        return;
    const Outcome outcome =
        run_lockstep({"check", "data/scenes/fluid/one_sphere.json", "--frames", "1", "--gl", "osmesa"},
                     driver("#define texelFetch(a, b, c) texelFetch(a, (b) + 1, c)"));
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("driver: alone, it makes each operation of these items as expected: look at what "
                                     "it reads and writes, at barriers and formats"));
}

TEST_CASE("check: a wrong shader is not the driver's") {
    if (!have_osmesa())
        return;
    const TemporaryFolder shaders;
    plant(shaders, "update.comp", "    a = add(a, gravity);\n", "    a = add(a, mul(gravity, 2.0));\n");
    const Outcome outcome = check(shaders, "");
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, !Contains("driver: "));
    CHECK_THAT(outcome.out, Contains("without a counterpart in the reference: update.comp:39"));
}

} // namespace lockstep::test::driver_faults_test
