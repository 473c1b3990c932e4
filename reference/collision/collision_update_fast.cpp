#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "reference/collision/block_arithmetic.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/search_fast.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/collision/stored_positions.hpp"
#include "reference/collision/texel_lookup.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {
namespace {

struct Update {
    const Particles& before;
    const StoredPositions& stored;
    const FrameParams& params;
    const Lengths& lengths;
    const SearchRange& range;
    Particles& after;
};

/// The particles of a block: positions, and the index of the base texel of those that search, -1 of the others.
struct Block {
    std::size_t first, count;
    Columns position;
    std::array<std::int32_t, block_size> texel;
};

/// The particles of a block that collide, and their own position minus the nearest one.
struct Hits {
    std::size_t count = 0;
    std::array<std::uint32_t, block_size> particle;
    Columns away;

    void add(std::size_t i, glm::vec3 v) {
        particle[count] = static_cast<std::uint32_t>(i);
        away.set(count++, v);
    }
};

template <class B> void search_texels(const B& fp, const Update& u, Block& block) {
    const glm::mat4 proj_view = flushed<B>(u.params.collision_proj_view);
    const TexelLookup lookup(u.params);
    const bool divides = u.params.switches.perspective_divide == PerspectiveDivide::on;
    const auto stride = static_cast<std::int32_t>(u.stored.stride);
    const auto origin = static_cast<std::int32_t>(u.stored.origin);
    const float* collide_time = &u.before.collide_time[block.first];
    alignas(64) Floats x, y, w;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec4 clip = fp.transform(proj_view, block.position.at(i));
        x[i] = clip.x;
        y[i] = clip.y;
        w[i] = clip.w;
    }
    if (divides) {
        fp.divisors(w, block.count, w);
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < block.count; ++i) {
            x[i] = fp.quotient(x[i], w[i]);
            y[i] = fp.quotient(y[i], w[i]);
        }
    }
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block.count; ++i) {
        const auto base = lookup(x[i], y[i]);
        const bool searches = base.inside & (fp.flush(collide_time[i]) < 0.0F);
        block.texel[i] = searches ? origin + base.y * stride + base.x : -1;
    }
}

/// Lines 26 to 30 for every particle of the block.
template <class B> void integrate(const B& fp, const Update& u, const Block& block) {
    const float counted = u.params.constants.tick, tick = fp.flush(counted);
    const glm::vec3 pull = fp.scale(fp.flush(u.params.constants.gravity), tick);
    const float* speed = &u.before.speed[block.first];
    const float* collide_time = &u.before.collide_time[block.first];
    float* new_collide_time = &u.after.collide_time[block.first];
    Columns velocity, moved;
    alignas(64) Floats length_square, normalize_square, length, inverse;
    velocity.load(&u.before.direction[block.first], block.count);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec3 v = fp.flush(fp.scale(fp.flush(velocity.at(i)), fp.flush(speed[i])) + pull);
        velocity.set(i, v);
        length_square[i] = fp.sums.length_square(v);
        normalize_square[i] = fp.sums.normalize_square(v);
    }
    fp.roots(length_square, normalize_square, block.count, length, inverse);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block.count; ++i) {
        const glm::vec3 along = fp.scale(velocity.at(i), inverse[i]);
        velocity.set(i, along);
        moved.set(i, fp.flush(block.position.at(i) + fp.scale(fp.scale(along, length[i]), tick)));
        new_collide_time[i] = fp.flush(fp.flush(collide_time[i]) - counted);
    }
    std::copy_n(length.data(), block.count, &u.after.speed[block.first]);
    velocity.store(block.count, &u.after.direction[block.first]);
    moved.store(block.count, &u.after.position[block.first]);
}

/// Lines 2 to 4, and 26 to 30 as if nobody collided.
template <class B> LOCKSTEP_VECTOR_CLONES void fall(const B& fp, const Update& u, Block& block) {
    block.position.load(&u.before.position[block.first], block.count);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block.count; ++i)
        block.position.set(i, fp.flush(block.position.at(i)));
    search_texels(fp, u, block);
    integrate(fp, u, block);
}

