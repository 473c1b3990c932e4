#include "crosscheck/collision/page/frame_blobs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <unordered_map>

#include "reference/collision/collision_code.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

bool is_drawn(glm::vec4 texel) { return texel.a != 0.0F; }

std::uint8_t blob_shade(float value, float low, float high) {
    if (!std::isfinite(value))
        return 0;
    const float across = high > low ? std::clamp((value - low) / (high - low), 0.0F, 1.0F) : 0.5F;
    return static_cast<std::uint8_t>(1.0F + std::round(62.0F * across));
}

/// A plane a component.
void add_shades(Blob& blob, const std::vector<glm::vec4>& texels, const Box& box) {
    for (int c = 0; c < 3; ++c)
        for (const glm::vec4& texel : texels)
            blob.byte(blob_shade(texel[c], box.min[c], box.max[c]));
}

void fill_classes(std::vector<std::uint8_t>& classes, const std::vector<std::size_t>& differing,
                  const std::vector<ItemVerdict>* verdicts) {
    for (const std::size_t i : differing)
        classes[i] = class_unjudged;
    if (verdicts != nullptr)
        for (const ItemVerdict& verdict : *verdicts)
            classes[verdict.index] = static_cast<std::uint8_t>(verdict.kind);
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

std::uint64_t hash_of(glm::vec4 code) {
    std::uint64_t hash = 0;
    for (int c = 0; c < 3; ++c)
        hash = (hash ^ bits(code[c])) * 0x9e3779b97f4a7c15U;
    return hash;
}

/// A plane a component: the words of one side, and what the other changes in them.
template <class Word> void add_planes(Blob& blob, const std::vector<std::size_t>& items, std::size_t components,
                                      const Word& reference, const Word& gpu) {
    for (const bool changes : {false, true}) {
        std::vector<std::uint32_t> words;
        words.reserve(items.size() * components);
        for (std::size_t c = 0; c < components; ++c)
            for (const std::size_t i : items)
                words.push_back(changes ? reference(i, c) ^ gpu(i, c) : reference(i, c));
        blob.words(words);
    }
}

void add_items(Blob& blob, const std::vector<std::size_t>& items) {
    blob.words(std::vector<std::uint32_t>(items.begin(), items.end()));
}

void add_classes(Blob& blob, const std::vector<std::size_t>& items, const std::vector<std::uint8_t>& classes) {
    for (const std::size_t i : items)
        blob.byte(classes[i]);
}

std::vector<std::size_t> worst(const std::vector<std::uint8_t>& classes, std::size_t most) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < classes.size(); ++i)
        if (classes[i] != class_same)
            items.push_back(i);
    std::stable_sort(items.begin(), items.end(), [&](std::size_t a, std::size_t b) { return classes[a] > classes[b]; });
    items.resize(std::min(items.size(), most));
    std::sort(items.begin(), items.end());
    return items;
}

} // namespace

FrameClasses classes_of(const ComparedFrame& frame) {
    FrameClasses classes{std::vector<std::uint8_t>(frame.reference.size(), class_same),
                         std::vector<std::uint8_t>(frame.reference_cdt.texels.size(), class_same)};
    if (frame.comparison.agree())
        return classes;
    fill_classes(classes.particles, differing_items(frame.reference, frame.gpu),
                 frame.verdicts != nullptr ? &frame.verdicts->particles : nullptr);
    fill_classes(classes.texels, differing_items(frame.reference_cdt, frame.gpu_cdt),
                 frame.verdicts != nullptr ? &frame.verdicts->texels : nullptr);
    return classes;
}

Blob picture_blob(const ComparedFrame& frame, const FrameClasses& classes, const Box& box) {
    const std::vector<glm::vec4>& reference = frame.reference_cdt.texels;
    const std::vector<glm::vec4>& gpu = frame.gpu_cdt.texels;
    Blob blob;
    for (const glm::vec3& corner : {box.min, box.max})
        for (int c = 0; c < 3; ++c)
            blob.word(bits(corner[c]));
    blob.bits(reference.size(), [&](std::size_t i) { return is_drawn(reference[i]); });
    std::vector<glm::vec4> shown;
    std::copy_if(reference.begin(), reference.end(), std::back_inserter(shown), is_drawn);
    add_shades(blob, shown, box);

    std::vector<std::size_t> differ;
    for (std::size_t i = 0; i < classes.texels.size(); ++i)
        if (classes.texels[i] != class_same)
            differ.push_back(i);
    blob.word(static_cast<std::uint32_t>(differ.size()));
    if (differ.empty())
        return blob;
    blob.bits(reference.size(), [&](std::size_t i) { return classes.texels[i] != class_same; });
    add_classes(blob, differ, classes.texels);
    blob.bits(differ.size(), [&](std::size_t i) { return is_drawn(gpu[differ[i]]); });
    shown.clear();
    for (const std::size_t i : differ)
        if (is_drawn(gpu[i]))
            shown.push_back(gpu[i]);
    add_shades(blob, shown, box);
    return blob;
}

