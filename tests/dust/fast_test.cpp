#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <omp.h>

#include "crosscheck/dust/scene.hpp"
#include "reference/dust/blow_wind_twin.hpp"
#include "reference/dust/emit_twin.hpp"
#include "reference/dust/explode_twin.hpp"
#include "reference/dust/tools_fast.hpp"
#include "reference/dust/update_fast.hpp"
#include "reference/dust/update_twin.hpp"
#include "reference/dust/vacuum_up_twin.hpp"
#include "reference/system/item_twin.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::fast_test {

namespace dust = lockstep::dust;
namespace field = lockstep::dust::field;

namespace {

/// A twin without its fast way.
template <class Twin> struct Slow {
    Twin twin;
    [[nodiscard]] Slow at(int frame) const { return {twin.at(frame)}; }
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const { return twin(r, in, item); }
};

/// Update without its fast way.
std::unique_ptr<ItemPass> twin_alone(const dust::HostPtr& host) {
    return item_pass({.name = "update",
                      .resource = dust::grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic},
                     Slow<dust::UpdateTwin>{{host}});
}

std::vector<std::uint32_t> words_of(const SystemState& state) {
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < state.extent(dust::grain_buffer).count(); ++i)
        for (const std::uint32_t word : item_words(state[dust::grain_buffer], i))
            words.push_back(word);
    return words;
}

/// Grains in and around the world, some of them dead, some of any bits.
SystemState some_grains(const dust::Settings& settings, std::size_t count) {
    SystemState state(dust::schema(), {{count}, {1}});
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(-0.05F, 1.05F), speed(-40.0F, 40.0F);
    for (std::size_t i = 0; i < count; ++i) {
        state.set(field::alive, i, static_cast<std::int32_t>(random() % 8 == 0 ? 0 : 1));
        for (int c = 0; c < 3; ++c) {
            const bool any = random() % 64 == 0;
            const float size = settings.world.max[c] - settings.world.min[c];
            state.set(field::position, i,
                      any ? std::bit_cast<float>(static_cast<std::uint32_t>(random()))
                          : settings.world.min[c] + share(random) * size,
                      c);
            state.set(field::velocity, i,
                      random() % 64 == 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(random())) : speed(random),
                      c);
            state.set(field::colour, i, std::bit_cast<float>(static_cast<std::uint32_t>(random())), c);
        }
    }
    // Half of them around colliders, in and at the border of what counts as a hit.
    for (std::size_t i = 0; i < count && !settings.colliders.empty(); i += 2) {
        const dust::Collider& near = settings.colliders[random() % settings.colliders.size()];
        const float reach = near.sphere ? near.radius : 0.5F * std::max({near.scale.x, near.scale.y, near.scale.z});
        for (int c = 0; c < 3; ++c) {
            state.set(field::position, i, near.position[c] + (2.0F * share(random) - 1.0F) * (reach + 0.5F), c);
            state.set(field::velocity, i, speed(random) * 0.05F, c);
        }
    }
    return state;
}

} // namespace

TEST_CASE("dust update: its fast way has the twin's bits, whatever the grains are and wherever they come to") {
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes/dust/"))
        for (const char* preset : {"corrected", "exact"}) {
            if (entry.path().extension() != ".json")
                continue;
            INFO(entry.path() << " " << preset);
            const dust::HostPtr host = host_of(dust::load_scene(entry.path(), {.particles = 5003, .preset = preset}));
            if (!host->has_update())
                continue;
            const SystemState before = some_grains(host->settings(), host->settings().count);
            for (const char* name : {"strict", "nvidia"}) {
                Profile profile = named_profile(name);
                profile.compute_flush_subnormals = compared % 2 == 0;
                SystemState twin = before, fast = before, in_place = before;
                const PassInput in{before.view(), 3};
                run_pass(*twin_alone(host), in, profile, twin[dust::grain_buffer]);
                const auto pass = dust::update_pass(host);
                run_pass(*pass, in, profile, fast[dust::grain_buffer]);
                run_pass(*pass, {in_place.view(), 3}, profile, in_place[dust::grain_buffer]);
                CHECK(words_of(twin) == words_of(fast));
                CHECK(words_of(twin) == words_of(in_place));
                std::vector<std::size_t> left;
                if (dust::has_update_fast(*host)) {
                    dust::update_fast(*host, in, profile, 0, host->settings().count, fast[dust::grain_buffer], left);
                    CHECK(left.size() < host->settings().count * 3 / 4); // else it proves nothing
                }
                ++compared;
            }
        }
    CHECK(compared > 70);
}

