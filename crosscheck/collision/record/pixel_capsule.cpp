#include "crosscheck/collision/record/pixel_capsule.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/scene_frames.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Whom a table names.
struct Named {
    std::set<std::uint32_t> particles, triangles;

    void add(const PixelOwner& owner) {
        if (owner.kind == PixelOwner::Kind::particle)
            particles.insert(owner.index);
        if (owner.kind == PixelOwner::Kind::obstacle)
            triangles.insert(owner.index);
    }
};

Named named_in(const PixelTable& table) {
    Named named;
    named.add(table.owner);
    for (const DrawnHere& here : table.drawn)
        named.add(here.fragment.candidate.owner);
    for (const NearDisc& disc : table.near)
        named.particles.insert(static_cast<std::uint32_t>(disc.particle));
    for (const MistakenPixel& mistaken : table.causes)
        named.add(mistaken.owner);
    return named;
}

/// A table of the capsule's own particles and triangles, with their numbers in the run.
void number_as_in_run(PixelTable& table, const PixelCapsule& capsule) {
    const auto number = [&](PixelOwner& owner) {
        if (owner.kind == PixelOwner::Kind::particle)
            owner.index = capsule.particle_numbers[owner.index];
        if (owner.kind == PixelOwner::Kind::obstacle)
            owner.index = capsule.triangle_numbers[owner.index];
    };
    number(table.owner);
    for (DrawnHere& here : table.drawn) {
        number(here.fragment.candidate.owner);
        if (here.fragment.hidden_by)
            number(*here.fragment.hidden_by);
    }
    for (NearDisc& disc : table.near)
        disc.particle = capsule.particle_numbers[disc.particle];
    for (MistakenPixel& mistaken : table.causes)
        number(mistaken.owner);
}

} // namespace

PixelTable table_of(const PixelCapsule& capsule) {
    const FrameParams params = frame_params(capsule.scene, capsule.frame);
    const FrameParams earlier_params = frame_params(capsule.scene, std::max(capsule.frame - 1, 0));
    RenderVerdict whole;
    whole.frame = capsule.frame;
    whole.classes[static_cast<std::size_t>(DifferenceClass::divergent)] = capsule.divergent;
    for (const std::string& cause : capsule.causes)
        whole.causes.push_back({cause, ""});
    PixelTable table = pixel_table({capsule.particles, capsule.triangles, params, &capsule.earlier, &earlier_params},
                                   capsule.profile, capsule.known, capsule.pixel, capsule.gpu, whole);
    number_as_in_run(table, capsule);
    return table;
}

PixelCapsule cut_pixel_capsule(const JudgedPicture& picture, const PixelCapsuleSource& source) {
    const JudgedFrame& frame = picture.frame();
    const PixelTable table = picture.table(source.pixel);
    const Named named = named_in(table);
    PixelCapsule capsule;
    capsule.scene = source.scene;
    capsule.scene.frames = settings_near(source.scene.frames, table.frame);
    capsule.scene.start = {};
    capsule.scene.obstacles = {};
    capsule.renderer = source.renderer;
    capsule.settings = source.settings;
    capsule.frame = table.frame;
    capsule.pixel = source.pixel;
    capsule.profile = frame.profile;
    capsule.known = frame.known;
    capsule.particle_numbers.assign(named.particles.begin(), named.particles.end());
    capsule.triangle_numbers.assign(named.triangles.begin(), named.triangles.end());
    capsule.particles.resize(named.particles.size());
    capsule.earlier.resize(named.particles.size());
    for (std::size_t i = 0; i < capsule.particle_numbers.size(); ++i) {
        capsule.particles.set(i, frame.gpu[capsule.particle_numbers[i]]);
        capsule.earlier.set(i, frame.before[capsule.particle_numbers[i]]);
    }
    for (const std::uint32_t triangle : named.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = frame.obstacles.indices[std::size_t{triangle} * 3 + k];
            capsule.triangles.indices.push_back(static_cast<std::uint32_t>(capsule.triangles.positions.size()));
            capsule.triangles.positions.push_back(frame.obstacles.positions[vertex]);
        }
    capsule.gpu = table.gpu;
    capsule.divergent = table.divergent;
    for (const MistakenPixel& mistaken : table.causes)
        capsule.causes.push_back(mistaken.cause.name);
    if (pixel_text(table_of(capsule), NumberFormat::hexadecimal) != pixel_text(table, NumberFormat::hexadecimal))
        throw Error(fmt::format("pixel {},{} in frame {}: what it says rests on more than what is drawn there, so no "
                                "capsule of it can be cut",
                                source.pixel % static_cast<std::size_t>(table.width),
                                source.pixel / static_cast<std::size_t>(table.width), table.frame));
    return capsule;
}

std::string capsule_text(const PixelCapsule& capsule, NumberFormat format) {
    return fmt::format("scene     {}\nswitches  {}\nGL        {}\nprofile   {}\n\n{}", capsule.scene.name,
                       capsule.settings.empty() ? "untold" : capsule.settings,
                       capsule.renderer.empty() ? "untold" : capsule.renderer, describe(capsule.profile),
                       pixel_text(table_of(capsule), format));
}

} // namespace lockstep