BothOwners owners_of(const ComparedFrame& frame, const Particles& before, const Scene& scene, const FrameParams& params,
                     const Profile& profile) {
    if (params.switches.search != Search::cdt || has_remedies(params.switches))
        return {};
    BothOwners owners;
    owners.reference = draw_owners(before, frame.reference, scene.obstacles, params, profile).owner.texels;
    owners.gpu = owners.reference;
    if (frame.comparison.agree())
        return owners;
    // The GPU's are told by what is stored, wherever its rasteriser put it.
    const CollisionCode code(params);
    std::unordered_map<std::uint64_t, std::int32_t> particle_of;
    for (std::size_t i = 0; i < frame.gpu.size(); ++i)
        particle_of.emplace(hash_of(code.encode(frame.gpu.position[i])), static_cast<std::int32_t>(i));
    for (std::size_t i = 0; i < owners.gpu.size(); ++i) {
        const glm::vec4 stored = frame.gpu_cdt.texels[i];
        const std::int32_t owner = owners.reference[i];
        if (owner >= 0 && same_bits(code.encode(frame.gpu.position[static_cast<std::size_t>(owner)]), stored))
            continue;
        if (owner == obstacle_owner && same_bits(frame.reference_cdt.texels[i], stored))
            continue;
        const auto found = particle_of.find(hash_of(stored));
        owners.gpu[i] = !is_drawn(stored) ? empty_owner : found != particle_of.end() ? found->second : owner_unknown;
    }
    return owners;
}

Selection whole_frame(const ComparedFrame& frame) {
    Selection all;
    for (std::size_t i = 0; i < frame.reference_cdt.texels.size(); ++i)
        if (is_drawn(frame.reference_cdt.texels[i]) || is_drawn(frame.gpu_cdt.texels[i]))
            all.texels.push_back(i);
    all.particles.resize(frame.reference.size());
    std::iota(all.particles.begin(), all.particles.end(), std::size_t{0});
    return all;
}

Selection differing(const FrameClasses& classes, std::size_t most) {
    // Divergent is the worst class there is; what was not judged stands alone in its run.
    return {worst(classes.texels, most), worst(classes.particles, most)};
}

Blob detail_blob(const ComparedFrame& frame, const FrameClasses& classes, const BothOwners& owners,
                 const Selection& selection) {
    Blob blob;
    blob.word(static_cast<std::uint32_t>(selection.texels.size()));
    blob.word(static_cast<std::uint32_t>(selection.particles.size()));
    add_items(blob, selection.particles);
    add_classes(blob, selection.particles, classes.particles);
    const View reference = view(frame.reference);
    const View gpu = view(frame.gpu);
    const std::vector<Component> all = components(reference.about());
    const auto component_of = [&all](const View& particles) {
        return [&](std::size_t i, std::size_t c) { return particles.value(all[c].field, i, all[c].component).bits; };
    };
    add_planes(blob, selection.particles, all.size(), component_of(reference), component_of(gpu));

    add_items(blob, selection.texels);
    add_classes(blob, selection.texels, classes.texels);
    const auto owner_of = [](const std::vector<std::int32_t>& side) {
        return [&side](std::size_t i, std::size_t) {
            return static_cast<std::uint32_t>(side.empty() ? owner_unknown : side[i]);
        };
    };
    add_planes(blob, selection.texels, 1, owner_of(owners.reference), owner_of(owners.gpu));
    const auto texel_of = [&](const CollisionImage& cdt) {
        return [&](std::size_t i, std::size_t c) {
            const std::int32_t owner = owners.reference.empty() ? owner_unknown : owners.reference[i];
            const auto particle = static_cast<std::size_t>(owner);
            const bool listed = c < 3 && owner >= 0 &&
                                std::binary_search(selection.particles.begin(), selection.particles.end(), particle);
            const int component = static_cast<int>(c);
            return bits(cdt.texels[i][component]) ^ (listed ? bits(frame.reference.position[particle][component]) : 0U);
        };
    };
    add_planes(blob, selection.texels, 4, texel_of(frame.reference_cdt), texel_of(frame.gpu_cdt));
    return blob;
}

} // namespace lockstep
