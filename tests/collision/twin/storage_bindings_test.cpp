#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/judge/check.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/compute_scenes.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
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
    for (const Foreign& foreign : {records("std430"), records("std140"), records("shared"), arrays()}) {
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
    for (const Foreign& right : {records("std430"), arrays()}) {
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
    CHECK_THAT(
        error_with(right, "\"ParticlesIn\"", "\"ParticleIn\""),
        Contains("bindings.json: /storage_blocks/ParticleIn: no shader beside it has the name ParticleIn; did you "
                 "mean ParticlesIn?"));
    CHECK_THAT(error_with(right, "\"heading\"", "\"headin\""),
               Contains("/storage_blocks/ParticlesIn/headin: no shader beside it has the name headin; did you mean "
                        "heading?"));
    CHECK_THAT(
        error_with(right, "\"rest\": \"Before.collide_time\"", "\"results\": \"Before.collide_time\""),
        Contains("/storage_blocks/ParticlesIn: nothing is given for its member float rest; right is a name here, "
                 "or a number"));
    CHECK_THAT(
        error_with(right, "\"rest\": \"Before.collide_time\"", "\"rest\": \"Before.collide_time\", \"results\": 1"),
        Contains("/storage_blocks/ParticlesIn/results: block ParticlesIn has no member results; it has "));
    CHECK_THAT(error_with(right, "Before.speed", "Before.sped"),
               Contains("/storage_blocks/ParticlesIn/rate: Before.sped is nothing here; right is one of count, "
                        "Before.position,") &&
                   Contains("did you mean Before.speed?"));
    CHECK_THAT(error_with(right, "\"many\": \"count\"", "\"many\": \"Before.speed\""),
               Contains("/storage_blocks/ParticlesIn/many: Before.speed is float, but many is uint"));
    CHECK_THAT(error_with(right, "\"Before.direction\"", "\"Before.speed\""),
               Contains("/storage_blocks/ParticlesIn/heading: 1 value for a vec3"));
    CHECK_THAT(error_with(right, "\"many\": \"count\"", "\"many\": 0.5"),
               Contains("/storage_blocks/ParticlesIn/many: 0.5 is no uint"));
    CHECK_THAT(error_with(right, "\"rest\": \"After.collide_time\"", "\"rest\": 0"),
               Contains("bindings.json: /storage_blocks: After.collide_time is written by no member; right is one"));
    CHECK_THAT(error_with(right, "\"After.collide_time\"", "\"After.speed\""),
               Contains("After.speed is written by more than one member; right is one"));
    CHECK_THAT(error_with(right, "\"Winners\": \"Nearest\"", "\"Winners\": \"Nearst\""),
               Contains("/storage_blocks/Winners: Nearst is no storage block here; right is one of Before, After, "
                        "Nearest, Offers"));
    CHECK_THAT(error_with(right, "\"Winners\": \"Nearest\"", "\"Winners\": 7"),
               Contains("/storage_blocks/Winners: is to be the name of a block here, or {"));
    Foreign short_array = right;
    short_array.text = replaced(short_array.text, "P results[];", "P results[150];");
    CHECK_THAT(error_of(short_array),
               Contains("/storage_blocks/ParticlesOut/") && Contains(" has 150 elements for 200 items"));
    Foreign single = right;
    single.text = replaced(replaced(single.text, "uint many;", "uint many; float rate_of_all;"),
                           "vec4(p.place, p.rate)", "vec4(p.place, incoming.rate_of_all)");
    single.bindings =
        replaced(single.bindings, "\"many\": \"count\"", "\"many\": \"count\", \"rate_of_all\": \"Before.speed\"");
    CHECK_THAT(error_of(single), Contains("rate_of_all is no array, but Before.speed has a value for each item"));
    Foreign unknown = right;
    unknown.text =
        replaced(unknown.text, "layout(local_size_x = 32) in;",
                 "layout(local_size_x = 32) in;\nlayout(std430, binding = 6) buffer Extra { float extra[]; };");
    unknown.text = replaced(unknown.text, "precise float speed, time;", "precise float speed, time;\nextra[i] = 1.0;");
    CHECK_THAT(error_of(unknown), Contains("nothing is given for storage block Extra at binding 6; bindings.json "));
}