/// Lines 5 to 19.
template <int radius, class Sums>
LOCKSTEP_VECTOR_CLONES void search(Sums sums, const Update& u, const Block& block, Hits& hits) {
    const StoredPositions& stored = u.stored;
    const bool from_texel = u.params.switches.self_position == SelfPosition::texel;
    for (std::size_t i = 0; i < block.count; ++i) {
        if (block.texel[i] < 0)
            continue;
        const glm::vec3 self = from_texel ? u.lengths.flushed(stored.at(block.texel[i])) : block.position.at(i);
        const std::ptrdiff_t nearest =
            nearest_fast<radius>(sums, u.lengths, u.range, stored, self, block.texel[i] - radius * (stored.stride + 1));
        if (nearest != no_hit)
            hits.add(i, u.lengths.flushed(self - u.lengths.flushed(stored.at(nearest))));
    }
}

/// Lines 21 to 24 for every hit of the block.
template <class B>
LOCKSTEP_VECTOR_CLONES void collide(const B& fp, const Update& u, const Block& block, const Hits& hits) {
    const Constants& constants = u.params.constants;
    const Switches& switches = u.params.switches;
    const float tick = fp.flush(constants.tick), factor = fp.flush(switches.speed_factor);
    alignas(64) Floats inverse;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < hits.count; ++i)
        inverse[i] = fp.sums.normalize_square(hits.away.at(i));
    fp.inverse_roots(inverse, hits.count, inverse);
    for (std::size_t i = 0; i < hits.count; ++i) {
        const std::size_t p = block.first + hits.particle[i];
        const glm::vec3 direction = fp.scale(hits.away.at(i), inverse[i]);
        const float speed = fp.flush(fp.flush(u.before.speed[p]) * factor);
        glm::vec3 step = fp.scale(direction, speed);
        if (switches.collision_step == CollisionStep::tick)
            step = fp.scale(step, tick);
        u.after.position[p] = fp.flush(block.position.at(hits.particle[i]) + step);
        u.after.direction[p] = direction;
        u.after.speed[p] = speed;
        u.after.collide_time[p] = constants.collision_time;
    }
}

/// The sums of a search: Portable's are those of Strict but for tiny ones, which are looked at by themselves.
template <class B> auto search_sums(const B& fp) {
    if constexpr (std::is_same_v<B, PortableBlocks>)
        return OneOrder<DotOrder::left_to_right>();
    else
        return fp.sums;
}

template <class Sums> auto search_of(int radius) {
    constexpr std::array<void (*)(Sums, const Update&, const Block&, Hits&), widest_fast_radius> of_radius{
        search<1, Sums>, search<2, Sums>, search<3, Sums>, search<4, Sums>,
        search<5, Sums>, search<6, Sums>, search<7, Sums>, search<8, Sums>};
    return of_radius[static_cast<std::size_t>(radius - 1)];
}

template <class B> void update(const B& fp, const Update& u, const Profile& profile) {
    const auto sums = search_sums(fp);
    const auto search_block = search_of<std::remove_const_t<decltype(sums)>>(u.params.constants.texel_collide_range);
    const auto count = static_cast<std::ptrdiff_t>(u.before.size());
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(u.params.switches, profile);
#pragma omp for schedule(dynamic, 16)
        for (std::ptrdiff_t first = 0; first < count; first += block_size) {
            Block block;
            block.first = static_cast<std::size_t>(first);
            block.count = std::min(block_size, u.before.size() - block.first);
            Hits hits;
            fall(fp, u, block);
            search_block(sums, u, block, hits);
            collide(fp, u, block, hits);
        }
    }
}

} // namespace

void update_particles_fast(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                           const Profile& profile, Particles& after) {
    const int radius = params.constants.texel_collide_range;
    const Switches& switches = params.switches;
    if (switches.velocity == Velocity::vector || switches.not_searching == NotSearching::stands || radius < 1 ||
        radius > widest_fast_radius)
        return update_particles(before, cdt, params, profile, after);
    assert(&before != &after && cdt.width == params.width && cdt.height == params.height);
    const bool stepped = with_block_arithmetic(profile, switches.arithmetic, [&](const auto& fp) {
        after.resize(before.size());
        const StoredPositions stored = stored_positions(cdt, params, radius, 3);
        const Lengths lengths{switches.arithmetic == ArithmeticSwitch::exact, profile.length_order(), tables_of(fp)};
        const SearchRange range(lengths, params.constants.collision_range, switches.zero_distance == ZeroDistance::hit);
        update(fp, {before, stored, params, lengths, range, after}, profile);
    });
    if (!stepped)
        update_particles(before, cdt, params, profile, after);
}

} // namespace lockstep
