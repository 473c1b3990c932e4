#include <catch2/catch.hpp>

#include <string>

#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::start_file_test {

using Catch::Contains;
using Catch::EndsWith;

namespace {

const std::string by_velocity = "position.x,position.y,position.z,velocity.x,velocity.y,velocity.z\n";

Scene started(const std::string& table, const std::string& more = "", const SceneOptions& options = {}) {
    const test::TemporaryFolder folder;
    static_cast<void>(folder.write("start.csv", table));
    return load_scene(folder.write("scene.json", R"({"start": "start.csv")" + more + "}"), options);
}

std::string refusal(const std::string& table, const std::string& more = "", const SceneOptions& options = {}) {
    try {
        static_cast<void>(started(table, more, options));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("start file: directions and speeds, or velocities, with or without collide times") {
    const Scene scene = started("# made by hand\nposition.x,position.y,position.z,direction.x,direction.y,direction.z,"
                                "speed,collide_time\n0.25,1,-0.5,0,-1,0,0x1.8p-3,-0.5\n1,2,3,0.6,0.8,0,2,0\n");
    REQUIRE(scene.start.size() == 2);
    CHECK(scene.start.position[0] == glm::vec3(0.25F, 1.0F, -0.5F));
    CHECK(scene.start.direction[1] == glm::vec3(0.6F, 0.8F, 0.0F));
    CHECK(scene.start.speed[0] == 0.1875F);
    CHECK(scene.start.collide_time[0] == -0.5F);

    const Scene split = started(by_velocity + "1,2,3,3,-4,0\n0,0,0,0,0,0\n");
    CHECK(split.start.direction[0] == glm::vec3(0.6F, -0.8F, 0.0F));
    CHECK(split.start.speed[0] == 5.0F);
    CHECK(split.start.collide_time[0] == 0.0F);
    CHECK(split.start.direction[1] == glm::vec3(0.0F));
    CHECK(split.start.speed[1] == 0.0F);
}

TEST_CASE("start file: where a particle holds a vector, it is what the file says, or direction times speed") {
    const std::string vector = R"(, "switches": {"velocity": "vector"})";
    const Scene whole = started(by_velocity + "1,2,3,3,-4,0\n", vector);
    CHECK(whole.start.direction[0] == glm::vec3(3.0F, -4.0F, 0.0F));
    CHECK(whole.start.speed[0] == 1.0F);
    const Scene made = started("position.x,position.y,position.z,direction.x,direction.y,direction.z,speed\n"
                               "1,2,3,0.6,-0.8,0,5\n",
                               vector);
    CHECK(made.start.direction[0] == 5.0F * glm::vec3(0.6F, -0.8F, 0.0F));
    CHECK(made.start.speed[0] == 1.0F);
}

TEST_CASE("start file: a camera's way is refused with the key, and the frame, in which it has no view") {
    const auto path = [](const std::string& keys) {
        return refusal(by_velocity + "1,2,3,4,5,6\n", R"(, "camera_path": [)" + keys + "]");
    };
    CHECK_THAT(path(R"({"frame": 5})"),
               EndsWith("/camera_path/0: a key without eye and target; right is one of them, or both"));
    CHECK_THAT(path(R"({"frame": 0, "eye": [0, 0, 3]}, {"frame": 2, "eye": [0, 0, -3]})"),
               EndsWith("/camera_path/1: on the way here, in frame 1, eye, target and the camera's up lie on one line; "
                        "right is a key that leads around it"));
    CHECK_THAT(path(R"({"frame": 0, "eye": [-1, 1, 0]}, {"frame": 1000000000, "eye": [1, 1, 0]})"),
               Contains("in frame 500000000, "));
    CHECK(path(R"({"frame": 0, "eye": [0, 0, 3]}, {"frame": 1, "eye": [0, 0, -3]})").empty());
    CHECK(path(R"({"frame": 0, "eye": [0, 0, 3]}, {"frame": 9, "eye": [3, 0, 0]}, {"frame": 18, "eye": [0, 0, -3]})")
              .empty());
}

TEST_CASE("start file: what is wrong in it is told by its line") {
    CHECK_THAT(refusal("position.x,position.y,positoin.z,speed\n1,2,3,4\n"),
               Contains("start.csv:1: column positoin.z is none of a start's") && Contains("did you mean position.z?"));
    CHECK_THAT(refusal("position.x,position.y,position.z\n1,2,3\n"),
               EndsWith("start.csv: it has neither velocity nor direction and speed; right are position and either "
                        "direction and speed, or velocity"));
    CHECK_THAT(refusal(by_velocity + "1,2,3,4,5,6\n1,2,3,4,5\n"), EndsWith("start.csv:3: 5 values for 6 columns"));
    CHECK_THAT(refusal(by_velocity + "1,2,3,4,5,6\n1,2,3,4,nan,6\n"),
               EndsWith("start.csv:3: particle 1: velocity is nan; right is a finite number"));
    CHECK_THAT(refusal(by_velocity + "1,2,3,4,5,six\n"), Contains("start.csv:2: column velocity.z: 'six' is no float"));
    const std::string by_speed = "position.x,position.y,position.z,direction.x,direction.y,direction.z,speed\n";
    CHECK_THAT(refusal(by_speed + "0,0,0,0,-1,0,0.1\n0,0,0,0,-1,0,-0.1\n"),
               EndsWith("start.csv:3: particle 1: speed is -0.1; right is a number from 0 up"));
    CHECK_THAT(
        refusal(by_speed + "0,0,0,0,0,0,0.1\n"),
        EndsWith("start.csv:2: particle 0: direction has no length, and speed is 0.1; right is a length above 0"));
    CHECK(refusal(by_speed + "0,0,0,0,0,0,0\n").empty());
    CHECK_THAT(refusal(by_velocity), Contains("it has no rows"));
    CHECK_THAT(refusal(by_velocity + "1,2,3,4,5,6\n", R"(, "emitters": [])"),
               EndsWith("scene.json: /start: is there beside emitters; right is one of both"));
    CHECK_THAT(refusal(by_velocity + "1,2,3,4,5,6\n", "", {.particles = 2}),
               Contains("--particles 2: ") && EndsWith("start.csv has 1 particles, which no option changes"));
    const test::TemporaryFolder folder;
    CHECK_THROWS_WITH(load_scene(folder.write("scene.json", R"({"start": "none.csv"})")), Contains("none.csv"));
    CHECK_THROWS_WITH(load_scene(folder.write("scene.json", "{}")), Contains("emitters"));
}

} // namespace lockstep::test::start_file_test
