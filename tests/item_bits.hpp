#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/judge/system_run.hpp"

namespace lockstep::test {

/// Puts numbers that are none, tiny, huge or without a sign into one of so many floats of the images.
inline void spoil(SystemState& state, std::uint8_t resource, unsigned one_of) {
    constexpr float inf = std::numeric_limits<float>::infinity(), tiny = std::numeric_limits<float>::min();
    constexpr std::array<float, 9> odd{
        std::numeric_limits<float>::quiet_NaN(), inf, -inf, 0.0F, -0.0F, tiny, tiny / 8.0F, -3.0e-39F, 1.0e30F};
    std::mt19937 random(resource + 1U);
    const WritableView view = state[resource];
    for (std::size_t f = 0; f < view.columns.size(); ++f) {
        if (view.fields()[f].scalar != Scalar::float32)
            continue;
        for (std::size_t i = 0; i < view.count() * static_cast<std::size_t>(view.fields()[f].components); ++i)
            if (random() % one_of == 0)
                std::memcpy(view.columns[f] + i * sizeof(float), &odd[random() % odd.size()], sizeof(float));
    }
}

/// How many items of a pass's resource, made all at once, differ from those that its twin makes one by one. Of floats
/// that are no numbers any is as good as the other.
inline std::size_t wrong_items(const ItemPass& pass, const SystemState& before, int frame, const Profile& profile) {
    SystemState made = before;
    const SystemView from = before.view();
    const PassInput in{from, frame};
    run_pass(pass, in, profile, made[pass.resource()]);
    const std::unique_ptr<ItemPass> prepared = pass.prepared(in, profile);
    const ItemPass& one_by_one = prepared ? *prepared : pass;
    const View after = std::as_const(made)[pass.resource()];
    const std::vector<Component> of = components(after.about());
    std::size_t wrong = 0;
    for (std::size_t item = 0; item < after.count(); ++item) {
        const std::vector<std::uint32_t> right = one_by_one.mistaken(in, item, profile, {}),
                                         got = item_words(after, item);
        for (std::size_t w = 0; w < right.size(); ++w) {
            const bool is_float = after.fields()[of[w].field].scalar == Scalar::float32;
            const auto is_nan = [](std::uint32_t bits) { return (bits & 0x7fffffffU) > 0x7f800000U; };
            if (right[w] != got[w] && !(is_float && is_nan(right[w]) && is_nan(got[w]))) {
                ++wrong;
                break;
            }
        }
    }
    return wrong;
}

/// Holds every pass of `frames` frames, and once more on images with odd numbers in them, to its twin's items.
inline void check_item_bits(const System& system, const Profile& profile, int frames) {
    ReferenceRun run(system, profile);
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            const ItemPass& pass = *system.passes[p];
            if (!pass.runs(frame))
                continue;
            SystemState before = run.state();
            INFO(std::string(pass.name()) + ", pass " + std::to_string(p) + " of frame " + std::to_string(frame));
            CHECK(wrong_items(pass, before, frame, profile) == 0);
            run.step_pass(p, frame);
            for (std::uint8_t r = 0; r < before.schema().resources.size(); ++r)
                if (before.extent(r).height > 1)
                    spoil(before, r, 16);
            CHECK(wrong_items(pass, before, frame, profile) == 0);
        }
}

} // namespace lockstep::test