namespace {

template <class Twin> std::unique_ptr<ItemPass> alone(const char* name, const dust::HostPtr& host, Twin twin) {
    return item_pass({.name = name,
                      .resource = dust::grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic},
                     Slow<Twin>{twin});
}

/// The tools' kernels without their fast ways.
std::unique_ptr<ItemPass> tool_alone(std::string_view kernel, const dust::HostPtr& host) {
    if (kernel == "vacuum_up")
        return alone("vacuum_up", host, dust::VacuumUpTwin{host});
    if (kernel == "emit")
        return alone("emit", host, dust::EmitTwin{host});
    if (kernel == "blow_wind")
        return alone("blow_wind", host, dust::BlowWindTwin{host});
    return alone("explode", host, dust::ExplodeTwin{host, 0});
}

/// Grains of some_grains(), a third of them dead, half of them within 1.5 times a reach, in and around the cone.
SystemState around(const dust::Settings& settings, const dust::Reach& reach) {
    SystemState state = some_grains(settings, settings.count);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> side(-1.5F, 1.5F);
    for (std::size_t i = 0; i < settings.count; ++i) {
        state.set(field::alive, i, static_cast<std::int32_t>(random() % 3 == 0 ? 0 : 1));
        if (i % 2 == 0)
            for (int c = 0; c < 3; ++c)
                state.set(field::position, i, reach.centre[c] + side(random) * std::sqrt(reach.sqr_range), c);
        if (i % 512 == 0)
            state.set(field::position, i, reach.centre);
    }
    return state;
}

} // namespace

TEST_CASE("dust tools: their fast ways have the twins' bits, and leave few grains to them") {
    std::map<std::string, std::size_t> compared;
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes/dust/"))
        for (const char* preset : {"corrected", "exact"}) {
            if (entry.path().extension() != ".json")
                continue;
            const dust::HostPtr host = host_of(dust::load_scene(entry.path(), {.particles = 3001, .preset = preset}));
            for (const auto& pass : dust::twins(host)) {
                const std::string kernel(pass->name());
                int frame = 0;
                while (frame < 300 && !pass->runs(frame))
                    ++frame;
                if (pass->continues() || kernel == "populate" || kernel == "update" || frame == 300 ||
                    (kernel == "explode" && host->explosion(frame, 0) == nullptr))
                    continue;
                INFO(entry.path() << " " << preset << " " << kernel << " in frame " << frame);
                const dust::Reach reach =
                    kernel == "explode" ? dust::blast_reach(*host, frame, 0) : dust::cone_of(host->at(frame));
                const SystemState before = around(host->settings(), reach);
                for (const char* name : {"strict", "nvidia"}) {
                    SystemState twin = before, fast = before, in_place = before;
                    run_pass(*tool_alone(kernel, host), {before.view(), frame}, named_profile(name),
                             twin[dust::grain_buffer]);
                    run_pass(*pass, {before.view(), frame}, named_profile(name), fast[dust::grain_buffer]);
                    run_pass(*pass, {in_place.view(), frame}, named_profile(name), in_place[dust::grain_buffer]);
                    CHECK(words_of(twin) == words_of(fast));
                    CHECK(words_of(twin) == words_of(in_place));
                    CHECK(words_of(twin) != words_of(before)); // else it proves nothing
                    ++compared[kernel];
                }
            }
        }
    for (const char* kernel : {"vacuum_up", "emit", "blow_wind", "explode"}) {
        INFO(kernel);
        CHECK(compared[kernel] >= 4);
    }
}

