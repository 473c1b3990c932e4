#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/study/recall_table.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "crosscheck/collision/study/study_report.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::search_study_test {

namespace {

Particles searching(const std::vector<glm::vec3>& positions) {
    Particles p;
    p.resize(positions.size());
    p.position = positions;
    std::fill(p.collide_time.begin(), p.collide_time.end(), -1.0F);
    return p;
}

/// What is drawn, and what then searches it.
struct Frame {
    FrameParams draw = flat_params(), search = flat_params();
    Particles drawn, now;
    Mesh obstacles;

    explicit Frame(const std::vector<glm::vec3>& positions) : drawn(searching(positions)), now(drawn) {}

    void set(const std::function<void(FrameParams&)>& change) {
        change(draw);
        change(search);
    }

    /// Everything was drawn this many texels to the right of where it is searched.
    void drawn_aside(float texels) {
        draw.collision_proj_view = glm::translate(glm::mat4(1.0F), {texels / 4.0F, 0.0F, 0.0F});
    }

    [[nodiscard]] SearchStudy study() const {
        CollisionImage cdt = empty_cdt(draw);
        DepthImage depth(draw.width, draw.height, 1.0F);
        obstacle_pass(obstacles, draw, {}, cdt, depth);
        rasterise_particles(drawn, drawn, draw, {}, cdt, depth);
        return study_search(now, cdt, draw_owners(drawn, drawn, obstacles, draw, {}),
                            find_truth(now.position, search.constants.collision_range), search, {});
    }

