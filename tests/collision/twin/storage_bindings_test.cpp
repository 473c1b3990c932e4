#include <regex>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/judge/check.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/compute_scenes.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::storage_bindings_test {

using Catch::Contains;

namespace {

/// A compute shader with storage blocks of its own, and the file that binds them.
struct Foreign {
    std::string text, bindings;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

/// The shader of right_compute with other blocks for the state: how they are declared, read and written.
std::string with_blocks(const std::string& declared, const std::string& read, const std::string& written) {
    std::string text = test::content("tests/collision/right_compute/own_atomics.comp");
    text = replaced(text, "layout(std430, binding = 0) readonly buffer OldState { vec4 old_state[]; };\n", declared);
    text = replaced(text, "layout(std430, binding = 1) writeonly buffer NewState { vec4 new_state[]; };\n", "");
    text = replaced(text, "(std430, binding = 2)", "(std430)");
    text = replaced(text, "(std430, binding = 3)", "(std430)");
    text = replaced(text, "vec4 place = old_state[2u * i], motion = old_state[2u * i + 1u];", read);
    text = replaced(text, "new_state[2u * i] = vec4(position, speed);\n", written);
    return replaced(text, "        new_state[2u * i + 1u] = vec4(direction, time);\n", "");
}

const std::string pixels = R"("Winners": "Nearest", "Wishes": "Offers")";

/// An array of structures behind a count, whose vec3 leave gaps, in and out.
Foreign records(const std::string& layout) {
    return {replaced(with_blocks("struct P { vec3 place; vec3 heading; float rate; float rest; };\n"
                                 "layout(" +
                                     layout +
                                     ") readonly buffer ParticlesIn { uint many; P particles[]; } incoming;\n"
                                     "layout(" +
                                     layout + ") writeonly buffer ParticlesOut { P results[]; };\n",
                                 "P p = incoming.particles[i];\n"
                                 "        vec4 place = vec4(p.place, p.rate), motion = vec4(p.heading, p.rest);",
                                 "results[i].place = position;\n"
                                 "        results[i].rate = speed;\n"
                                 "        results[i].heading = direction;\n"
                                 "        results[i].rest = time;\n"),
                     "if (i < u_ParticleCount)", "if (i < incoming.many)"),
            R"({ "storage_blocks": {
  "ParticlesIn": { "many": "count", "place": "Before.position", "heading": "Before.direction",
                   "rate": "Before.speed", "rest": "Before.collide_time" },
  "ParticlesOut": { "place": "After.position", "heading": "After.direction",
                    "rate": "After.speed", "rest": "After.collide_time" },
  )" + pixels + " } }"};
}

/// Arrays of vectors and numbers, a block each, changed in place; one has what is left of another, and a number of its
/// own.
Foreign arrays() {
    return {with_blocks("layout(std430) buffer Places { vec2 flat_places[]; };\n"
                        "layout(std430) buffer Rest { vec4 heights[]; };\n"
                        "layout(std430) buffer Headings { float kept; vec3 headings[]; };\n",
                        "vec4 place = vec4(flat_places[i], heights[i].xy), motion = vec4(headings[i], heights[i].w);",
                        "flat_places[i] = position.xy;\n"
                        "        heights[i] = vec4(position.z, speed, 2.0 * kept, time);\n"
                        "        headings[i] = direction;\n"),
            R"({ "storage_blocks": {
  "Places": { "flat_places": ["position.x", "position.y"] },
  "Rest": { "heights": ["position.z", "speed", "count", "collide_time"] },
  "Headings": { "kept": 0.5, "headings": "direction" },
  )" + pixels + " } }"};
}

const std::string state = R"("place": "Before.position", "heading": "Before.direction", "rate": "Before.speed",
  "rest": "Before.collide_time")";
const std::string state_after = R"("place": "After.position", "heading": "After.direction", "rate": "After.speed",
  "rest": "After.collide_time")";

std::string bindings_of(const std::string& blocks) {
    return "{ \"storage_blocks\": { " + blocks + ", " + pixels + " } }";
}