TEST_CASE("dust passes: those that say that they run in place read no other grain") {
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes/dust/")) {
        if (entry.path().extension() != ".json")
            continue;
        INFO(entry.path());
        const dust::HostPtr host = host_of(dust::load_scene(entry.path(), {.particles = 300}));
        const SystemState before = some_grains(host->settings(), host->settings().count);
        for (const auto& pass : dust::twins(host)) {
            SystemState after = before;
            for (std::size_t i = 0; i < 300 && pass->in_place({before.view(), 5}); ++i) {
                std::set<ItemId> read;
                SystemView watched = before.view();
                watched.read = &read;
                pass->run({watched, 5}, named_profile("strict"), i, i + 1, after[pass->resource()]);
                for (const ItemId& one : read)
                    CHECK((one.resource != pass->resource() || one.item == i));
            }
        }
    }
}

namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Work> double milliseconds(const Work& work) {
    std::vector<double> taken;
    for (int k = 0; k < 15; ++k) {
        const auto start = std::chrono::steady_clock::now();
        work();
        taken.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return median(taken);
}

/// The suction of a version of the source, in a frame.
struct Suction {
    dust::HostPtr host;
    System system;
    std::size_t pass = 0; ///< vacuum_up

    explicit Suction(const std::string& scene, std::size_t count)
        : host(host_of(dust::load_scene("data/scenes/dust/" + scene + ".json", {.particles = count}))),
          system(dust::system(host)) {
        while (system.passes[pass]->name() != "vacuum_up")
            ++pass;
    }
};

} // namespace

/// Catalogue cpu_crawl, as a table: lockstep_tests_dust "[bench]"
TEST_CASE("dust bench cpu_crawl: the loop on the CPU, and the upload after it, beside the kernel", "[.][bench]") {
    if (!gl())
        return skip(gl().missing());
    fmt::print("{}\n{:>9} {:<16} {:>7} {:>9} {:>9}\n", gl().name(), "grains", "version", "threads", "loop ms",
               "upload ms");
    const int all_threads = omp_get_max_threads();
    for (const std::size_t count : {100'000U, 250'000U, 1'000'000U}) {
        for (const char* scene : {"black_hole_lerp", "black_hole_step"})
            for (const int threads : {1, all_threads}) {
                const Suction of(scene, count);
                ReferenceRun run(of.system, named_profile("strict"));
                run.step(0);
                SystemState after = run.state();
                GlSystemSide side(gl(), of.system, dust::passes(of.host), "shaders/dust");
                omp_set_num_threads(threads);
                const double loop = milliseconds([&] {
                    run_pass(*of.system.passes[of.pass], {run.state().view(), 1}, named_profile("strict"),
                             after[dust::grain_buffer]);
                });
                const double upload = milliseconds([&] { side.upload(std::as_const(after).view()); });
                fmt::print("{:>9} {:<16} {:>7} {:>9.2f} {:>9.2f}\n", count, scene, threads, loop, upload);
            }
        omp_set_num_threads(all_threads);
        const Suction of("black_hole_gpu", count);
        GlSystemSide side(gl(), of.system, dust::passes(of.host), "shaders/dust");
        side.upload(std::as_const(of.system.start).view());
        for (std::size_t p = 0; p < of.system.passes.size(); ++p)
            if (of.system.passes[p]->runs(0))
                side.step(p, 0);
        side.time_steps(true);
        std::vector<double> taken;
        for (int k = 0; k < 15; ++k) {
            side.step(of.pass, 1);
            taken.push_back(side.seconds().wall * 1e3);
        }
        fmt::print("{:>9} {:<16} {:>7} {:>9.2f} {:>9}\n", count, "black_hole_gpu", "kernel", median(taken), "none");
    }
}

} // namespace lockstep::test::fast_test
