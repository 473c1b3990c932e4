#include "reference/model/collision/emitters.hpp"

#include <cmath>

#include "reference/model/random.hpp"

namespace lockstep {
namespace {

double squared_length(glm::dvec3 v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

glm::dvec3 unit(glm::dvec3 v) { return v / std::sqrt(squared_length(v)); }

glm::dvec3 symmetric_vector(Random& random) {
    const double x = random.symmetric();
    const double y = random.symmetric();
    const double z = random.symmetric();
    return {x, y, z};
}

/// Sites along each axis of a lattice that holds at least `count`: the axis with the widest spacing gets one more until
/// it does.
glm::dvec3 lattice_sites(glm::dvec3 extent, std::size_t count) {
    glm::dvec3 sites(1.0);
    while (sites.x * sites.y * sites.z < static_cast<double>(count)) {
        const glm::dvec3 spacing = extent / sites;
        const int widest = spacing.x >= spacing.y && spacing.x >= spacing.z ? 0 : spacing.z >= spacing.y ? 2 : 1;
        sites[widest] += 1.0;
    }
    return sites;
}

/// Where in the unit cube site `index` lies.
glm::dvec3 lattice_point(glm::dvec3 sites, std::size_t index) {
    const auto nx = static_cast<std::size_t>(sites.x);
    const auto nz = static_cast<std::size_t>(sites.z);
    const glm::dvec3 site(static_cast<double>(index % nx), static_cast<double>(index / nx / nz),
                          static_cast<double>(index / nx % nz));
    return (site + 0.5) / sites;
}

glm::dvec3 box_point(Random& random) { return 0.5 * (symmetric_vector(random) + 1.0); }

/// A direction by rejection from the cube around the ball, so that no sine is needed.
glm::dvec3 shell_point(Random& random, double thickness) {
    glm::dvec3 v(0.0);
    do {
        v = symmetric_vector(random);
    } while (squared_length(v) > 1.0 || squared_length(v) < 1e-4);
    const double radius = 1.0 - thickness * random.unit();
    return 0.5 * (unit(v) * radius + 1.0);
}

} // namespace

Particles emit(std::span<const Emitter> emitters, std::uint64_t seed) {
    std::size_t total = 0;
    for (const Emitter& emitter : emitters)
        total += emitter.count;
    Particles particles;
    particles.resize(total);

    std::size_t first = 0;
    for (const Emitter& emitter : emitters) {
        const glm::dvec3 corner(emitter.box.min);
        const glm::dvec3 extent = glm::dvec3(emitter.box.max) - corner;
        const glm::dvec3 sites = lattice_sites(extent, emitter.count);
        const glm::dvec3 direction = unit(glm::dvec3(emitter.direction));
        const auto count = static_cast<std::ptrdiff_t>(emitter.count);
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            const auto site = static_cast<std::size_t>(k);
            const std::size_t i = first + site;
            Random random(seed, i);
            const glm::dvec3 in_box = emitter.shape == EmitterShape::lattice ? lattice_point(sites, site)
                                      : emitter.shape == EmitterShape::shell ? shell_point(random, emitter.thickness)
                                                                             : box_point(random);
            const glm::dvec3 jitter = static_cast<double>(emitter.direction_jitter) * symmetric_vector(random);
            particles.position[i] = glm::vec3(corner + extent * in_box);
            particles.direction[i] = glm::vec3(unit(direction + jitter));
            particles.speed[i] = static_cast<float>(emitter.speed * (1.0 + emitter.speed_jitter * random.symmetric()));
            particles.collide_time[i] = emitter.collide_time;
        }
        first += emitter.count;
    }
    return particles;
}

void scale_counts(std::vector<Emitter>& emitters, std::size_t total) {
    std::size_t sum = 0;
    for (const Emitter& emitter : emitters)
        sum += emitter.count;
    std::size_t seen = 0;
    std::size_t given = 0;
    for (Emitter& emitter : emitters) {
        seen += emitter.count;
        const std::size_t up_to_here = total * seen / sum;
        emitter.count = up_to_here - given;
        given = up_to_here;
    }
}

void scale_lengths(std::vector<Emitter>& emitters, float factor) {
    for (Emitter& emitter : emitters) {
        glm::vec3::length_type axis = 0;
        for (const glm::vec3::length_type other : {1, 2})
            if (std::abs(emitter.direction[other]) > std::abs(emitter.direction[axis]))
                axis = other;
        const float length = (emitter.box.max[axis] - emitter.box.min[axis]) * factor;
        if (emitter.direction[axis] > 0.0F)
            emitter.box.min[axis] = emitter.box.max[axis] - length;
        else
            emitter.box.max[axis] = emitter.box.min[axis] + length;
    }
}

} // namespace lockstep