/// All in one array of floats, eight a particle; as many particles as the array has room for.
Foreign floats() {
    return {
        replaced(with_blocks("layout(std430) readonly buffer Old { float o[]; };\n"
                             "layout(std430) writeonly buffer New { float n[]; };\n",
                             "uint b = 8u * i;\n"
                             "        vec4 place = vec4(o[b], o[b + 1u], o[b + 2u], o[b + 3u]);\n"
                             "        vec4 motion = vec4(o[b + 4u], o[b + 5u], o[b + 6u], o[b + 7u]);",
                             "for (int c = 0; c < 3; ++c) {\n"
                             "            n[b + uint(c)] = position[c];\n"
                             "            n[b + uint(c) + 4u] = direction[c];\n"
                             "        }\n"
                             "        n[b + 3u] = speed;\n"
                             "        n[b + 7u] = time;\n"),
                 "if (i < u_ParticleCount)", "if (i < uint(o.length()) / 8u)"),
        bindings_of(R"("Old": { "o": ["Before.position", "Before.speed", "Before.direction", "Before.collide_time"] },
  "New": { "n": ["After.position", "After.speed", "After.direction", "After.collide_time"] })")};
}

/// Vectors of four with a place that nobody needs, padding, and an array's length.
Foreign padded() {
    return {replaced(with_blocks("struct P { vec4 place; vec4 motion; float rest; float pad[3]; };\n"
                                 "layout(std430) readonly buffer Old { P old[]; };\n"
                                 "layout(std430) writeonly buffer New { P made[]; };\n",
                                 "vec4 place = vec4(old[i].place.xyz, old[i].motion.w);\n"
                                 "        vec4 motion = vec4(old[i].motion.xyz, old[i].rest);",
                                 "made[i].place = vec4(position, old[i].place.w);\n"
                                 "        made[i].motion = vec4(direction, speed);\n"
                                 "        made[i].rest = time;\n"),
                     "if (i < u_ParticleCount)", "if (i < uint(old.length()))"),
            bindings_of(R"("Old": { "place": ["Before.position", 1], "motion": ["Before.direction", "Before.speed"],
           "rest": "Before.collide_time", "pad": 0 },
  "New": { "place": ["After.position", 1], "motion": ["After.direction", "After.speed"],
           "rest": "After.collide_time", "pad": [0, 0, 0] })")};
}

/// Structures in structures, arrays of numbers in the place of vectors, in two blocks whose members have the same
/// names.
Foreign nested() {
    return {with_blocks("struct Motion { float heading[3]; float rate; };\n"
                        "struct P { float place[3]; Motion motion; float rest; };\n"
                        "layout(std430) readonly buffer Old { P particles[]; } old;\n"
                        "layout(std140) writeonly buffer New { P particles[2048]; } made;\n",
                        "P p = old.particles[i];\n"
                        "        vec4 place = vec4(p.place[0], p.place[1], p.place[2], p.motion.rate);\n"
                        "        vec4 motion = vec4(p.motion.heading[0], p.motion.heading[1], p.motion.heading[2], "
                        "p.rest);",
                        "for (int c = 0; c < 3; ++c) {\n"
                        "            made.particles[i].place[c] = position[c];\n"
                        "            made.particles[i].motion.heading[c] = direction[c];\n"
                        "        }\n"
                        "        made.particles[i].motion.rate = speed;\n"
                        "        made.particles[i].rest = time;\n"),
            bindings_of("\"Old\": { " + state + " }, \"New\": { " + state_after + " }")};
}

/// Before and after in one block, whose members the whole of their names tells apart; how many there are, as a float.
Foreign together() {
    return {replaced(with_blocks("struct P { vec3 place; vec3 heading; float rate; float rest; };\n"
                                 "layout(std430) buffer All { float many; P old[1500]; P made[1500]; };\n",
                                 "vec4 place = vec4(old[i].place, old[i].rate);\n"
                                 "        vec4 motion = vec4(old[i].heading, old[i].rest);",
                                 "made[i] = P(position, direction, speed, time);\n"),
                     "if (i < u_ParticleCount)", "if (float(i) < many)"),
            bindings_of(R"("All": { "many": "count", "old.place": "Before.position", "old.heading": "Before.direction",
           "old.rate": "Before.speed", "old.rest": "Before.collide_time", "made.place": "After.position",
           "made.heading": "After.direction", "made.rate": "After.speed", "made.rest": "After.collide_time" })")};
}

std::vector<Foreign> all_right() {
    return {records("std430"), records("std140"), records("shared"), arrays(),
            floats(),          padded(),          nested(),          together()};
}

void write(const test::TemporaryFolder& folder, const Foreign& foreign) {
    folder.write("collision_pass.comp", foreign.text);
    folder.write("bindings.json", foreign.bindings);
}

std::string error_of(const Foreign& foreign) {
    const test::TemporaryFolder shaders;
    write(shaders, foreign);
    try {
        static_cast<void>(test::check_twins(test::compute_scene("corrected", 200), 2, shaders.path()));
        return "no error";
    } catch (const Error& error) {
        return error.what();
    }
}

std::string error_with(Foreign foreign, const std::string& what, const std::string& by) {
    foreign.bindings = replaced(foreign.bindings, what, by);
    return error_of(foreign);
}

} // namespace

