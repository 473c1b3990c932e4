#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "crosscheck/dust/scene.hpp"
#include "reference/dust/update_fast.hpp"
#include "reference/dust/update_twin.hpp"
#include "reference/system/item_twin.hpp"
#include "tests/dust/one_grain.hpp"

using namespace lockstep;
using namespace lockstep::test;
namespace dust = lockstep::dust;
namespace field = lockstep::dust::field;

namespace {

/// Update without its fast way.
std::unique_ptr<ItemPass> twin_alone(const dust::HostPtr& host) {
    return item_pass({.name = "update",
                      .resource = dust::grain_buffer,
                      .stage = PassStage::compute,
                      .arithmetic = host->settings().arithmetic},
                     dust::UpdateTwin{host});
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
            if (!host->has_update() || !dust::has_update_fast(*host))
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
                dust::update_fast(*host, in, profile, 0, host->settings().count, fast[dust::grain_buffer], left);
                CHECK(left.size() < host->settings().count * 3 / 4); // else it proves nothing
                ++compared;
            }
        }
    CHECK(compared > 40);
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
            for (std::size_t i = 0; i < 300 && pass->in_place(); ++i) {
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
