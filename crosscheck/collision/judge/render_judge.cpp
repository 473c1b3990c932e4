#include "crosscheck/collision/judge/render_judge.hpp"

#include <algorithm>
#include <span>
#include <string>

#include <fmt/format.h>

#include "reference/collision/render/legal_pixels.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Pixels whose legal sets are held at a time.
constexpr std::size_t batch = 65536;

std::vector<std::size_t> differing_pixels(const ColorImage& a, const ColorImage& b) {
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < a.texels.size(); ++i)
        if (a.texels[i] != b.texels[i])
            differing.push_back(i);
    return differing;
}

/// Calls visit(pixel, legal) for each.
template <class Visit> void for_each_legal(const RenderInputs& inputs, const Profile& profile,
                                           const KnownOperations& known, const std::vector<std::size_t>& pixels,
                                           std::optional<RenderMistake> mistake, const Visit& visit) {
    for (std::size_t first = 0; first < pixels.size(); first += batch) {
        const auto some = std::span(pixels).subspan(first, std::min(batch, pixels.size() - first));
        const std::vector<LegalPixel> legal = legal_pixels(inputs, profile, known, some, mistake);
        for (std::size_t i = 0; i < some.size(); ++i)
            visit(some[i], legal[i]);
    }
}

bool known_inputs(const RenderInputs& inputs, RenderMistake mistake) {
    return (mistake != RenderMistake::state_of_earlier_frame || inputs.earlier != nullptr) &&
           (mistake != RenderMistake::view_of_earlier_frame || inputs.earlier_params != nullptr);
}

/// Whether the reference with that mistake has the GPU's image, but for what is legal then; `most`: pixels that it may
/// still leave to be judged.
bool explains(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known, const ColorImage& gpu,
              RenderMistake mistake, std::uint64_t most) {
    if (!known_inputs(inputs, mistake))
        return false;
    const auto left = differing_pixels(mistaken_render_pass(inputs, profile, mistake), gpu);
    if (left.size() >= most)
        return false;
    bool all_legal = true;
    for_each_legal(inputs, profile, known, left, mistake, [&](std::size_t pixel, const LegalPixel& legal) {
        all_legal = all_legal &&
                    std::any_of(legal.candidates.begin(), legal.candidates.end(), [&](const PixelCandidate& candidate) {
                        return !candidate.open && candidate.may_be(gpu.texels[pixel]);
                    });
    });
    return all_legal;
}

} // namespace

std::string owner_text(const PixelOwner& owner) {
    switch (owner.kind) {
    case PixelOwner::Kind::background:
        return "the background";
    case PixelOwner::Kind::obstacle:
        return fmt::format("triangle {} of the obstacles", owner.index);
    case PixelOwner::Kind::particle:
        return fmt::format("particle {}", owner.index);
    }
    return "";
}

DifferenceClass pixel_class(const LegalPixel& legal, const PixelOwner& reference, Rgba8 gpu) {
    DifferenceClass found = DifferenceClass::divergent;
    for (const PixelCandidate& candidate : legal.candidates) {
        if (!candidate.may_be(gpu))
            continue;
        const bool same = candidate.owner == reference;
        found = std::min(found, candidate.open ? DifferenceClass::undefined
                                : same         ? DifferenceClass::rounding
                                               : DifferenceClass::tie);
    }
    return found;
}

RenderVerdict judge_render(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                           const ColorImage& gpu) {
    const RenderedFrame reference = render_with_owners(inputs.particles, inputs.obstacles, inputs.params, profile);
    if (gpu.texels.size() != reference.color.texels.size())
        throw Error(fmt::format("rendered frame: {} pixels on the GPU, {} in the reference", gpu.texels.size(),
                                reference.color.texels.size()));
    RenderVerdict verdict;
    verdict.width = gpu.width;
    verdict.pixels = gpu.texels.size();
    verdict.of_particles = static_cast<std::uint64_t>(
        std::count_if(reference.owner.texels.begin(), reference.owner.texels.end(),
                      [](const PixelOwner& owner) { return owner.kind == PixelOwner::Kind::particle; }));
    const std::vector<std::size_t> differing = differing_pixels(reference.color, gpu);
    verdict.differing = differing.size();
    DifferenceClass worst = DifferenceClass::tie;
    for_each_legal(inputs, profile, known, differing, {}, [&](std::size_t pixel, const LegalPixel& legal) {
        const PixelOwner owner = reference.owner.texels[pixel];
        const DifferenceClass kind = pixel_class(legal, owner, gpu.texels[pixel]);
        ++verdict.classes[static_cast<std::size_t>(kind)];
        if (kind <= worst)
            return;
        worst = kind;
        verdict.first = PixelDifference{pixel, reference.color.texels[pixel], gpu.texels[pixel], owner_text(owner)};
    });
    const std::uint64_t divergent = verdict.count(DifferenceClass::divergent);
    if (divergent > 0)
        for (const RenderMistakeInfo& info : render_mistakes())
            if (explains(inputs, profile, known, gpu, info.mistake, divergent))
                verdict.causes.push_back({std::string(info.name), std::string(info.meaning)});
    return verdict;
}

} // namespace lockstep