TEST_CASE("storage bindings: a right compute shader with blocks of its own agrees without an edit") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const Foreign& foreign : all_right()) {
        INFO(foreign.text << foreign.bindings);
        const test::TemporaryFolder shaders;
        write(shaders, foreign);
        const CheckReport report = test::check_twins(test::compute_scene("corrected"), 6, shaders.path());
        CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
        CHECK(report.hits > 100);
    }
}

TEST_CASE("storage bindings: a planted bug in such a shader is divergent, and a particle left out is seen") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const Foreign& right : all_right()) {
        INFO(right.text << right.bindings);
        Foreign wrong = right;
        wrong.text = replaced(wrong.text, "|| len >= nearest", "");
        const test::TemporaryFolder shaders;
        write(shaders, wrong);
        const CheckReport report = test::check_twins(test::compute_scene("corrected"), 6, shaders.path());
        REQUIRE(report.verdict == Verdict::divergent);
        REQUIRE(!report.verdicts->causes.front().best.empty());
        CHECK(report.verdicts->causes.front().best.front().name() == "last_found_instead_of_nearest");
    }
    Foreign less = records("std430");
    less.text = replaced(less.text, "results[i].rate = speed;", "if (i != 7u) results[i].rate = speed;");
    CHECK_THAT(error_of(less), Contains("the GPU did not write particle 7"));
}

TEST_CASE("storage bindings: what does not fit is told with the file, the place in it and what would be right") {
    const auto context = test::open_compute();
    if (!context)
        return;
    const Foreign right = records("std430");
    const auto check = [&](const std::string& what, const std::string& by, const std::string& told) {
        const std::string error = error_with(right, what, by);
        CHECK_THAT(error, Contains("bindings.json: /storage_blocks" + told));
        CHECK(error.find('\n') == std::string::npos);
    };
    check("\"ParticlesIn\"", "\"ParticleIn\"",
          "/ParticleIn: no shader beside it declares a storage block ParticleIn; right is one of ParticlesIn, "
          "ParticlesOut, Winners, Wishes; did you mean ParticlesIn?");
    check("\"ParticlesIn\"", "\"particles\"", "/particles: no shader beside it declares a storage block particles; ");
    check("\"heading\"", "\"headin\"",
          "/ParticlesIn/headin: no shader beside it has the name headin; did you mean heading?");
    check("\"rest\": \"Before.collide_time\"", "\"results\": \"Before.collide_time\"",
          "/ParticlesIn: nothing is given for its member float particles.rest; right is a name here, or a number");
    check("\"rest\": \"Before.collide_time\"", "\"rest\": \"Before.collide_time\", \"results\": 1",
          "/ParticlesIn/results: GL lists of block ParticlesIn no member results; it has many, particles.place, ");
    check("\"rest\": \"Before.collide_time\"", "\"rest\": 0, \"particles.rest\": \"Before.collide_time\"",
          "/ParticlesIn/rest: GL lists of block ParticlesIn no other member rest; it has many, ");
    check("Before.speed", "Before.sped",
          "/ParticlesIn/rate: Before.sped is nothing here; right is a number, or one of count, Before.position, "
          "Before.speed, Before.direction, Before.collide_time, After.position, ");
    check("\"Before.speed\"", "\"u_SpeedFactor\"",
          "/ParticlesIn/rate: u_SpeedFactor is nothing here; right is a number, or one of count, ");
    check("\"many\": \"count\"", "\"many\": \"Before.speed\"",
          "/ParticlesIn/many: Before.speed is float, but many is uint; right is a number, or one of count");
    check("\"Before.direction\"", "\"Before.speed\"",
          "/ParticlesIn/heading: 1 value for particles.heading, which is vec3; right are 3");
    check("\"Before.speed\"", "\"Before.direction\"",
          "/ParticlesIn/rate: 3 values for particles.rate, which is float; right is 1");
    check("\"Before.speed\"", "[]", "/ParticlesIn/rate: is an empty list; right are names and numbers, one at least");
    check("\"Before.speed\"", "null", "/ParticlesIn/rate: is neither a name nor a number, nor a list of these");
    check("\"many\": \"count\"", "\"many\": 0.5",
          "/ParticlesIn/many: 0.5 is no value of many, which is uint; right is a whole number that it holds");
    check("\"many\": \"count\"", "\"many\": -1", "/ParticlesIn/many: -1 is no value of many, which is uint; ");
    check("\"many\": \"count\"", "\"many\": 5e9", "/ParticlesIn/many: 5000000000 is no value of many, which is uint; ");
    check("\"rest\": \"After.collide_time\"", "\"rest\": 0",
          ": After.collide_time is written by no member; right is one");
    check("\"After.position\"", "[\"After.position.x\", \"After.position.y\", 0]",
          ": After.position.z is written by no member; right is one");
    check("\"After.collide_time\"", "\"After.speed\"",
          ": After.speed is written by more than one member; right is one");
    check("\"Winners\": \"Nearest\"", "\"Winners\": \"Nearst\"",
          "/Winners: Nearst is no storage block here; right is one of Before, After, Nearest, Offers; did you mean "
          "Nearest?");
    check("\"Winners\": \"Nearest\"", "\"Winners\": 7", "/Winners: must be the name of a block here, or {");
    check("\"Winners\": \"Nearest\"", "\"Winners\": {}", "/Winners: must be the name of a block here, or {");
    check(
        "\"Winners\": \"Nearest\"", "\"Winners\": { \"winners\": \"count\" }",
        "/Winners/winners: 1 value for winners, which is uvec2; right are 2, or a list, as long as what each item has "
        "there");
    CHECK_THAT(
        error_with(right, "storage_blocks", "storage_block"),
        Contains("bindings.json: /storage_block: is none of uniforms, uniform_blocks, storage_blocks, attributes, "
                 "outputs; did you mean storage_blocks?"));
    CHECK_THAT(error_with(together(), "\"old.rest\": \"Before.collide_time\", \"made.place\"", "\"made.place\""),
               Contains("/storage_blocks/All: nothing is given for its member float old.rest"));
}