    [[nodiscard]] Hit hit(std::size_t i = 0) const { return study().findings[i].hit; }
};

/// A wall across the image.
Mesh wall(float z) { return {{{-4.0F, -4.0F, z}, {4.0F, -4.0F, z}, {0.0F, 6.0F, z}}, {0, 1, 2}}; }

/// Why particle i misses its neighbour; its only one.
Miss missed(const Frame& frame, std::size_t i) {
    const SearchStudy study = frame.study();
    REQUIRE(study.findings[i].kind == Finding::Kind::missed);
    return study.findings[i].miss;
}

const std::vector<glm::vec3> seen_pair{{0.1F, 0.1F, 0.0F}, {0.3F, 0.1F, 0.0F}};

template <std::size_t N> std::size_t sum(const std::array<std::size_t, N>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

Scene small_scene(const std::string& name, std::size_t particles, std::vector<std::string> settings,
                  const std::string& preset = "corrected") {
    SceneOptions options;
    options.particles = particles;
    options.preset = preset;
    options.set = std::move(settings);
    Scene scene = load_scene("data/scenes/" + name + ".json", options);
    scene.width = scene.height = 100;
    return scene;
}

/// Scenes in which every cause and every kind of hit can come up.
std::vector<Scene> varied_scenes() {
    std::vector<Scene> scenes;
    scenes.push_back(small_scene("lattice", 3000, {"collision_range=0.03", "texel_collide_range=2"}));
    scenes.push_back(small_scene("x_streams", 3000, {"collision_range=0.04"}, "paper"));
    scenes.push_back(small_scene("x_streams", 3000, {"collision_range=0.04", "cdt_format=rgba8", "collision_time=0"}));
    scenes.push_back(small_scene("x_streams", 3000, {"collision_range=0.04", "raster_position=before_step"}, "exact"));
    scenes.push_back(small_scene("x_streams", 3000, {"collision_range=0.04"}));
    scenes.back().camera_path = {{0, {0, 0, 2.4F}, {0, 0, 0}}, {12, {0.6F, 0, 2.0F}, {0.2F, 0, 0}}};
    return scenes;
}

/// Whether a search of all texels finds a true neighbour of particle i.
bool recalled_by_hand(const Particles& p, std::size_t i, const CollisionImage& cdt, const Owners& owners,
                      const FrameParams& params) {
    const BaseTexelIndex base = base_texel(p.position[i], params, {});
    if (base.x < 0 || !(p.collide_time[i] < 0.0F))
        return false;
    const CollisionCode code(params);
    const double range = params.constants.collision_range;
    for (int y = 0; y < params.height; ++y)
        for (int x = 0; x < params.width; ++x) {
            const int ring = std::max(std::abs(x - base.x), std::abs(y - base.y));
            const std::int32_t owner = owners.owner.at(x, y);
            if (ring == 0 || ring > params.constants.texel_collide_range || owner < 0 ||
                owner == static_cast<std::int32_t>(i))
                continue;
            const glm::vec3 self = params.switches.self_position == SelfPosition::vertex
                                       ? p.position[i]
                                       : code.decode(cdt.at(base.x, base.y));
            const double distance = std::sqrt(squared_distance(self, code.decode(cdt.at(x, y))));
            const auto j = static_cast<std::size_t>(owner);
            const bool skipped = distance == 0.0 && params.switches.zero_distance == ZeroDistance::skip;
            if (!skipped && distance < range && squared_distance(p.position[i], p.position[j]) < range * range)
                return true;
        }
    return false;
}

} // namespace

TEST_CASE("search study: two particles that see each other") {
    const SearchStudy study = Frame(seen_pair).study();
    CHECK(study.counts.with_neighbour == 2);
    CHECK(study.counts.recalled == 2);
    CHECK(study.counts.pairs == 2);
    CHECK(study.counts.found_pairs == 2);
    CHECK(study.counts.hits[static_cast<std::size_t>(Hit::nearest)] == 2);
    CHECK(study.counts.non_mutual == 0);
    CHECK(study.counts.recall() == 1.0);
    CHECK(study.counts.precision() == 1.0);
    CHECK(study.counts.mean_depth() == Approx(0.3));
}

TEST_CASE("search study: each cause of a miss, by hand") {
    SECTION("outside the image, from both ends") {
        const Frame frame({{0.9F, 0.1F, 0.0F}, {1.1F, 0.1F, 0.0F}});
        CHECK(missed(frame, 0) == Miss::outside_image);
        CHECK(missed(frame, 1) == Miss::outside_image);
    }
    SECTION("two in a texel: the one behind skips the one in front, which cannot see what it hides") {
        const Frame frame({{0.05F, 0.1F, 0.1F}, {0.2F, 0.1F, 0.0F}});
        CHECK(missed(frame, 0) == Miss::own_texel);
        CHECK(missed(frame, 1) == Miss::occluded);
        CHECK(frame.study().counts.recalled_with_base == 1);
    }
    SECTION("a wall in front hides both") {
        Frame frame(seen_pair);
        frame.obstacles = wall(-0.5F);
        CHECK(missed(frame, 0) == Miss::hidden);
        CHECK(missed(frame, 1) == Miss::hidden);
    }
    SECTION("two texels apart, radius 1") {
        const Frame frame({{0.2F, 0.1F, 0.0F}, {0.52F, 0.1F, 0.0F}});
        CHECK(missed(frame, 0) == Miss::outside_window);
    }
    SECTION("drawn by a camera that has moved on") {
        Frame frame(seen_pair);
        frame.drawn_aside(2.0F);
        CHECK(missed(frame, 0) == Miss::stale);
    }
    SECTION("drawn before it moved") {
        Frame frame(seen_pair);
        frame.drawn.position[1] = {0.3F, 0.1F, 0.9F};
        CHECK(missed(frame, 0) == Miss::stale);
    }
    SECTION("at the same place") {
        Frame frame({{0.1F, 0.1F, 0.0F}, {0.1F, 0.1F, 0.0F}});
        frame.drawn_aside(1.0F);
        CHECK(missed(frame, 0) == Miss::occluded);
        CHECK(missed(frame, 1) == Miss::coincident);
    }
    SECTION("rounded out of range by an rgba8 code") {
        Frame frame({{0.01F, 0.1F, 0.0F}, {0.487F, 0.1F, 0.1453F}});
        frame.set([](FrameParams& params) { params.switches.cdt_format = CdtFormat::rgba8; });
        CHECK(missed(frame, 0) == Miss::rounded);
    }
    SECTION("cooling down") {
        Frame frame(seen_pair);
        frame.now.collide_time[0] = 0.0F;
        CHECK(missed(frame, 0) == Miss::cooling_down);
        CHECK(frame.study().findings[1].kind == Finding::Kind::recalled);
        CHECK(frame.study().counts.non_mutual == 1);
    }
    SECTION("self_position texel: measured from the particle in front, out of its neighbour's range") {
        Frame frame({{0.1F, 0.1F, 0.0F}, {0.1F, 0.1F, -0.6F}, {0.3F, 0.1F, 0.1F}});
        frame.set([](FrameParams& params) { params.switches.self_position = SelfPosition::texel; });
        CHECK(missed(frame, 0) == Miss::own_texel);
    }
}

TEST_CASE("search study: each kind of hit, by hand") {
    SECTION("nothing near") { CHECK(Frame({{0.1F, 0.1F, 0.0F}}).hit() == Hit::none); }
    SECTION("the nearer of two, and the farther where the nearer is hidden") {
        Frame frame({{0.1F, 0.1F, 0.0F}, {0.3F, 0.1F, 0.0F}, {0.3F, 0.1F, 0.3F}});
        CHECK(frame.hit() == Hit::nearest);
        frame.now.position[2] = frame.drawn.position[2] = {0.35F, 0.1F, -0.1F};
        CHECK(frame.hit() == Hit::neighbour);
    }
    SECTION("an obstacle") {
        Frame frame({{0.1F, 0.1F, 0.0F}});
        frame.obstacles = wall(-0.1F);
        CHECK(frame.hit() == Hit::obstacle);
    }
    SECTION("an empty texel, read as the origin") {
        Frame frame({{0.1F, 0.1F, 0.0F}});
        frame.set([](FrameParams& params) { params.switches.empty_texel = EmptyTexel::phantom; });
        CHECK(frame.hit() == Hit::phantom_origin);
    }
    SECTION("itself, in the next texel") {
        Frame frame({{0.1F, 0.1F, 0.0F}});
        frame.drawn_aside(1.0F);
        CHECK(frame.hit() == Hit::none);
        frame.set([](FrameParams& params) { params.switches.zero_distance = ZeroDistance::hit; });
        CHECK(frame.hit() == Hit::wrong_self);
    }
    SECTION("who is near to the particle in front") {
        Frame frame({{0.1F, 0.1F, 0.9F}, {0.1F, 0.1F, 0.0F}, {0.3F, 0.1F, 0.0F}});
        frame.set([](FrameParams& params) { params.switches.self_position = SelfPosition::texel; });
        CHECK(frame.hit() == Hit::wrong_self);
    }
    SECTION("a place its owner has left") {
        Frame frame(seen_pair);
        frame.now.position[1] = {0.3F, 0.1F, 0.9F};
        CHECK(frame.hit() == Hit::stale);
    }
    SECTION("rounded into range by an rgba8 code") {
        Frame frame({{0.01F, 0.1F, 0.0F}, {0.493F, 0.1F, 0.1373F}});
        frame.set([](FrameParams& params) { params.switches.cdt_format = CdtFormat::rgba8; });
        CHECK(frame.hit() == Hit::rounded);
        CHECK(frame.study().counts.precision() == 0.0);
    }
}

TEST_CASE("search study: owners are whose positions the CDT holds") {
    for (const Scene& scene : varied_scenes()) {
        ReferenceSimulation simulation(scene, {});
        for (int frame = 0; frame < 6; ++frame) {
            const Particles before = simulation.particles();
            const FrameParams params = frame_params(scene, frame);
            simulation.step(params);
            const Owners owners = draw_owners(before, simulation.particles(), scene.obstacles, params, {});
            const CollisionCode code(params);
            std::size_t wrong = 0;
            for (std::size_t t = 0; t < owners.owner.texels.size(); ++t) {
                const std::int32_t owner = owners.owner.texels[t];
                const glm::vec4 stored = simulation.cdt().texels[t];
                if (owner < 0)
                    wrong += (owner == empty_owner) != (stored.a == 0.0F);
                else
                    wrong += stored != code.encode(simulation.particles().position[static_cast<std::size_t>(owner)]) ||
                             owners.drawn[static_cast<std::size_t>(owner)] != static_cast<std::int32_t>(t);
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("search study: causes sum to the misses, hits are the step's, recall is what a search of all texels finds") {
    SearchCounts all;
    for (const Scene& scene : varied_scenes()) {
        ReferenceSimulation simulation(scene, {});
        Particles previous;
        for (int frame = 0; frame < 12; ++frame) {
            const Particles before = simulation.particles();
            const CollisionImage cdt = simulation.cdt();
            const FrameParams params = frame_params(scene, frame);
            simulation.step(params);
            if (frame == 1 || frame == 11) {
                const Owners owners =
                    draw_owners(previous, before, scene.obstacles, frame_params(scene, frame - 1), {});
                const auto study = study_search(
                    before, cdt, owners, find_truth(before.position, params.constants.collision_range), params, {});
                const SearchCounts& n = study.counts;
                CHECK(sum(n.missed_pairs) == n.pairs - n.found_pairs);
                CHECK(sum(n.missed_particles) == n.with_neighbour - n.recalled);
                CHECK(sum(n.hits) == n.particles);
                std::size_t wrong_hits = 0, wrong_recall = 0;
                for (std::size_t i = 0; i < before.size(); ++i) {
                    const bool collided = before.collide_time[i] < 0.0F &&
                                          simulation.particles().collide_time[i] == params.constants.collision_time;
                    wrong_hits += collided != (study.findings[i].hit != Hit::none);
                    if (i % 5 == 0)
                        wrong_recall += recalled_by_hand(before, i, cdt, owners, params) !=
                                        (study.findings[i].kind == Finding::Kind::recalled);
                }
                CHECK(wrong_hits == 0);
                CHECK(wrong_recall == 0);
                all += n;
            }
            previous = before;
        }
    }
    for (const Miss miss : {Miss::outside_image, Miss::own_texel, Miss::occluded, Miss::outside_window, Miss::stale,
                            Miss::cooling_down}) {
        INFO(miss_names[static_cast<std::size_t>(miss)]);
        CHECK(all.missed_pairs[static_cast<std::size_t>(miss)] > 0);
    }
    for (const Hit hit : {Hit::nearest, Hit::neighbour, Hit::phantom_origin, Hit::wrong_self}) {
        INFO(hit_names[static_cast<std::size_t>(hit)]);
        CHECK(all.hits[static_cast<std::size_t>(hit)] > 0);
    }
}

TEST_CASE("search study: drift of a hit, and none of free fall's momentum") {
    Particles before = searching({{0, 0, 0}, {1, 0, 0}});
    before.direction = {{1, 0, 0}, {0, 1, 0}};
    before.speed = {2.0F, 1.0F};
    Constants constants;
    constants.tick = 0.5F;
    constants.gravity = {0, -2, 0};
    Particles after = before;
    after.direction = {{1, 0, 0}, {0, 0, 1}};
    after.position[0] = {1, 0, 0};
    after.direction[0] = glm::normalize(glm::vec3(2, -1, 0));
    after.speed = {std::sqrt(5.0F), 0.0F};
    // Momentum: the first gains gravity's, the second loses (0, 1, 0) and lacks gravity's (0, -1, 0): no sum.
    CHECK(drift(before, after, constants).momentum == Approx(0.0).margin(1e-7));
    // Energy: + 1/2 and - 1/2 of 5/2.
    CHECK(drift(before, after, constants).energy == Approx(0.0).margin(1e-7));
    after.speed[0] = 0.0F;
    CHECK(drift(before, after, constants).energy == Approx(-1.0));
    CHECK(drift(before, after, constants).momentum == Approx(std::sqrt(5.0) / 3.0));
}

TEST_CASE("study: every frame after the empty one, the same for any thread count and stride") {
    const Scene scene = small_scene("x_streams", 2000, {"collision_range=0.04"});
    StudyOptions options;
    options.frames = 10;
    const auto every = study_run(scene, {}, options);
    options.every = 4;
    const auto some = study_run(scene, {}, options);
    REQUIRE(every.size() == 9);
    REQUIRE(some.size() == 3);
    CHECK(some[2].frame == 9);
    CHECK(study_csv(std::vector{every[8]}) == study_csv(std::vector{some[2]}));
    CHECK(total(every).particles == 9 * 2000);
}

TEST_CASE("study: CSV and JSON hold the same numbers, the text its sums") {
    const auto frames = study_run(small_scene("x_streams", 2000, {"collision_range=0.04"}), {}, {});
    std::istringstream csv(study_csv(frames));
    std::string head, line;
    std::getline(csv, head);
    const auto commas = std::count(head.begin(), head.end(), ',');
    std::size_t lines = 0;
    while (std::getline(csv, line)) {
        CHECK(std::count(line.begin(), line.end(), ',') == commas);
        ++lines;
    }
    CHECK(lines == frames.size());
    const nlohmann::json json = study_json(frames);
    CHECK(json["frames"].size() == frames.size());
    CHECK(json["frames"][3].size() == static_cast<std::size_t>(commas + 1));
    const SearchCounts sums = total(frames);
    CHECK(json["total"]["recalled"] == sums.recalled);
    CHECK(study_text(frames).find("\nsum ") != std::string::npos);
    CHECK(study_text(frames).find(std::to_string(sums.pairs - sums.found_pairs)) != std::string::npos);
}

TEST_CASE("study: a picture shows the miss, whatever lies on it") {
    const Frame frame({{0.05F, 0.1F, 0.1F}, {0.2F, 0.1F, 0.0F}});
    const SearchStudy study = frame.study();
    const ColorImage image = study_picture({0, frame.now, frame.search, study.findings}, {});
    CHECK(image.at(4, 4) == miss_color(Miss::occluded));
    CHECK_FALSE(image.at(5, 4) == miss_color(Miss::occluded));
}

TEST_CASE("study: a chart is an SVG file, where gnuplot is installed") {
    const auto frames = study_run(small_scene("x_streams", 500, {"collision_range=0.04"}), {}, {});
    if (!have_gnuplot())
        return test::skip(std::string(no_gnuplot));
    const std::string svg = chart_svg(frames, "it's a \"scene\"");
    CHECK(svg.find("<svg") != std::string::npos);
    CHECK(svg.find("missed: occluded") != std::string::npos);
}

TEST_CASE("study: recall of the cube agrees with the other model") {
    SceneOptions options;
    options.particles = 50'000;
    Scene scene = load_scene("data/scenes/cloud_cube.json", options);
    RecallRow row{"cube", 50'000, 1.8F, {}};
    REQUIRE(model_recall(row));
    const TrueNeighbours truth = find_truth(scene.start.position, scene.constants.collision_range);
    for (std::size_t r = 0; r < recall_radii.size(); ++r) {
        scene.constants.texel_collide_range = recall_radii[r];
        row.counts[r] = study_start(scene, truth, {}).counts;
        CHECK(100.0 * row.counts[r].recall_with_base() == Approx(model_recall(row)->recall[r]).margin(2.0));
        CHECK(row.counts[r].recall() <= row.counts[r].recall_with_base());
    }
    CHECK(100.0 * static_cast<double>(row.counts[0].owners) / 50'000.0 == Approx(83.6).margin(0.5));
    CHECK(recall_row_text(row).find("83.6; 40 / 75 / 83") != std::string::npos);
}

TEST_CASE("search study: with remedies too, causes sum to the misses and hits are the step's") {
    for (const std::vector<std::string>& remedies : {std::vector<std::string>{"cdt_layers=3"},
                                                     {"cdt_cameras=2"},
                                                     {"search_window=projected", "cdt_format=rgba16f"},
                                                     {"cdt_layers=2", "arithmetic=exact"},
                                                     {"response=mutual", "cdt_layers=2"}}) {
        std::vector<std::string> settings = remedies;
        settings.emplace_back("collision_range=0.04");
        Scene scene = small_scene("x_streams", 3000, settings);
        scene.camera_path = {{0, {0, 0, 2.4F}, {0, 0, 0}}, {12, {0.6F, 0, 2.0F}, {0.2F, 0, 0}}};
        INFO(remedies.front());
        ReferenceSimulation simulation(scene, {});
        simulation.step(frame_params(scene, 0));
        for (int frame = 1; frame < 12; ++frame) {
            const Particles before = simulation.particles();
            const CollisionImage cdt = simulation.cdt();
            const FrameParams params = frame_params(scene, frame);
            simulation.step(params);
            const SearchStudy study =
                study_layered_search(before, cdt, draw_layered_owners(before, frame_params(scene, frame - 1), {}),
                                     find_truth(before.position, params.constants.collision_range), params, {});
            const SearchCounts& n = study.counts;
            CHECK(n.pairs > 0);
            CHECK(sum(n.missed_pairs) == n.pairs - n.found_pairs);
            CHECK(sum(n.missed_particles) == n.with_neighbour - n.recalled);
            CHECK(sum(n.hits) == n.particles);
            std::size_t wrong_hits = 0;
            for (std::size_t i = 0; i < before.size(); ++i) {
                const bool collided = before.collide_time[i] < 0.0F &&
                                      simulation.particles().collide_time[i] == params.constants.collision_time;
                const bool hit = study.findings[i].hit != Hit::none;
                wrong_hits += scene.switches.response == Response::single ? collided != hit : collided && !hit;
            }
            CHECK(wrong_hits == 0);
        }
    }
}

TEST_CASE("search study: layers and a second camera find more, and eight layers with a projected window all") {
    Scene scene = small_scene("x_streams", 3000, {"collision_range=0.04", "texel_collide_range=32"});
    const double plain = study_start(scene, {}).counts.recall();
    const auto counts = [&](int layers, int cameras, SearchWindow window) {
        Scene changed = scene;
        changed.switches.cdt_layers = layers;
        changed.switches.cdt_cameras = cameras;
        changed.switches.search_window = window;
        return study_start(changed, {}).counts;
    };
    CHECK(counts(2, 1, SearchWindow::texels).recall() > plain);
    CHECK(counts(1, 2, SearchWindow::texels).recall() > plain);
    for (const SearchWindow window : {SearchWindow::texels, SearchWindow::projected}) {
        const SearchCounts n = counts(8, 1, window);
        CHECK(n.pairs - n.found_pairs == n.missed_pairs[static_cast<std::size_t>(Miss::outside_image)]);
    }
}

} // namespace lockstep::test::search_study_test
