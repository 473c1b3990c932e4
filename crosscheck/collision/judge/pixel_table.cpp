#include "crosscheck/collision/judge/pixel_table.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr std::size_t most_near = 3, most_causes = 3;

/// Pixels between a pixel's centre and the rim of a particle's disc; nothing of one that is not drawn at all.
std::optional<double> apart(const RenderInputs& inputs, const Profile& profile, std::size_t particle, int x, int y) {
    const auto window = particle_window(inputs.particles.position[particle], inputs.params, profile);
    if (!window)
        return {};
    const glm::dvec2 half(window->half);
    const glm::dvec2 from = (glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(window->centre)) / half;
    return (std::hypot(from.x, from.y) - 1.0) * std::min(half.x, half.y);
}

/// The nearest, and those that are not much farther.
std::vector<NearDisc> near_discs(const RenderInputs& inputs, const Profile& profile,
                                 const std::vector<DrawnHere>& drawn, int x, int y) {
    constexpr double near = 4.0;
    std::vector<NearDisc> discs;
    for (std::size_t i = 0; i < inputs.particles.size(); ++i) {
        const bool is_drawn = std::any_of(drawn.begin(), drawn.end(), [&](const DrawnHere& here) {
            return here.fragment.candidate.owner ==
                   PixelOwner{PixelOwner::Kind::particle, static_cast<std::uint32_t>(i)};
        });
        if (is_drawn)
            continue;
        if (const auto distance = apart(inputs, profile, i, x, y); distance && std::isfinite(*distance))
            discs.push_back({i, *distance});
    }
    const auto shown = std::min(discs.size(), most_near);
    std::partial_sort(discs.begin(), discs.begin() + static_cast<std::ptrdiff_t>(shown), discs.end(),
                      [](const NearDisc& a, const NearDisc& b) { return a.apart < b.apart; });
    discs.resize(shown);
    while (discs.size() > 1 && discs.back().apart > near)
        discs.pop_back();
    return discs;
}

/// What the named mistakes that explain the frame show here.
std::vector<MistakenPixel> mistaken_pixels(const RenderInputs& inputs, const Profile& profile,
                                           const std::vector<RenderCause>& causes, std::size_t pixel) {
    std::vector<MistakenPixel> shown;
    for (const RenderMistakeInfo& info : render_mistakes()) {
        if (shown.size() == most_causes)
            break;
        if (std::none_of(causes.begin(), causes.end(), [&](const RenderCause& c) { return c.name == info.name; }))
            continue;
        const RenderedFrame frame = mistaken_render_with_owners(inputs, profile, info.mistake);
        shown.push_back({{std::string(info.name), std::string(info.meaning)},
                         frame.owner.texels[pixel],
                         frame.color.texels[pixel]});
    }
    return shown;
}

} // namespace

PixelTable pixel_table(const RenderInputs& inputs, const Profile& profile, const KnownOperations& known,
                       std::size_t pixel, Rgba8 gpu, const RenderVerdict& whole) {
    const RenderedFrame reference = render_with_owners(inputs.particles, inputs.obstacles, inputs.params, profile);
    PixelTable table;
    table.frame = whole.frame;
    table.pixel = pixel;
    table.width = inputs.params.render_width;
    table.owner = reference.owner.texels[pixel];
    table.reference = reference.color.texels[pixel];
    table.gpu = gpu;
    for (const PixelFragment& fragment : pixel_fragments(inputs, profile, known, pixel)) {
        const PixelOwner& owner = fragment.candidate.owner;
        table.drawn.push_back(
            {fragment, owner.kind == PixelOwner::Kind::particle
                           ? particle_window(inputs.particles.position[owner.index], inputs.params, profile)
                           : std::nullopt});
    }
    if (table.reference != table.gpu)
        table.kind =
            pixel_class(legal_pixels(inputs, profile, known, std::span(&pixel, 1)).front(), table.owner, table.gpu);
    const auto columns = static_cast<std::size_t>(table.width);
    table.near =
        near_discs(inputs, profile, table.drawn, static_cast<int>(pixel % columns), static_cast<int>(pixel / columns));
    std::stable_sort(table.drawn.begin(), table.drawn.end(), [](const DrawnHere& a, const DrawnHere& b) {
        const auto key = [](const PixelCandidate& c) {
            return std::pair(c.owner.kind == PixelOwner::Kind::background, c.depth.low);
        };
        return key(a.fragment.candidate) < key(b.fragment.candidate);
    });
    table.divergent = whole.count(DifferenceClass::divergent);
    table.causes = mistaken_pixels(inputs, profile, whole.causes, pixel);
    return table;
}

} // namespace lockstep