TEST_CASE("storage bindings: a name that two members have is told with the whole names of both") {
    const auto context = test::open_compute();
    if (!context)
        return;
    Foreign both = together();
    both.bindings = replaced(both.bindings, "\"old.rate\": \"Before.speed\", ", "");
    both.bindings = replaced(both.bindings, "\"made.rate\": \"After.speed\"", "\"rate\": \"After.speed\"");
    CHECK_THAT(error_of(both),
               Contains("bindings.json: /storage_blocks/All/rate: old.rate and made.rate both have this "
                        "name; right is the whole of it for each"));
}

TEST_CASE("storage bindings: what the shader declares otherwise is told with what would be right") {
    const auto context = test::open_compute();
    if (!context)
        return;
    const Foreign right = records("std430");
    Foreign short_array = together();
    short_array.text = replaced(short_array.text, "P made[1500];", "P made[150];");
    CHECK_THAT(error_of(short_array),
               Contains("/storage_blocks/All/made.place: made.place has room for 150 items of 200; right is an array"));
    Foreign single = right;
    single.text = replaced(replaced(single.text, "uint many;", "uint many; float rate_of_all;"),
                           "vec4(p.place, p.rate)", "vec4(p.place, incoming.rate_of_all)");
    single.bindings =
        replaced(single.bindings, "\"many\": \"count\"", "\"many\": \"count\", \"rate_of_all\": \"Before.speed\"");
    CHECK_THAT(error_of(single), Contains("rate_of_all is no array, but has a field of each item; right is a number"));
    Foreign matrix = right;
    matrix.text = replaced(matrix.text, "uint many;", "uint many; mat4 view;");
    matrix.bindings = replaced(matrix.bindings, "\"many\": \"count\"", "\"many\": \"count\", \"view\": \"u_ProjView\"");
    CHECK_THAT(error_of(matrix),
               Contains("/storage_blocks/ParticlesIn/view: view is mat4; right in a storage block here "
                        "are numbers and vectors of float, int and uint"));
    Foreign unknown = right;
    unknown.text =
        replaced(unknown.text, "layout(local_size_x = 32) in;",
                 "layout(local_size_x = 32) in;\nlayout(std430, binding = 6) buffer Extra { float extra[]; };");
    unknown.text = replaced(unknown.text, "precise float speed, time;", "precise float speed, time;\nextra[i] = 1.0;");
    CHECK_THAT(error_of(unknown), Contains("nothing is given for storage block Extra at binding 6; bindings.json "));
}

TEST_CASE("storage bindings: a block without a binding of its own is not taken for the state") {
    const auto context = test::open_compute();
    if (!context)
        return;
    Foreign left_out = records("std430");
    left_out.bindings = replaced(left_out.bindings, "\"Winners\": \"Nearest\", ", "");
    CHECK_THAT(error_of(left_out), Contains("collision_pass: nothing is given for storage block Winners, which has no "
                                            "binding of its own but Before's; bindings.json beside the shader binds it "
                                            "by name (docs/own_shader.md), or layout(binding = 0) to 3 does"));
    Foreign no_file = records("std430");
    no_file.bindings = "{}";
    CHECK_THAT(error_of(no_file),
               Contains("collision_pass: nothing is given for storage block ") && Contains(" at binding 0, where "));
    const test::TemporaryFolder shaders;
    shaders.write("collision_pass.comp", no_file.text);
    CHECK_THROWS_WITH(test::check_twins(test::compute_scene("corrected", 200), 2, shaders.path()),
                      Contains(" at binding 0, where "));
}

} // namespace lockstep::test::storage_bindings_test
