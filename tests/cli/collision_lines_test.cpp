#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::collision_lines_test {

using Catch::Contains;

namespace {

struct Mistake {
    std::string file, text, replacement;
    std::vector<std::string> options;
    std::string line; ///< what the report says of it
};

Outcome check(const TemporaryFolder& shaders, const std::vector<std::string>& more) {
    return run_lockstep(joined({"check", "data/scenes/stress/crowd.json", "--frames", "4", "--gl", software_gl(),
                                "--shaders", shaders.path().string()},
                               more));
}

const std::string note = "note      without a counterpart in the reference: ";

} // namespace

TEST_CASE("check: a mistake in a shader of collision is named by its line") {
    if (!have_software_gl())
        return;
    const std::vector<Mistake> mistakes{
        {"collision_pass.vert",
         "u_CollisionRange > len && len < particle_min_length",
         "u_CollisionRange > len",
         {},
         " of the reference: if (u_CollisionRange > len && len < particle_min_length) {: compares"},
        {"collision_pass.vert",
         "    v_CollideTime = u_CollisionTime;\n",
         "",
         {},
         " of the reference: v_CollideTime = u_CollisionTime;: writes"},
        {"collision_pass.vert",
         "v_Speed = product(a_Speed, u_SpeedFactor);",
         "v_Speed = a_Speed;",
         {},
         " of the reference: v_Speed = product(a_Speed, u_SpeedFactor);: makes"},
        {"collision_pass.frag",
         "encode_position(out_Position)",
         "encode_position(out_Position.yxz)",
         {},
         ": void main() { o_Texel = encode_position(out_Position.yxz); }"},
        {"octree_pass.comp",
         "len < particle_min_length",
         "len > particle_min_length",
         {"--set", "search=octree"},
         ": if (u_CollisionRange > len && len > particle_min_length) {: compares"},
        {"collision_pass.comp",
         "u_CollisionRange > len && len < particle_min_length",
         "len < particle_min_length",
         {"--set", "step=compute"},
         " of the reference: if (u_CollisionRange > len && len < particle_min_length) {: compares"},
        {"render_pass.frag",
         "g_Centre.z + normal.z * u_BillboardRadius",
         "g_Centre.z - normal.z * u_BillboardRadius",
         {"--render"},
         ": precise float z = g_Centre.z - normal.z * u_BillboardRadius;: makes"},
    };
    for (const Mistake& one : mistakes) {
        INFO(one.file << ": " << one.replacement);
        const TemporaryFolder folder;
        plant(folder, one.file, one.text, one.replacement);
        const Outcome outcome = check(folder, one.options);
        INFO(outcome.out << outcome.err);
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.out, Contains(note + one.file + ":") && Contains(one.line));
    }
}

TEST_CASE("check: nothing is said of the lines of a shader of collision that is right, or of shipped ones") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    plant(folder, "collision_pass.vert", "u_CollisionRange > len && len < particle_min_length",
          "len < min(u_CollisionRange, particle_min_length)");
    const Outcome right = check(folder, {});
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK_THAT(right.out, !Contains("without a counterpart"));
}

TEST_CASE("check: a shader of collision with groups of another size has its line, too") {
    if (!have_software_gl())
        return;
    const TemporaryFolder groups;
    plant(groups, "collision_pass.comp", "local_size_x = 64", "local_size_x = 128");
    plant(groups, "collision_pass.comp", "u_CollisionRange > len && len < particle_min_length",
          "u_CollisionRange > len && len <= 0.5 * particle_min_length");
    const Outcome larger = check(groups, {"--set", "step=compute"});
    INFO(larger.out << larger.err);
    CHECK(larger.status == 1);
    CHECK_THAT(larger.out, Contains(note + "collision_pass.comp:") && Contains("0.5 * particle_min_length"));
}

} // namespace lockstep::test::collision_lines_test
